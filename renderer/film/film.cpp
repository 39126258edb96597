#include "film/film.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/time.h"

namespace crosslight {

using namespace shared;

namespace {

constexpr std::uint32_t kGroupSize = 64;  // local_size_x of the film's kernels

std::vector<gpu::Binding> filmBindings() {
  using enum gpu::BindingType;
  return {{kBindSampleColor, storageBuffer},
          {kBindAovs, storageBuffer},
          {kBindFilm, storageBuffer},
          {kBindFilmParts, storageBuffer},
          {kBindCounters, storageBuffer}};
}

// Rows per band so that no per-pixel buffer exceeds the device's limit for one buffer.
std::uint32_t rowsPerBand(const gpu::Device& device, const FilmSettings& s) {
  const std::uint64_t perPixel = s.wantAovs ? sizeof(AovRecord) : sizeof(FilmPixel);
  const std::uint64_t rows = device.info().maxStorageBufferBytes / (perPixel * s.width);
  if (rows == 0) {
    throw DeviceError(fmt::format("an image row of {} pixels needs {} bytes, the device allows {} per buffer", s.width,
                                  perPixel * s.width, device.info().maxStorageBufferBytes));
  }
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(rows, s.height));
}

}  // namespace

void Tally::add(const std::vector<gpu::TimedSpan>& spans) {
  for (const gpu::TimedSpan& span : spans) {
    const auto found = std::find_if(spans_.begin(), spans_.end(), [&](const auto& s) { return s.first == span.name; });
    if (found == spans_.end()) {
      spans_.emplace_back(span.name, span.gpuMs);
    } else {
      found->second += span.gpuMs;
    }
  }
}

Film::Film(const gpu::Device& device, const FilmSettings& settings)
    : device_(device),
      settings_(settings),
      bandRows_(rowsPerBand(device, settings)),
      commands_(device),
      layout_(device, filmBindings(), sizeof(FilmPush)),
      set_(device, layout_) {
  const std::uint64_t pixels = std::uint64_t{bandRows_} * settings.width;
  const std::uint64_t aovs = settings.wantAovs ? pixels : 1;
  buffers_.sampleColor = gpu::Buffer(device, "sample", pixels * sizeof(glm::vec4), gpu::useStorage);
  buffers_.aovs = gpu::Buffer(device, "AOV records", aovs * sizeof(AovRecord), gpu::useStorage | gpu::useReadback);
  buffers_.film = gpu::Buffer(device, "film", pixels * sizeof(FilmPixel), gpu::useStorage | gpu::useReadback);
  buffers_.parts = gpu::Buffer(device, "film parts", aovs * sizeof(FilmParts), gpu::useStorage | gpu::useReadback);
  buffers_.counters =
      gpu::Buffer(device, "counters", kCounterCount * sizeof(std::uint32_t), gpu::useStorage | gpu::useReadback);
  set_.set(kBindSampleColor, buffers_.sampleColor);
  set_.set(kBindAovs, buffers_.aovs);
  set_.set(kBindFilm, buffers_.film);
  set_.set(kBindFilmParts, buffers_.parts);
  set_.set(kBindCounters, buffers_.counters);
  accumulate_ = gpu::ComputePipeline(device, layout_, gpu::embeddedShader("accumulate.comp"), {});
  const std::vector<std::uint32_t> zeros(kCounterCount, 0u);
  buffers_.counters.write(0, std::as_bytes(std::span(zeros)));
}

FilmResult Film::expose(Technique& technique, Tally& tally,
                        const std::function<void(std::uint64_t, std::uint64_t)>& progress) {
  FilmResult result;
  const std::size_t pixels = std::size_t{settings_.width} * settings_.height;
  result.picture.resize(pixels);
  if (settings_.wantAovs) result.aovs.resize(pixels);
  const std::uint64_t bands = (settings_.height + bandRows_ - 1) / bandRows_;
  const std::uint64_t total = bands * settings_.offsets.size();
  std::uint64_t done = 0;
  const auto step = [&] {
    ++done;
    if (progress) progress(done, total);
    throwIfInterrupted();
  };
  for (std::uint32_t row = 0; row < settings_.height; row += bandRows_) {
    exposeBand(technique, {row, std::min(bandRows_, settings_.height - row)}, tally, result, step);
  }
  readCounters(result);
  return result;
}

void Film::exposeBand(Technique& technique, const Band& band, Tally& tally, FilmResult& result,
                      const std::function<void()>& step) {
  Stopwatch watch;
  const bool centered = settings_.offsets.size() == 1 && settings_.offsets[0] == glm::vec2(0.5f);
  std::vector<AovRecord> centers;
  if (settings_.wantAovs && !centered) {
    clearAovs(band);
    technique.renderSample({band, settings_.width, glm::vec2(0.5f), false, true}, tally);
    centers = buffers_.aovs.readAll<AovRecord>();
  }
  bool first = true;
  for (const glm::vec2& offset : settings_.offsets) {
    if (settings_.wantAovs) clearAovs(band);
    technique.renderSample({band, settings_.width, offset, true, settings_.wantAovs}, tally);
    accumulate(band, first, tally);
    first = false;
    step();
  }
  result.renderMs += watch.lapMs();
  if (settings_.wantAovs && centered) centers = buffers_.aovs.readAll<AovRecord>();
  readBand(band, centers, result);
  result.readbackMs += watch.lapMs();
}

// "Nothing was hit": all zero but the ids.
void Film::clearAovs(const Band& band) {
  AovRecord nothing{};
  nothing.instanceId = nothing.primitiveId = nothing.materialId = kNoId;
  const std::vector<AovRecord> records(std::size_t{band.rowCount} * settings_.width, nothing);
  buffers_.aovs.write(0, std::as_bytes(std::span(records)));
}

void Film::accumulate(const Band& band, bool first, Tally& tally) {
  FilmPush push{};
  push.pixelCount = band.rowCount * settings_.width;
  push.firstPixel = band.firstRow * settings_.width;
  push.firstSample = first ? 1u : 0u;
  push.withParts = settings_.wantAovs ? 1u : 0u;
  commands_.begin();
  commands_.barrier();
  commands_.beginSpan("accumulate");
  commands_.bind(accumulate_, set_);
  commands_.push(push);
  commands_.dispatch((push.pixelCount + kGroupSize - 1) / kGroupSize);
  commands_.endSpan();
  commands_.barrier();
  commands_.submitAndWait();
  tally.add(commands_.spans());
}

void Film::readBand(const Band& band, const std::vector<AovRecord>& centers, FilmResult& result) {
  const std::size_t first = std::size_t{band.firstRow} * settings_.width;
  const std::size_t count = std::size_t{band.rowCount} * settings_.width;
  const auto samples = static_cast<double>(settings_.offsets.size());
  std::vector<FilmPixel> pixels(count);
  buffers_.film.read(0, std::as_writable_bytes(std::span(pixels)));
  for (std::size_t i = 0; i < count; ++i) {
    for (int c = 0; c < 4; ++c) {
      const double sum = static_cast<double>(pixels[i].sum[c]) - static_cast<double>(pixels[i].compensation[c]);
      result.picture[first + i][c] = static_cast<float>(sum / samples);
    }
  }
  if (!settings_.wantAovs) return;
  std::vector<FilmParts> parts(count);
  buffers_.parts.read(0, std::as_writable_bytes(std::span(parts)));
  const auto scale = static_cast<float>(1.0 / samples);
  for (std::size_t i = 0; i < count; ++i) {
    AovRecord aov = centers[i];
    aov.albedo = parts[i].albedo * scale;
    aov.ambient = parts[i].ambient * scale;
    aov.diffuse = parts[i].diffuse * scale;
    aov.specular = parts[i].specular * scale;
    aov.emission = parts[i].emission * scale;
    result.aovs[first + i] = aov;
  }
}

void Film::readCounters(FilmResult& result) {
  const std::vector<std::uint32_t> counters = buffers_.counters.readAll<std::uint32_t>();
  result.nonfinite = counters[kCounterNonfinite];
  result.firstNonfinitePixel = 0xffffffffu - counters[kCounterFirstNonfinite];
}

}  // namespace crosslight

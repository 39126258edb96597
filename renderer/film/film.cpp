#include "film/film.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/check.h"
#include "base/error.h"
#include "base/interrupt.h"
#include "base/time.h"

namespace crosslight {

using namespace shared;

namespace {

constexpr std::uint32_t kGroupSize = 64;  // local_size_x of the film's kernels
constexpr std::uint32_t kTileRows = 8;

std::vector<gpu::Binding> filmBindings(bool adaptive) {
  using enum gpu::BindingType;
  std::vector<gpu::Binding> bindings{{kBindSampleColor, storageBuffer},
                                     {kBindAovs, storageBuffer},
                                     {kBindFilm, storageBuffer},
                                     {kBindFilmParts, storageBuffer},
                                     {kBindCounters, storageBuffer}};
  if (adaptive) {
    for (const gpu::Binding& binding : AdaptiveTiles::bindings()) bindings.push_back(binding);
  }
  return bindings;
}

bool isAdaptive(const FilmSettings& s) { return s.adaptiveError > 0; }

// Per pixel of a band, of all buffers together and of the largest one.
std::uint64_t bytesPerPixel(const FilmSettings& s) {
  return sizeof(glm::vec4) + sizeof(FilmPixel) + (isAdaptive(s) ? sizeof(PixelMoments) : 0) +
         (s.wantAovs ? sizeof(AovRecord) + sizeof(FilmParts) : 0);
}
std::uint64_t largestBytesPerPixel(const FilmSettings& s) {
  return s.wantAovs ? sizeof(AovRecord) : std::max(sizeof(FilmPixel), isAdaptive(s) ? sizeof(PixelMoments) : 0);
}

std::uint32_t mostRows(const FilmSettings& s) {
  if (s.rows.empty()) return s.height;
  std::uint32_t most = 0;
  for (const Band& rows : s.rows) most = std::max(most, rows.rowCount);
  return most;
}

// So that no per-pixel buffer exceeds the device's limit for one buffer, and one dispatch reaches every pixel.
std::uint32_t rowsPerBand(const gpu::DeviceInfo& device, const FilmSettings& s) {
  const std::uint64_t bytes = largestBytesPerPixel(s) * s.width;
  const std::uint64_t rows =
      std::min(device.maxStorageBufferBytes / bytes, std::uint64_t{device.maxWorkGroupCountX} * kGroupSize / s.width);
  if (rows == 0) {
    throw DeviceError(fmt::format(
        "an image row of {} pixels needs {} bytes and {} workgroups, '{}' allows {} per buffer and {} per "
        "dispatch",
        s.width, bytes, s.width / kGroupSize, device.name, device.maxStorageBufferBytes, device.maxWorkGroupCountX));
  }
  // Whole tiles of rays, which are kTileRows high, where there is room for one.
  const std::uint64_t whole = rows < kTileRows ? rows : rows / kTileRows * kTileRows;
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(whole, mostRows(s)));
}

AovRecord emptyAov() {
  AovRecord nothing{};
  nothing.instanceId = nothing.primitiveId = nothing.materialId = kNoId;
  return nothing;
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

std::uint64_t filmBytes(const gpu::DeviceInfo& device, const FilmSettings& settings) {
  return std::uint64_t{rowsPerBand(device, settings)} * settings.width * bytesPerPixel(settings);
}

Film::Film(const gpu::Device& device, const FilmSettings& settings)
    : settings_(settings),
      bandRows_(rowsPerBand(device.info(), settings)),
      single_(settings.samples.size() == 1),
      readsSample_(single_ && device.info().isSoftware),
      commands_(device),
      layout_(device, filmBindings(isAdaptive(settings)), sizeof(FilmPush)),
      set_(device, layout_) {
  const std::uint64_t pixels = std::uint64_t{bandRows_} * settings.width;
  const std::uint64_t aovs = settings.wantAovs ? pixels : 1;
  if (settings.shownBy) {
    CL_CHECK(single_ && !settings.wantAovs && hasCodeTable(*settings.shownBy));
    buffers_.codeTable = gpu::Buffer::of(device, "display codes", displayCodeTable(), gpu::useUniformTexel);
    buffers_.displayGain = gainOf(*settings.shownBy);
  }
  buffers_.sampleColor = gpu::Buffer(device, "sample", pixels * sampleBytes(), gpu::useStorage);
  buffers_.aovs = gpu::Buffer(device, "AOV records", aovs * sizeof(AovRecord), gpu::useStorage | gpu::useReadback);
  const std::uint64_t filmBytes =
      readsSample_ ? sizeof(FilmPixel) : pixels * (single_ ? sampleBytes() : sizeof(FilmPixel));
  buffers_.film = gpu::Buffer(device, "film", filmBytes, gpu::useStorage | gpu::useReadback);
  buffers_.parts =
      gpu::Buffer(device, "film parts", (single_ ? 1 : aovs) * sizeof(FilmParts), gpu::useStorage | gpu::useReadback);
  buffers_.counters =
      gpu::Buffer(device, "counters", kCounterCount * sizeof(std::uint32_t), gpu::useStorage | gpu::useReadback);
  if (settings.wantAovs) {
    const std::vector<AovRecord> records(std::min<std::uint64_t>(pixels, kSlicePixels), emptyAov());
    emptyAovs_ = gpu::Buffer::of(device, "empty AOV records", records, gpu::useStorage);
  }
  set_.set(kBindSampleColor, buffers_.sampleColor);
  set_.set(kBindAovs, buffers_.aovs);
  set_.set(kBindFilm, buffers_.film);
  set_.set(kBindFilmParts, buffers_.parts);
  set_.set(kBindCounters, buffers_.counters);
  std::uint32_t variant = settings.wantAovs ? kVariantFilmParts : 0u;
  if (isAdaptive(settings)) {
    adaptive_ = std::make_unique<AdaptiveTiles>(device, layout_, settings.width, bandRows_, settings.adaptiveError);
    adaptive_->bind(set_);
    buffers_.tileList = &adaptive_->list();
    variant |= kVariantActiveTiles;
  }
  if (!single_)
    accumulate_ =
        gpu::ComputePipeline(device, layout_, gpu::embeddedShader("accumulate.comp"), {{kSpecVariant, variant}});
  resetCounters();
}

std::uint64_t Film::sampleBytes() const { return settings_.shownBy ? sizeof(std::uint32_t) : sizeof(glm::vec4); }

void Film::resetCounters() {
  const std::vector<std::uint32_t> zeros(kCounterCount, 0u);
  buffers_.counters.write(0, std::as_bytes(std::span(zeros)));
}

std::size_t Film::exposedPixels() const {
  std::size_t rows = settings_.rows.empty() ? settings_.height : 0;
  for (const Band& range : settings_.rows) rows += range.rowCount;
  return rows * settings_.width;
}

std::vector<Band> Film::bands() const {
  std::vector<Band> bands;
  const std::vector<Band> all{{0, settings_.height}};
  for (const Band& range : settings_.rows.empty() ? all : settings_.rows) {
    const std::uint32_t end = range.firstRow + range.rowCount;
    for (std::uint32_t row = range.firstRow; row < end; row += bandRows_) {
      bands.push_back({row, std::min(bandRows_, end - row)});
    }
  }
  return bands;
}

FilmResult Film::expose(Technique& technique, Tally& tally, const PixelSink& sink,
                        const std::function<void(std::uint64_t, std::uint64_t)>& progress) {
  FilmResult result;
  resetCounters();
  const std::vector<Band> all = bands();
  const std::uint64_t total = all.size() * settings_.samples.size();
  std::uint64_t done = 0;
  const auto step = [&] {
    ++done;
    if (progress) progress(done, total);
    throwIfInterrupted();
  };
  std::size_t firstPixel = 0;
  for (const Band& band : all) {
    Stopwatch watch;
    renderBand(technique, band, tally, step, result);
    result.renderMs += watch.lapMs();
    readBand(band, firstPixel, sink, result);
    result.readbackMs += watch.lapMs();
    firstPixel += std::size_t{band.rowCount} * settings_.width;
  }
  if (!single_) readCounters(result);
  return result;
}

// Leaves the sums of the samples in the film, and the AOVs of the pixels' centers in their buffer.
void Film::renderBand(Technique& technique, const Band& band, Tally& tally, const std::function<void()>& step,
                      FilmResult& result) {
  const bool centered = settings_.samples.size() == 1 && settings_.samples[0] == PixelSample{};
  if (adaptive_) adaptive_->begin(band.rowCount);
  for (std::uint32_t i = 0; i < settings_.samples.size(); ++i) {
    const PixelSample& sample = settings_.samples[i];
    if (adaptive_ && AdaptiveTiles::decidesAfter(i)) adaptive_->decide(commands_, set_, i);
    if (adaptive_ && adaptive_->count() == 0) {
      step();
      continue;
    }
    if (settings_.wantAovs) clearAovs(band);
    SampleRequest request{band, settings_.width, sample.offset, i};
    request.aovs = settings_.wantAovs;
    if (adaptive_) request.tiles = adaptive_->count();
    request.pixels = adaptive_ ? adaptive_->pixelCount() : std::uint64_t{band.rowCount} * settings_.width;
    technique.renderSample(request, tally);
    if (adaptive_) adaptive_->addSample(sample.weight);
    result.samples += request.pixels;
    if (single_) {
      fetchSample(band);
    } else {
      accumulate(band, i == 0, sample.weight, tally);
    }
    step();
  }
  const auto taken = static_cast<std::uint32_t>(settings_.samples.size());
  if (adaptive_ && adaptive_->count() > 0 && AdaptiveTiles::decidesAfter(taken))
    adaptive_->decide(commands_, set_, taken);
  if (adaptive_) result.pixelsNotDone += adaptive_->pixelCount();
  if (!settings_.wantAovs || centered) return;
  clearAovs(band);
  SampleRequest center{band, settings_.width};
  center.color = false;
  center.aovs = true;
  center.pixels = std::uint64_t{band.rowCount} * settings_.width;
  if (adaptive_) center.tiles = adaptive_->listAll();
  technique.renderSample(center, tally);
}

// "Nothing was hit": all zero but the ids.
void Film::clearAovs(const Band& band) {
  const std::uint64_t bytes = std::uint64_t{band.rowCount} * settings_.width * sizeof(AovRecord);
  commands_.begin();
  for (std::uint64_t at = 0; at < bytes; at += emptyAovs_.sizeBytes()) {
    commands_.copy(emptyAovs_, 0, buffers_.aovs, at, std::min(emptyAovs_.sizeBytes(), bytes - at));
  }
  commands_.barrier();
  commands_.submitAndWait();
}

void Film::accumulate(const Band& band, bool first, float weight, Tally& tally) {
  FilmPush push{};
  push.pixelCount = band.rowCount * settings_.width;
  push.firstPixel = band.firstRow * settings_.width;
  push.firstSample = first ? 1u : 0u;
  push.weight = weight;
  push.width = settings_.width;
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

// The one sample of a band to where the host reads it.
void Film::fetchSample(const Band& band) {
  if (readsSample_) return;
  commands_.begin();
  commands_.barrier();
  commands_.copy(buffers_.sampleColor, 0, buffers_.film, 0,
                 std::uint64_t{band.rowCount} * settings_.width * sampleBytes());
  commands_.barrier();
  commands_.submitAndWait();
}

}  // namespace crosslight

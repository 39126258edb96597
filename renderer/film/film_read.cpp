// The film's way back to the host: means, codes or the one sample, and what is known of the pixels' centers.
#include <algorithm>

#include "film/film.h"

namespace crosslight {

using namespace shared;

// In slices that stay in the cache between being read, divided and handed over.
void Film::readBand(const Band& band, std::size_t firstPixel, const PixelSink& sink, FilmResult& result) {
  if (settings_.shownBy) return readBandCodes(band, firstPixel, sink, result);
  const std::size_t count = std::size_t{band.rowCount} * settings_.width;
  std::vector<glm::vec4> picture(std::min(count, kSlicePixels));
  std::vector<AovRecord> aovs(settings_.wantAovs ? picture.size() : 0);
  for (std::size_t first = 0; first < count; first += kSlicePixels) {
    const std::size_t length = std::min(kSlicePixels, count - first);
    const std::span<glm::vec4> slice = std::span(picture).first(length);
    if (single_) {
      readSample(first, slice, band.firstRow * settings_.width + static_cast<std::uint32_t>(first), result);
    } else {
      readMean(first, slice);
    }
    ExposedPixels pixels{firstPixel + first, slice};
    if (settings_.wantAovs) {
      readAovs(first, std::span(aovs).first(length));
      pixels.aovs = std::span(aovs).first(length);
    }
    sink(pixels);
  }
}

// As the kernel and the mean would have it: zeros are positive, and pixels with a value that is not finite are counted.
void Film::readSample(std::size_t first, std::span<glm::vec4> picture, std::uint32_t firstPixel, FilmResult& result) {
  const gpu::Buffer& from = readsSample_ ? buffers_.sampleColor : buffers_.film;
  from.read(first * sizeof(glm::vec4), std::as_writable_bytes(picture));
  for (std::size_t i = 0; i < picture.size(); ++i) {
    glm::vec4& p = picture[i];
    p += 0.0f;
    const float sum = p.x * 0.0f + p.y * 0.0f + p.z * 0.0f + p.w * 0.0f;  // NaN unless all four are finite
    if (sum == 0.0f) continue;
    if (result.nonfinite++ == 0) result.firstNonfinitePixel = firstPixel + static_cast<std::uint32_t>(i);
  }
}

void Film::readBandCodes(const Band& band, std::size_t firstPixel, const PixelSink& sink, FilmResult& result) {
  const std::size_t count = std::size_t{band.rowCount} * settings_.width;
  const gpu::Buffer& from = readsSample_ ? buffers_.sampleColor : buffers_.film;
  std::vector<std::uint32_t> codes(std::min(count, kSlicePixels));
  for (std::size_t first = 0; first < count; first += kSlicePixels) {
    const std::span<std::uint32_t> slice = std::span(codes).first(std::min(kSlicePixels, count - first));
    from.read(first * sizeof(std::uint32_t), std::as_writable_bytes(slice));
    for (std::size_t i = 0; i < slice.size(); ++i) {
      if (slice[i] >= kFiniteCode || result.nonfinite++ > 0) continue;
      result.firstNonfinitePixel = band.firstRow * settings_.width + static_cast<std::uint32_t>(first + i);
    }
    sink({firstPixel + first, {}, slice});
  }
}

double Film::sumOfWeights() const {
  double sum = 0;
  for (const PixelSample& sample : settings_.samples) sum += sample.weight;
  return sum;
}

void Film::readMean(std::size_t first, std::span<glm::vec4> picture) {
  pixels_.resize(picture.size());
  buffers_.film.read(first * sizeof(FilmPixel), std::as_writable_bytes(std::span(pixels_)));
  const double all = sumOfWeights();
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const double weight = adaptive_ ? adaptive_->weightAt(first + i) : all;
    for (int c = 0; c < 4; ++c) {
      const double sum = static_cast<double>(pixels_[i].sum[c]) - static_cast<double>(pixels_[i].compensation[c]);
      picture[i][c] = static_cast<float>(sum / weight);
    }
  }
}

void Film::readAovs(std::size_t first, std::span<AovRecord> aovs) {
  buffers_.aovs.read(first * sizeof(AovRecord), std::as_writable_bytes(aovs));
  if (single_) return;  // its parts are their own means
  parts_.resize(aovs.size());
  buffers_.parts.read(first * sizeof(FilmParts), std::as_writable_bytes(std::span(parts_)));
  const double all = sumOfWeights();
  for (std::size_t i = 0; i < aovs.size(); ++i) {
    const auto scale = static_cast<float>(1.0 / (adaptive_ ? adaptive_->weightAt(first + i) : all));
    aovs[i].albedo = parts_[i].albedo * scale;
    aovs[i].ambient = parts_[i].ambient * scale;
    aovs[i].diffuse = parts_[i].diffuse * scale;
    aovs[i].specular = parts_[i].specular * scale;
    aovs[i].emission = parts_[i].emission * scale;
  }
}

void Film::readCounters(FilmResult& result) {
  const std::vector<std::uint32_t> counters = buffers_.counters.readAll<std::uint32_t>();
  result.nonfinite = counters[kCounterNonfinite];
  result.firstNonfinitePixel = 0xffffffffu - counters[kCounterFirstNonfinite];
}

}  // namespace crosslight

#include "film/adaptive_tiles.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace crosslight {

using namespace shared;

namespace {

std::uint32_t tilesAlong(std::uint32_t pixels) { return (pixels + kTileSize - 1) / kTileSize; }

template <class Item>
gpu::Buffer listOf(const gpu::Device& device, const char* name, std::uint64_t count, std::uint32_t use) {
  return {device, name, count * sizeof(Item), use};
}

}  // namespace

AdaptiveTiles::AdaptiveTiles(const gpu::Device& device, const gpu::BindingLayout& layout, std::uint32_t width,
                             std::uint32_t mostRows, float errorLimit)
    : width_(width), across_(tilesAlong(width)), errorLimit_(errorLimit) {
  const std::uint64_t tiles = std::uint64_t{across_} * tilesAlong(mostRows);
  list_ = listOf<std::uint32_t>(device, "tiles to sample", tiles, gpu::useUniformTexel);
  active_ = listOf<std::uint32_t>(device, "active tiles", tiles, gpu::useStorage);
  errors_ = listOf<float>(device, "errors of tiles", tiles, gpu::useStorage | gpu::useReadback);
  moments_ = listOf<PixelMoments>(device, "moments", std::uint64_t{width} * mostRows, gpu::useStorage);
  pipeline_ = gpu::ComputePipeline(device, layout, gpu::embeddedShader("tile_errors.comp"), {});
}

std::vector<gpu::Binding> AdaptiveTiles::bindings() {
  using enum gpu::BindingType;
  return {{kBindActiveTiles, storageBuffer}, {kBindTileErrors, storageBuffer}, {kBindMoments, storageBuffer}};
}

void AdaptiveTiles::bind(gpu::BindingSet& set) const {
  set.set(kBindActiveTiles, active_);
  set.set(kBindTileErrors, errors_);
  set.set(kBindMoments, moments_);
}

void AdaptiveTiles::begin(std::uint32_t bandRows) {
  bandRows_ = bandRows;
  down_ = tilesAlong(bandRows);
  left_.resize(std::size_t{across_} * down_);
  std::iota(left_.begin(), left_.end(), 0u);
  weights_.assign(left_.size(), 0.0);
  upload();
}

bool AdaptiveTiles::decidesAfter(std::uint32_t samples) {
  return samples >= kFewestSamples && std::has_single_bit(samples);
}

void AdaptiveTiles::addSample(float weight) {
  for (const std::uint32_t tile : left_) weights_[tile] += weight;
}

void AdaptiveTiles::decide(gpu::Commands& commands, gpu::BindingSet& set, std::uint32_t samples) {
  FilmPush push{};
  push.pixelCount = bandRows_ * width_;
  push.width = width_;
  push.samples = samples;
  commands.begin();
  commands.barrier();
  commands.bind(pipeline_, set);
  commands.push(push);
  commands.dispatch(across_ * down_);
  commands.barrier();
  commands.submitAndWait();
  std::vector<float> errors(std::size_t{across_} * down_);
  errors_.read(0, std::as_writable_bytes(std::span(errors)));
  // A detail that no sample has met yet is most likely beside one that some have.
  const auto needsMore = [&](std::uint32_t tile) {
    const std::uint32_t x = tile % across_, y = tile / across_;
    for (std::uint32_t v = y - std::min(y, 1u); v <= std::min(y + 1, down_ - 1); ++v) {
      for (std::uint32_t u = x - std::min(x, 1u); u <= std::min(x + 1, across_ - 1); ++u) {
        if (errors[std::size_t{v} * across_ + u] > errorLimit_) return true;
      }
    }
    return false;
  };
  std::erase_if(left_, [&](std::uint32_t tile) { return !needsMore(tile); });
  upload();
}

void AdaptiveTiles::upload() {
  std::vector<std::uint32_t> active(weights_.size(), 0u);
  for (const std::uint32_t tile : left_) active[tile] = 1u;
  active_.write(0, std::as_bytes(std::span(active)));
  if (!left_.empty()) list_.write(0, std::as_bytes(std::span(left_)));
}

std::uint32_t AdaptiveTiles::listAll() {
  std::vector<std::uint32_t> all(weights_.size());
  std::iota(all.begin(), all.end(), 0u);
  list_.write(0, std::as_bytes(std::span(all)));
  return static_cast<std::uint32_t>(all.size());
}

std::uint64_t AdaptiveTiles::pixelsOf(std::uint32_t tile) const {
  const std::uint32_t x = tile % across_ * kTileSize, y = tile / across_ * kTileSize;
  return std::uint64_t{std::min(kTileSize, width_ - x)} * std::min(kTileSize, bandRows_ - y);
}

std::uint64_t AdaptiveTiles::pixelCount() const {
  std::uint64_t pixels = 0;
  for (const std::uint32_t tile : left_) pixels += pixelsOf(tile);
  return pixels;
}

double AdaptiveTiles::weightAt(std::size_t pixelOfBand) const {
  const std::size_t x = pixelOfBand % width_ / kTileSize, y = pixelOfBand / width_ / kTileSize;
  return weights_[y * across_ + x];
}

}  // namespace crosslight

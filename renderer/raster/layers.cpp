#include "raster/layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "base/error.h"
#include "base/log.h"

namespace crosslight {

using namespace shared;

namespace {

constexpr std::uint64_t kFewestFragments = 1u << 16;
constexpr std::uint64_t kWord = sizeof(std::uint32_t);

std::uint32_t mostOf(const gpu::Device& device, std::uint64_t maxBytes) {
  const std::uint64_t bytes = std::min(maxBytes, device.info().maxStorageBufferBytes);
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(bytes / sizeof(LayerRecord), kNoLayer));
}

gpu::Buffer listsOf(const gpu::Device& device, std::uint32_t capacity) {
  return {device, "transparent fragments", std::uint64_t{capacity} * sizeof(LayerRecord), gpu::useStorage};
}

}  // namespace

Layers::Layers(const gpu::Device& device, std::uint32_t width, std::uint32_t rows, std::uint32_t samples,
               std::uint64_t maxBytes)
    : device_(device),
      width_(width),
      samples_(samples),
      rowsAtOnce_(rows),
      mostCapacity_(mostOf(device, maxBytes)),
      heads_(device, "heads of transparent fragments", kWord * samplesPerRow() * rows, gpu::useStorage),
      counts_(device, "counts of transparent fragments", kWord * kLayerCounts, gpu::useStorage | gpu::useReadback) {
  if (!device.info().canBlendPerChannel || !device.info().hasSampleShading) {
    throw DeviceError("transparency by raster methods needs the features dualSrcBlend and sampleRateShading, which " +
                      device.info().name + " has not: render by rays (--method whitted)");
  }
  // One per sample to begin with.
  capacity_ = static_cast<std::uint32_t>(
      std::min<std::uint64_t>(std::max(samplesPerRow() * rows, kFewestFragments), mostCapacity_));
  layers_ = listsOf(device, capacity_);
}

std::vector<gpu::Binding> Layers::bindings() {
  using enum gpu::BindingType;
  return {{kBindLayerHeads, storageBuffer}, {kBindLayers, storageBuffer}, {kBindLayerCounts, storageBuffer}};
}

void Layers::bind(gpu::BindingSet& set) const {
  set.set(kBindLayerHeads, heads_);
  set.set(kBindLayers, layers_);
  set.set(kBindLayerCounts, counts_);
}

gpu::Constants Layers::constants() const {
  const std::uint32_t passes = device_.info().maxLoopPasses;
  return {{kSpecSamples, samples_}, {kSpecLoopPasses, passes > 0 ? passes - 1 : ~0u}};
}

void Layers::clear(gpu::Commands& commands, std::uint32_t rows) const {
  commands.fill(heads_, 0, kWord * samplesPerRow() * rows, kNoLayer);
  commands.fill(counts_, 0, kWord * kLayerCounts, 0);
}

void Layers::grow(std::uint64_t fragments, gpu::BindingSet& set) {
  capacity_ = static_cast<std::uint32_t>(std::min<std::uint64_t>(fragments, mostCapacity_));
  layers_ = {};  // before the new one, so that both are never there
  layers_ = listsOf(device_, capacity_);
  set.set(kBindLayers, layers_);
  logVerbose(fmt::format("{} transparent fragments: room for {} MiB", fragments,
                         std::uint64_t{capacity_} * sizeof(LayerRecord) >> 20));
}

bool Layers::keptAll(const Band& rows, gpu::BindingSet& set) {
  std::array<std::uint32_t, kLayerCounts> counts{};
  counts_.read(0, std::as_writable_bytes(std::span(counts)));
  const std::uint64_t fragments = counts[kLayersTooMany] != 0 ? std::uint64_t{1} << 32 : counts[kLayersWanted];
  mostFragments_ = std::max(mostFragments_, fragments);
  if (fragments > capacity_) {
    if (fragments > mostCapacity_ && rows.rowCount == 1) {
      throw DeviceError(fmt::format(
          "row {} has {} transparent fragments, and lists hold {} ({} MiB): render fewer columns, or by rays (--method "
          "whitted)",
          rows.firstRow, fragments, mostCapacity_, std::uint64_t{mostCapacity_} * sizeof(LayerRecord) >> 20));
    }
    if (fragments > mostCapacity_) {
      const std::uint64_t fit = std::uint64_t{rows.rowCount} * mostCapacity_ / fragments;
      rowsAtOnce_ = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(fit, 1, rows.rowCount - 1));
    }
    if (capacity_ < mostCapacity_) grow(fragments, set);
    return false;
  }
  if (counts[kLayersCutShort] != 0) {
    throw DeviceError(fmt::format(
        "in rows {} to {} so many transparent surfaces lie behind one pixel that sorting them takes more than the {} "
        "passes which this driver ({}) allows a shader's loops: render by rays (--method whitted) or on another device",
        rows.firstRow, rows.firstRow + rows.rowCount - 1, device_.info().maxLoopPasses, device_.info().driverName));
  }
  return true;
}

}  // namespace crosslight

// Which tiles of a band still get samples: those in or beside which some pixel's mean is not yet known well enough.
#pragma once

#include <cstdint>
#include <vector>

#include "bindings.h"
#include "gpu/commands.h"
#include "gpu/memory.h"
#include "gpu/pipeline.h"

namespace crosslight {

// Tiles are 8 x 8 pixels, row after row of the band. Decisions fall when the number of samples is a power of two, where
// every prefix of the sequence is a net, and from kFewestSamples on.
class AdaptiveTiles {
 public:
  static constexpr std::uint32_t kFewestSamples = 8;

  // `errorLimit`: of a channel's mean, linear. Tiles of bands of up to `mostRows` rows. `layout` has bindings().
  AdaptiveTiles(const gpu::Device& device, const gpu::BindingLayout& layout, std::uint32_t width,
                std::uint32_t mostRows, float errorLimit);
  static std::vector<gpu::Binding> bindings();
  void bind(gpu::BindingSet& set) const;

  void begin(std::uint32_t bandRows);  // all tiles, no samples
  static bool decidesAfter(std::uint32_t samples);
  // From the moments that accumulate.comp keeps: drops the tiles that have enough.
  void decide(gpu::Commands& commands, gpu::BindingSet& set, std::uint32_t samples);
  void addSample(float weight);  // of the tiles that are left

  const gpu::Buffer& list() const { return list_; }
  std::uint32_t count() const { return static_cast<std::uint32_t>(left_.size()); }
  std::uint32_t listAll();           // lists all tiles, for a sample that is no part of the means; how many
  std::uint64_t pixelCount() const;  // of the tiles that are left, within the band
  double weightAt(std::size_t pixelOfBand) const;

 private:
  void upload();
  std::uint64_t pixelsOf(std::uint32_t tile) const;

  std::uint32_t width_, across_, down_ = 0, bandRows_ = 0;
  float errorLimit_;
  std::vector<std::uint32_t> left_;  // tiles, ascending
  std::vector<double> weights_;      // sum over its samples, of each tile
  gpu::Buffer list_, active_, errors_, moments_;
  gpu::ComputePipeline pipeline_;
};

}  // namespace crosslight

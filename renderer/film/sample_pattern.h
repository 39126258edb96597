// Where within a pixel samples lie and what each counts: the same for every pixel and every technique, so that pictures
// can be compared and raster can follow by moving the image.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace crosslight {

// Density of the samples about the pixel's center; its reach in pixels to each side: box 1/2, tent 1, gaussian 3/2 (its
// deviation is 1/2), mitchell 2 (Mitchell, Netravali 1988, "Reconstruction Filters in Computer Graphics", Eq. 8 with
// B = C = 1/3).
enum class FilterShape { box, tent, gaussian, mitchell };

// sobol: a (0,2)-sequence (Sobol 1967), scrambled for seeds other than 0 (Owen 1995, "Randomly Permuted (t,m,s)-Nets
// and (t,s)-Sequences"); regular: centers of a grid; jittered: one sample anywhere in each cell of that grid.
enum class SamplePlacement { sobol, regular, jittered };

struct PixelSample {
  glm::vec2 offset{0.5f};  // pixels from the upper left corner; outside of [0,1] where the filter reaches further
  float weight = 1.0f;     // 1, or -1 where the filter is negative; the mean is divided by their sum

  bool operator==(const PixelSample&) const = default;
};

// One sample is the pixel's center. The weights' sum is positive: a pattern whose negative samples outweigh the others
// (mitchell, few samples) takes the filter's positive part alone.
std::vector<PixelSample> samplePattern(std::uint32_t count, FilterShape filter, std::uint64_t seed,
                                       SamplePlacement placement = SamplePlacement::sobol);

// Grid of `regular` and `jittered`: the most nearly square one with exactly `count` cells.
struct SampleGrid {
  std::uint32_t columns = 1, rows = 1;
};
SampleGrid sampleGrid(std::uint32_t count);

}  // namespace crosslight

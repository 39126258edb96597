// Working data of the BVH builder: boxes as four lanes, references that are partitioned in place, and the choice of a
// split. Private to the room; bvh.h is the interface.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>

#include "accel/bvh.h"

namespace crosslight::accel {

// A box whose fourth lane is carried along but means nothing: four lanes compile to one vector register.
struct alignas(16) Box {
  float lower[4];
  float upper[4];

  static Box none() {
    constexpr float inf = std::numeric_limits<float>::infinity();
    return {{inf, inf, inf, inf}, {-inf, -inf, -inf, -inf}};
  }
  void add(const Box& other) {
    for (int i = 0; i < 4; ++i) lower[i] = other.lower[i] < lower[i] ? other.lower[i] : lower[i];
    for (int i = 0; i < 4; ++i) upper[i] = other.upper[i] > upper[i] ? other.upper[i] : upper[i];
  }
  void addPoint(const float (&p)[4]) {
    for (int i = 0; i < 4; ++i) lower[i] = p[i] < lower[i] ? p[i] : lower[i];
    for (int i = 0; i < 4; ++i) upper[i] = p[i] > upper[i] ? p[i] : upper[i];
  }
  // Half the surface area; double, because the product of two float extents can overflow.
  double halfArea() const {
    const double x = double{upper[0]} - lower[0], y = double{upper[1]} - lower[1], z = double{upper[2]} - lower[2];
    return x < 0 ? 0.0 : x * y + y * z + z * x;
  }
};

// A primitive's box; the fourth lane of `lower` holds its index as a bit pattern, so that references move as a whole.
struct Reference : Box {
  std::uint32_t index() const { return std::bit_cast<std::uint32_t>(lower[3]); }
  // Halved before adding: the sum of two large floats may overflow.
  float center(int axis) const { return 0.5f * lower[axis] + 0.5f * upper[axis]; }
  void center(float (&p)[4]) const {
    for (int i = 0; i < 3; ++i) p[i] = center(i);
    p[3] = 0;
  }
};

// References [begin, begin + count) that become one subtree, whose inner nodes take the slots from `slot` on.
struct Work {
  Box bounds = Box::none();
  Box centers = Box::none();
  std::uint32_t begin = 0;
  std::uint32_t count = 0;
  std::uint32_t slot = 0;
  std::uint32_t parentSlot = shared::kNoId;
  std::uint32_t depth = 0;  // inner nodes above

  void add(const Reference& reference) {
    bounds.add(reference);
    float p[4];
    reference.center(p);
    centers.addPoint(p);
    ++count;
  }
};

// Which bin a center falls into; the same expression when counting and when partitioning, so the counts agree.
struct BinMapping {
  float origin = 0;
  float scale = 0;  // 0: the axis has no extent that floats can divide
  float last = 0;

  BinMapping() = default;
  BinMapping(const Box& centers, int axis, std::uint32_t bins) : origin(centers.lower[axis]) {
    const double extent = double{centers.upper[axis]} - origin;
    const double candidate = extent > 0 ? static_cast<double>(bins) / extent : 0.0;
    last = static_cast<float>(bins - 1);
    if (candidate <= double{std::numeric_limits<float>::max()}) scale = static_cast<float>(candidate);
  }
  // The difference may be +infinity (extent beyond FLT_MAX) but never NaN: centers are finite and scale is positive.
  std::uint32_t operator()(float center) const {
    return static_cast<std::uint32_t>(std::min((center - origin) * scale, last));
  }
};

struct Split {
  bool found = false;
  int axis = 0;
  std::uint32_t bin = 0;  // bins up to this one go to the lower side
  double cost = 0;        // of the two children's primitives, in tests per ray that meets this node
  std::uint32_t lowerCount = 0;
  BinMapping mapping;
};

// Cheapest split between bins, by the surface-area heuristic. Not found: no axis separates the centers.
Split findSplit(std::span<const Reference> references, const Work& work, std::uint32_t binCount);

// Fills bvh.stats but for the time.
void takeStats(Bvh& bvh);

}  // namespace crosslight::accel

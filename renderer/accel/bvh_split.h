// The choice of a split between bins of centers. Private to the room.
#pragma once

#include <span>

#include "accel/bvh_box.h"

namespace crosslight::accel {

inline constexpr std::uint32_t kMaxBins = 32;

// Which bin a center falls into; the same expression when counting and when partitioning, so the counts agree.
struct BinMapping {
  Float4 origin = splat(0);
  Float4 scale = splat(0);  // 0: the axis has no extent that floats can divide; all is in bin 0
  Float4 last = splat(0);

  BinMapping() = default;
  BinMapping(const Box& centers, std::uint32_t bins);
  Int4 operator()(const Float4& center) const {
    return __builtin_convertvector(minimum((center - origin) * scale, last), Int4);
  }
};

// Three axes' bins of one number, and their primitives, side by side.
struct alignas(128) Bin {
  Box boxes[3];
  Int4 counts{};
};

struct Bins {
  Bin list[kMaxBins];

  // Clears `binCount` bins and adds the references to them.
  void fill(std::uint32_t binCount, std::span<const Reference> references, const BinMapping& mapping);
  void add(const Bins& other, std::uint32_t binCount);

 private:
  void clear(std::uint32_t binCount);
};

struct Split {
  bool found = false;
  std::uint32_t axis = 0;
  std::uint32_t bin = 0;  // bins up to this one go to the lower side
  double cost = 0;        // of the two children's primitives, in tests per ray that meets this node
  std::uint32_t lowerCount = 0;
  BinMapping mapping;

  // center < threshold of bin + 1 is what truncation in BinMapping says of "bin <= this bin".
  bool isLower(const Reference& r) const {
    return (r.center(static_cast<int>(axis)) - mapping.origin[axis]) * mapping.scale[axis] <
           static_cast<float>(bin + 1);
  }
};

// Bins that pay for `count` primitives: choosing among many costs more than it gains where there are few.
std::uint32_t usefulBins(std::uint32_t count, std::uint32_t most);

// Cheapest split between bins by the surface-area heuristic. Not found: no axis separates the centers.
// `unit` is the tree's (see areaUnit).
Split chooseSplit(const Bins& bins, std::uint32_t binCount, const BinMapping& mapping, const Box& bounds, float unit);
// Boxes on both sides of the split.
void boxesOfSides(const Bins& bins, std::uint32_t binCount, const Split& split, Box& lower, Box& upper);

// Lanes 0 to 2: half the surface areas of three boxes whose extents are first multiplied by `unit`; 0 for empty boxes.
inline Float4 halfAreas(const Box& a, const Box& b, const Box& c, const Float4& unit) {
  const auto products = [&](const Box& box) {
    const Float4 e = maximum((box.upper - box.lower) * unit, splat(0));
    return e * __builtin_shufflevector(e, e, 1, 2, 0, 3);
  };
  const Float4 pa = products(a), pb = products(b), pc = products(c);
  const Float4 low = __builtin_shufflevector(pa, pb, 0, 4, 1, 5);
  const Float4 high = __builtin_shufflevector(pa, pb, 2, 6, 3, 7);
  return __builtin_shufflevector(low, pc, 0, 1, 4, 7) + __builtin_shufflevector(low, pc, 2, 3, 5, 7) +
         __builtin_shufflevector(high, pc, 0, 1, 6, 7);
}

// A power of two that brings the tree's largest extent near 1, so that areas in float neither overflow nor vanish
// before they are 2^-100 of the root's.
float areaUnit(const Box& bounds);

}  // namespace crosslight::accel

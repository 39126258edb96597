// The binned surface-area heuristic: Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies". The
// three axes are swept together, one in each lane.
#include "accel/bvh_split.h"

#include <algorithm>
#include <cmath>

namespace crosslight::accel {
namespace {

// Areas below this share of the tree's are chosen among in double: near it float loses their differences.
constexpr float kSmallestArea = 0x1p-100f;

struct Best {
  Float4 cost = splat(kInfinity);
  Int4 bin{};
  Int4 lowerCount{};
};

Best sweep(const Bins& bins, std::uint32_t binCount, float unitOfArea) {
  const Float4 unit = splat(unitOfArea);
  Float4 upperCost[kMaxBins];
  Box upper[3];
  Int4 count{};
  for (std::uint32_t i = binCount - 1; i > 0; --i) {
    for (int axis = 0; axis < 3; ++axis) upper[axis].add(bins.list[i].boxes[axis]);
    count += bins.list[i].counts;
    upperCost[i] = halfAreas(upper[0], upper[1], upper[2], unit) * __builtin_convertvector(count, Float4);
  }
  const Int4 total = count + bins.list[0].counts;
  Best best;
  Box lower[3];
  count = Int4{};
  for (std::uint32_t i = 0; i + 1 < binCount; ++i) {
    for (int axis = 0; axis < 3; ++axis) lower[axis].add(bins.list[i].boxes[axis]);
    count += bins.list[i].counts;
    const Float4 cost =
        halfAreas(lower[0], lower[1], lower[2], unit) * __builtin_convertvector(count, Float4) + upperCost[i + 1];
    const auto better = (cost < best.cost) & (count > 0) & (count < total);
    const auto bin = static_cast<std::int32_t>(i);
    best.cost = better ? cost : best.cost;
    best.bin = better ? Int4{bin, bin, bin, bin} : best.bin;
    best.lowerCount = better ? count : best.lowerCount;
  }
  return best;
}

// For nodes whose areas floats cannot tell apart: flat, on a line, in one point, or tiny beside the tree.
void improveInDouble(const Bins& bins, std::uint32_t binCount, std::uint32_t axis, double area, Split& best) {
  double upperCost[kMaxBins] = {};
  Box upper;
  std::int32_t upperCount = 0;
  for (std::uint32_t i = binCount - 1; i > 0; --i) {
    upper.add(bins.list[i].boxes[axis]);
    upperCount += bins.list[i].counts[axis];
    upperCost[i] = upper.halfArea() * upperCount;
  }
  const std::int32_t total = upperCount + bins.list[0].counts[axis];
  Box lower;
  std::int32_t lowerCount = 0;
  for (std::uint32_t i = 0; i + 1 < binCount; ++i) {
    lower.add(bins.list[i].boxes[axis]);
    lowerCount += bins.list[i].counts[axis];
    if (lowerCount == 0 || lowerCount == total) continue;
    // A node without area (its primitives lie on one line) is met by no ray in particular: count its primitives.
    const double cost = area > 0 ? (lower.halfArea() * lowerCount + upperCost[i + 1]) / area
                                 : static_cast<double>(std::max(lowerCount, total - lowerCount));
    if (best.found && !(cost < best.cost)) continue;
    best.found = true;
    best.axis = axis;
    best.bin = i;
    best.cost = cost;
    best.lowerCount = static_cast<std::uint32_t>(lowerCount);
  }
}

}  // namespace

BinMapping::BinMapping(const Box& centers, std::uint32_t bins) : origin(centers.lower) {
  const Float4 extent = centers.upper - centers.lower;
  scale = static_cast<float>(bins) / extent;
  // Not (x < infinity) but written so that NaN becomes 0 too: 0 / 0 cannot be, infinity / infinity can.
  scale = (extent > 0) & (scale <= std::numeric_limits<float>::max()) ? scale : splat(0);
  origin[3] = scale[3] = 0;
  last = splat(static_cast<float>(bins - 1));
}

void Bins::clear(std::uint32_t bins) { std::fill_n(list, bins, Bin{}); }

void Bins::fill(std::uint32_t binCount, std::span<const Reference> references, const BinMapping& mapping) {
  clear(binCount);
  auto* const bytes = reinterpret_cast<std::byte*>(list);
  for (const Reference& r : references) {
    const Int4 offset = mapping(r.center()) * static_cast<std::int32_t>(sizeof(Bin));
    for (int axis = 0; axis < 3; ++axis) {
      Bin& bin = *reinterpret_cast<Bin*>(bytes + offset[axis]);
      bin.boxes[axis].add(r);
      ++bin.counts[axis];
    }
  }
}

void Bins::add(const Bins& other, std::uint32_t bins) {
  for (std::uint32_t i = 0; i < bins; ++i) {
    for (int axis = 0; axis < 3; ++axis) list[i].boxes[axis].add(other.list[i].boxes[axis]);
    list[i].counts += other.list[i].counts;
  }
}

std::uint32_t usefulBins(std::uint32_t count, std::uint32_t most) { return std::min(most, 4 + count / 4); }

Split chooseSplit(const Bins& bins, std::uint32_t binCount, const BinMapping& mapping, const Box& bounds, float unit) {
  Split split;
  split.mapping = mapping;
  const float area = halfAreas(bounds, bounds, bounds, splat(unit))[0];
  if (area >= kSmallestArea && area <= std::numeric_limits<float>::max()) {
    const Best best = sweep(bins, binCount, unit);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const double cost = double{best.cost[axis]} / area;
      if (!(mapping.scale[axis] > 0) || !(best.cost[axis] < kInfinity) || (split.found && !(cost < split.cost)))
        continue;
      split.found = true;
      split.axis = axis;
      split.bin = static_cast<std::uint32_t>(best.bin[axis]);
      split.cost = cost;
      split.lowerCount = static_cast<std::uint32_t>(best.lowerCount[axis]);
    }
    return split;
  }
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    if (mapping.scale[axis] > 0) improveInDouble(bins, binCount, axis, bounds.halfArea(), split);
  }
  return split;
}

void boxesOfSides(const Bins& bins, std::uint32_t binCount, const Split& split, Box& lower, Box& upper) {
  lower = upper = Box();
  for (std::uint32_t i = 0; i < binCount; ++i) (i <= split.bin ? lower : upper).add(bins.list[i].boxes[split.axis]);
}

float areaUnit(const Box& bounds) {
  double extent = 0;
  for (int axis = 0; axis < 3; ++axis) extent = std::max(extent, double{bounds.upper[axis]} - bounds.lower[axis]);
  if (!(extent > 0)) return 1.0f;
  constexpr int kLargestExponent = 126;
  return static_cast<float>(std::ldexp(1.0, std::clamp(-std::ilogb(extent), -kLargestExponent, kLargestExponent)));
}

}  // namespace crosslight::accel

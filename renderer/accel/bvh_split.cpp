// The binned surface-area heuristic: Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies".
#include <array>

#include "accel/bvh_builder.h"

namespace crosslight::accel {
namespace {

constexpr std::uint32_t kMaxBins = 64;

struct Bins {
  std::array<Box, kMaxBins> boxes;
  std::array<std::uint32_t, kMaxBins> counts;

  void clear(std::uint32_t bins) {
    std::fill_n(boxes.begin(), bins, Box::none());
    std::fill_n(counts.begin(), bins, 0u);
  }
};

void improveSplit(const Bins& bins, std::uint32_t count, int axis, const BinMapping& mapping, double area,
                  Split& best) {
  std::array<double, kMaxBins> upperCost{};
  Box upper = Box::none();
  std::uint32_t upperCount = 0;
  for (std::uint32_t i = count - 1; i > 0; --i) {
    upper.add(bins.boxes[i]);
    upperCount += bins.counts[i];
    upperCost[i] = upper.halfArea() * upperCount;
  }
  const std::uint32_t total = upperCount + bins.counts[0];
  Box lower = Box::none();
  std::uint32_t lowerCount = 0;
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    lower.add(bins.boxes[i]);
    lowerCount += bins.counts[i];
    if (lowerCount == 0 || lowerCount == total) continue;
    // A node without area (its primitives lie on one line) is met by no ray in particular: count its primitives.
    const double cost = area > 0 ? (lower.halfArea() * lowerCount + upperCost[i + 1]) / area
                                 : static_cast<double>(std::max(lowerCount, total - lowerCount));
    if (best.found && !(cost < best.cost)) continue;
    best = Split{true, axis, i, cost, lowerCount, mapping};
  }
}

}  // namespace

Split findSplit(std::span<const Reference> references, const Work& work, std::uint32_t binCount) {
  const std::uint32_t bins = std::min({binCount, kMaxBins, 2 * work.count});
  std::array<Bins, 3> axes;
  std::array<BinMapping, 3> mappings;
  for (int axis = 0; axis < 3; ++axis) {
    axes[static_cast<std::size_t>(axis)].clear(bins);
    mappings[static_cast<std::size_t>(axis)] = BinMapping(work.centers, axis, bins);
  }
  // An axis without extent has scale 0: everything lands in its bin 0 and no split is found there.
  for (const Reference& reference : references) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t bin = mappings[axis](reference.center(static_cast<int>(axis)));
      axes[axis].boxes[bin].add(reference);
      ++axes[axis].counts[bin];
    }
  }
  Split best;
  const double area = work.bounds.halfArea();
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    if (mappings[i].scale > 0) improveSplit(axes[i], bins, axis, mappings[i], area, best);
  }
  return best;
}

}  // namespace crosslight::accel

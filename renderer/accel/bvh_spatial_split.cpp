#include "accel/bvh_spatial_split.h"

#include <algorithm>
#include <utility>

namespace crosslight::accel {
namespace {

constexpr int kMostBins = 16;

struct SpatialBins {
  Box boxes[kMostBins];
  std::uint32_t enter[kMostBins] = {}, leave[kMostBins] = {};
  int count = 0;
  float planes[kMostBins + 1];  // planes[i] and [i + 1] bound bin i
  float scale = 0;              // bins per length
};

// False: the axis is too short for so many different planes.
bool setPlanes(const Box& bounds, int axis, SpatialBins& bins) {
  const double low = bounds.lower[axis], extent = double{bounds.upper[axis]} - low;
  for (int i = 0; i <= bins.count; ++i) {
    bins.planes[i] = static_cast<float>(low + extent * i / bins.count);
    if (i > 0 && !(bins.planes[i] > bins.planes[i - 1])) return false;
  }
  bins.planes[bins.count] = bounds.upper[axis];
  bins.scale = static_cast<float>(bins.count / extent);
  return bins.scale <= std::numeric_limits<float>::max();
}

// The bin that holds x, by a guess that rounding may put one off.
int binOf(const SpatialBins& bins, float x) {
  int bin = static_cast<int>(std::clamp((x - bins.planes[0]) * bins.scale, 0.0f, static_cast<float>(bins.count - 1)));
  while (bin > 0 && x < bins.planes[bin]) --bin;
  while (bin + 1 < bins.count && x >= bins.planes[bin + 1]) ++bin;
  return bin;
}

bool isEmpty(const Box& box) {
  return !(box.lower[0] <= box.upper[0] && box.lower[1] <= box.upper[1] && box.lower[2] <= box.upper[2]);
}

// Adds the points of the edge from a to b to the boxes of the bins that it passes, from `first` to `last`. Rounded to
// nearest: what is chosen by these boxes is cut exactly later.
void addEdge(Float4 a, Float4 b, int axis, const SpatialBins& bins, int first, int last, Box* parts) {
  const int own = binOf(bins, a[axis]);
  if (own >= first && own <= last) parts[own].addPoint(a);
  if (a[axis] > b[axis]) std::swap(a, b);
  const Float4 slope = (b - a) / splat(b[axis] - a[axis]);
  const int from = std::max(binOf(bins, a[axis]), first), to = std::min(binOf(bins, b[axis]), last);
  for (int plane = from + 1; plane <= to; ++plane) {
    const Float4 crossing = a + slope * splat(bins.planes[plane] - a[axis]);
    parts[plane - 1].addPoint(crossing);
    parts[plane].addPoint(crossing);
  }
}

void addReference(const BvhTriangles& triangles, const Reference& r, int axis, SpatialBins& bins) {
  const int first = binOf(bins, r.lower[axis]);
  int last = first;
  while (last + 1 < bins.count && r.upper[axis] > bins.planes[last + 1]) ++last;
  ++bins.enter[first];
  ++bins.leave[last];
  if (first == last) return bins.boxes[first].add(r);
  Box parts[kMostBins];
  const Corners corners = cornersOf(triangles, r.index());
  const auto corner = [&](int k) {
    const glm::vec3& p = corners.points[k % 3];
    return Float4{p.x, p.y, p.z, 0};
  };
  for (int k = 0; k < 3; ++k) addEdge(corner(k), corner(k + 1), axis, bins, first, last, parts);
  for (int b = first; b <= last; ++b) {
    parts[b].lower = maximum(parts[b].lower, r.lower);
    parts[b].upper = minimum(parts[b].upper, r.upper);
    if (!isEmpty(parts[b])) bins.boxes[b].add(parts[b]);
  }
}

void improve(const SpatialBins& bins, int axis, const SpatialRange& range, double area, SpatialSplit& best) {
  double upperCost[kMostBins] = {};
  Box uppers[kMostBins];
  std::uint32_t upperCounts[kMostBins] = {};
  Box upper;
  std::uint32_t upperCount = 0;
  for (int i = bins.count - 1; i > 0; --i) {
    upper.add(bins.boxes[i]);
    upperCount += bins.leave[i];
    uppers[i] = upper;
    upperCounts[i] = upperCount;
    upperCost[i] = upper.halfArea() * upperCount;
  }
  Box lower;
  std::uint32_t lowerCount = 0;
  for (int i = 0; i + 1 < bins.count; ++i) {
    lower.add(bins.boxes[i]);
    lowerCount += bins.enter[i];
    const std::uint32_t most = std::max(lowerCount, upperCounts[i + 1]);
    if (lowerCount == 0 || upperCounts[i + 1] == 0 || most >= range.count()) continue;
    if (lowerCount + upperCounts[i + 1] > range.count() + range.budget || !fitsDepth(range.depth, most)) continue;
    const double cost = (lower.halfArea() * lowerCount + upperCost[i + 1]) / area;
    if (best.found && !(cost < best.cost)) continue;
    best = {true, axis, bins.planes[i + 1], cost, {lower, uppers[i + 1]}, {lowerCount, upperCounts[i + 1]}};
  }
}

}  // namespace

SpatialSplit chooseSpatialSplit(const BvhTriangles& triangles, const SpatialRange& range) {
  SpatialSplit best;
  const double area = range.bounds.halfArea();
  if (!(area > 0) || range.budget == 0) return best;
  for (int axis = 0; axis < 3; ++axis) {
    SpatialBins bins;
    bins.count = static_cast<int>(usefulBins(range.count(), kMostBins));
    if (!setPlanes(range.bounds, axis, bins)) continue;
    for (const Reference& r : range.references) addReference(triangles, r, axis, bins);
    improve(bins, axis, range, area, best);
  }
  return best;
}

namespace {

// Gives the references that straddle a split's plane to its sides: section 4.4, "reference unsplitting".
class Sides {
 public:
  Sides(const SpatialSplit& split, SpatialRange (&children)[2]) : children_(children) {
    for (int c = 0; c < 2; ++c) {
      planned_[c] = split.sides[c];
      counts_[c] = split.counts[c];
    }
  }

  void give(const Reference& r, const Box (&parts)[2]) {
    const double areas[2] = {planned_[0].halfArea(), planned_[1].halfArea()};
    const double both = areas[0] * counts_[0] + areas[1] * counts_[1];
    double costs[2];
    for (int c = 0; c < 2; ++c)
      costs[c] = joined(planned_[c], r).halfArea() * counts_[c] + areas[1 - c] * (counts_[1 - c] - 1);
    const bool canBeCut = !isEmpty(parts[0]) && !isEmpty(parts[1]);
    if (canBeCut && both <= std::min(costs[0], costs[1])) {
      for (int c = 0; c < 2; ++c) add(c, Reference(parts[c], r.index()));
      return;
    }
    const int side = costs[0] <= costs[1] ? 0 : 1;
    add(side, r);
    planned_[side].add(r);
    counts_[1 - side] -= 1;
  }

  void add(int side, const Reference& r) {
    children_[side].references.push_back(r);
    children_[side].bounds.add(r);
  }

 private:
  SpatialRange (&children_)[2];
  Box planned_[2];  // as if all that are still to come were cut
  double counts_[2];
};

}  // namespace

bool splitSpatially(const BvhTriangles& triangles, const SpatialRange& range, const SpatialSplit& split,
                    SpatialRange (&children)[2]) {
  std::vector<Reference> cut;
  for (const Reference& r : range.references) {
    if (r.upper[split.axis] > split.position && r.lower[split.axis] < split.position) {
      cut.push_back(r);
      continue;
    }
    SpatialRange& child = children[r.upper[split.axis] <= split.position ? 0 : 1];
    child.references.push_back(r);
    child.bounds.add(r);
  }
  Sides sides(split, children);
  for (const Reference& r : cut) {
    const Corners corners = cornersOf(triangles, r.index());
    sides.give(r, {clippedBox(corners, r, split.axis, r.lower[split.axis], split.position),
                   clippedBox(corners, r, split.axis, split.position, r.upper[split.axis])});
  }
  const std::uint32_t largest = std::max(children[0].count(), children[1].count());
  return children[0].count() > 0 && children[1].count() > 0 && largest < range.count() &&
         fitsDepth(range.depth, largest);
}

}  // namespace crosslight::accel

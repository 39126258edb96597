#include "accel/bvh_partition.h"

#include <algorithm>

namespace crosslight::accel {

std::uint32_t halve(std::span<Reference> references, const Box& centers) {
  int axis = 0;
  double widest = -1;
  for (int i = 0; i < 3; ++i) {
    const double extent = double{centers.upper[i]} - centers.lower[i];
    if (!(extent > widest)) continue;
    widest = extent;
    axis = i;
  }
  const auto middle = references.begin() + static_cast<std::ptrdiff_t>((references.size() + 1) / 2);
  // The index breaks ties: a total order has one median.
  std::nth_element(references.begin(), middle, references.end(), [axis](const Reference& a, const Reference& b) {
    const float ca = a.center(axis), cb = b.center(axis);
    return ca < cb || (ca == cb && a.index() < b.index());
  });
  return static_cast<std::uint32_t>(axis);
}

Box boxOfCenters(std::span<const Reference> references) {
  Box some, others;  // two, because each minimum waits for the one before it
  std::size_t i = 0;
  for (; i + 1 < references.size(); i += 2) {
    some.addPoint(references[i].center());
    others.addPoint(references[i + 1].center());
  }
  if (i < references.size()) some.addPoint(references[i].center());
  return joined(some, others);
}

// Without a branch: sides change too often to be foretold.
std::size_t scatter(std::span<const Reference> references, const Split& split, Reference* lower, Reference* upper) {
  std::size_t lowerCount = 0;
  const std::ptrdiff_t fromUpper = lower - upper;
  for (std::size_t i = 0; i < references.size(); ++i) {
    const Reference r = references[i];
    const std::size_t isLower = split.isLower(r) ? 1 : 0;
    const std::size_t upperCount = i - lowerCount;
    const std::size_t mask = 0 - isLower;
    const std::size_t place = (upperCount & ~mask) | ((lowerCount + static_cast<std::size_t>(fromUpper)) & mask);
    upper[static_cast<std::ptrdiff_t>(place)] = r;
    lowerCount += isLower;
  }
  return lowerCount;
}

std::uint32_t splitInHalves(const Buffers& buffers, const Work& work, Work (&children)[2]) {
  const std::uint32_t axis = halve(buffers.range(work), work.centers);
  children[0].count = (work.count + 1) / 2;
  children[1].count = work.count - children[0].count;
  for (int c = 0; c < 2; ++c) {
    children[c].begin = work.begin + (c == 0 ? 0 : children[0].count);
    children[c].side = work.side;
    children[c].depth = work.depth + 1;
    for (const Reference& r : buffers.range(children[c])) children[c].bounds.add(r);
  }
  return axis;
}

void rangesOf(const Work& work, const Split& split, Work (&children)[2]) {
  children[0].begin = work.begin;
  children[0].count = split.lowerCount;
  children[1].begin = work.begin + split.lowerCount;
  children[1].count = work.count - split.lowerCount;
  for (Work& child : children) {
    child.side = 1 - work.side;
    child.depth = work.depth + 1;
  }
}

}  // namespace crosslight::accel

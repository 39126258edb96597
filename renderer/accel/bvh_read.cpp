#include "accel/bvh_read.h"

#include <algorithm>

#include "base/check.h"

namespace crosslight::accel {
namespace {

Box boxOf(const Bounds& b) {
  Box box;
  static_assert(sizeof(Bounds) == 6 * sizeof(float));
  // Lower corner and one more, one less and upper corner: both loads stay within the six floats.
  Float4 low, high;
  std::memcpy(&low, &b.lower.x, sizeof(low));
  std::memcpy(&high, &b.lower.z, sizeof(high));
  box.lower = low;
  box.upper = __builtin_shufflevector(high, high, 1, 2, 3, 3);
  return box;
}

Box boxOf(const BvhTriangles& triangles, std::size_t i) {
  Box box;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::vec3& p = triangles.positions[triangles.indices[3 * i + k]];
    box.addPoint(Float4{p.x, p.y, p.z, 0});
  }
  return box;
}

struct BlockResult {
  Box bounds, centers;
  bool sound = true;
};

template <class BoxAt>
BlockResult readBlock(std::uint32_t begin, std::uint32_t end, Reference* references, const BoxAt& boxAt) {
  constexpr float kMost = std::numeric_limits<float>::max();
  BlockResult result;
  Int4 sound{-1, -1, -1, -1};
  for (std::uint32_t i = begin; i < end; ++i) {
    Box box = boxAt(i);
    // No negative zero: minima of zeros then have one sign, in whatever order they are taken.
    box.lower += splat(0);
    box.upper += splat(0);
    sound &= (box.lower <= box.upper) & (box.lower >= -kMost) & (box.upper <= kMost);
    const Reference r(box, i);
    references[i] = r;
    result.bounds.add(r);
    result.centers.addPoint(r.center());
  }
  result.sound = (sound[0] & sound[1] & sound[2]) != 0;
  return result;
}

template <class BoxAt>
Work read(std::size_t size, Reference* references, Team& team, const BoxAt& boxAt) {
  const auto count = static_cast<std::uint32_t>(size);
  std::vector<BlockResult> results((count + kBlock - 1) / kBlock);
  team.forEach(static_cast<std::uint32_t>(results.size()), [&](std::uint32_t b) {
    results[b] = readBlock(b * kBlock, std::min(count, (b + 1) * kBlock), references, boxAt);
  });
  Work all;
  all.count = count;
  for (const BlockResult& result : results) {
    CL_CHECK(result.sound && "every box of the BVH is finite and not empty");
    all.bounds.add(result.bounds);
    all.centers.add(result.centers);
  }
  return all;
}

}  // namespace

Work readReferences(std::span<const Bounds> primitives, Reference* references, Team& team) {
  return read(primitives.size(), references, team, [&](std::uint32_t i) { return boxOf(primitives[i]); });
}

Work readReferences(const BvhTriangles& triangles, Reference* references, Team& team) {
  return read(triangles.count(), references, team, [&](std::uint32_t i) { return boxOf(triangles, i); });
}

}  // namespace crosslight::accel

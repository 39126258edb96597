#include "accel/kept_trees.h"

#include <utility>

#include "accel/bvh_hash.h"
#include "accel/refit.h"

namespace crosslight {
namespace {

std::vector<Bounds> boxesOf(const BvhTriangles& triangles, accel::Team& team) {
  constexpr std::size_t kBlock = 16384;
  std::vector<Bounds> boxes(triangles.count());
  team.forEach(static_cast<std::uint32_t>((boxes.size() + kBlock - 1) / kBlock), [&](std::uint32_t block) {
    const std::size_t end = std::min(boxes.size(), (block + std::size_t{1}) * kBlock);
    for (std::size_t i = block * kBlock; i < end; ++i) {
      for (std::size_t k = 0; k < 3; ++k) boxes[i].add(triangles.positions[triangles.indices[3 * i + k]]);
    }
  });
  return boxes;
}

}  // namespace

struct KeptTrees::Kept {
  accel::Digest indices, positions;
  Bvh tree;
};

KeptTrees::KeptTrees() = default;
KeptTrees::~KeptTrees() = default;

const Bvh& KeptTrees::over(int key, const BvhTriangles& triangles) {
  accel::Team team(accel::usefulThreads(0, triangles.count() / 8));
  const accel::Digest indices = accel::digestOfPieces(std::as_bytes(triangles.indices), team);
  const accel::Digest positions = accel::digestOfPieces(std::as_bytes(triangles.positions), team);
  std::unique_ptr<Kept>& slot = kept_[key];
  const bool isNew = slot == nullptr;
  if (isNew) slot = std::make_unique<Kept>();
  Kept& kept = *slot;
  const bool sameTriangles = !isNew && kept.indices == indices && kept.tree.stats.primitives == triangles.count();
  if (sameTriangles && kept.positions == positions) {
    ++counts_.unchanged;
    return kept.tree;
  }
  kept.positions = positions;
  if (sameTriangles && refit(kept.tree, boxesOf(triangles, team)).growth <= kMostGrowth) {
    ++counts_.moved;
    return kept.tree;
  }
  kept.tree = Bvh{};  // before the next one needs the memory
  kept.tree = buildTriangleBvh(triangles);
  kept.indices = indices;
  ++counts_.built;
  return kept.tree;
}

KeptTrees::Counts KeptTrees::takeCounts() { return std::exchange(counts_, {}); }

}  // namespace crosslight

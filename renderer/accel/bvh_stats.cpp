// What the builder reports about a finished tree.
#include "accel/bvh_builder.h"
#include "base/check.h"

namespace crosslight::accel {
namespace {

Bounds boxOfChild(const shared::BvhNode& node, int child) {
  Bounds b;
  b.lower = child == 0 ? node.lower0 : node.lower1;
  b.upper = child == 0 ? node.upper0 : node.upper1;
  return b;
}

double halfArea(const Bounds& b) {
  if (b.empty()) return 0;
  const glm::dvec3 e = glm::dvec3(b.upper) - glm::dvec3(b.lower);
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

}  // namespace

// In units of one box or primitive test, for a ray that meets the root's box: Goldsmith and Salmon 1987.
void takeStats(Bvh& bvh) {
  std::vector<std::uint8_t> depth(bvh.nodes.size(), 1);
  const double rootArea = halfArea(bvh.bounds);
  bvh.stats.sahCost = 1;
  for (std::size_t i = 0; i < bvh.nodes.size(); ++i) {
    const shared::BvhNode& node = bvh.nodes[i];
    if (node.parent != shared::kNoId) depth[i] = static_cast<std::uint8_t>(depth[node.parent] + 1);
    bvh.stats.maxDepth = std::max(bvh.stats.maxDepth, std::uint32_t{depth[i]});
    for (int c = 0; c < 2; ++c) {
      const std::uint32_t child = c == 0 ? node.child0 : node.child1;
      const bool leaf = bvhIsLeaf(child);
      const double chance = rootArea > 0 ? halfArea(boxOfChild(node, c)) / rootArea : 1.0;
      bvh.stats.sahCost += chance * (leaf ? bvhLeafCount(child) : 1u);
      if (leaf && bvhLeafCount(child) > 0) ++bvh.stats.leafCount;
    }
  }
  bvh.stats.nodeCount = static_cast<std::uint32_t>(bvh.nodes.size());
  bvh.stats.sizeBytes = bvh.nodes.size() * sizeof(shared::BvhNode) + bvh.order.size() * sizeof(std::uint32_t);
  CL_CHECK_LT(bvh.stats.maxDepth, shared::kBvhStackSize);
}

}  // namespace crosslight::accel

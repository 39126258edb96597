#include "accel/wide_bvh.h"

#include <algorithm>

namespace crosslight {
namespace {

constexpr shared::WideChild kEmpty{glm::vec3(1e38f), shared::kBvhLeaf, glm::vec3(-1e38f), 0};

struct Pending {
  std::uint32_t node;  // of the binary tree
  std::uint32_t slot;  // of the wide node that it becomes
  std::uint32_t depth;
};

double halfArea(const shared::WideChild& c) {
  const glm::dvec3 e = glm::dvec3(c.upper) - glm::dvec3(c.lower);
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

void addChild(const glm::vec3& lower, const glm::vec3& upper, std::uint32_t child, WideNode& node,
              std::uint32_t& count) {
  if (child == shared::kBvhLeaf) return;  // a tree of one primitive or none has empty children
  node[count++] = {lower, child, upper, 0};
}

void addChildrenOf(const shared::BvhNode& from, WideNode& node, std::uint32_t& count) {
  addChild(from.lower0, from.upper0, from.child0, node, count);
  addChild(from.lower1, from.upper1, from.child1, node, count);
}

WideNode open(const Bvh& bvh, std::uint32_t root) {
  WideNode node;
  node.fill(kEmpty);
  std::uint32_t count = 0;
  addChildrenOf(bvh.nodes[root], node, count);
  while (count < shared::kWideChildren) {
    std::uint32_t largest = shared::kWideChildren;
    double most = -1;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (bvhIsLeaf(node[i].child) || halfArea(node[i]) <= most) continue;
      most = halfArea(node[i]);
      largest = i;
    }
    if (largest == shared::kWideChildren) break;
    const std::uint32_t opened = node[largest].child;
    node[largest] = node[--count];
    node[count] = kEmpty;
    addChildrenOf(bvh.nodes[opened], node, count);
  }
  return node;
}

}  // namespace

WideBvh widen(const Bvh& bvh) {
  WideBvh wide;
  wide.nodes.emplace_back();
  std::vector<Pending> pending{{0, 0, 1}};
  while (!pending.empty()) {
    const Pending next = pending.back();
    pending.pop_back();
    wide.maxDepth = std::max(wide.maxDepth, next.depth);
    WideNode node = open(bvh, next.node);
    for (shared::WideChild& c : node) {
      if (bvhIsLeaf(c.child)) continue;
      const auto slot = static_cast<std::uint32_t>(wide.nodes.size());
      wide.nodes.emplace_back();
      pending.push_back({c.child, slot, next.depth + 1});
      c.child = slot;
    }
    wide.nodes[next.slot] = node;
  }
  return wide;
}

}  // namespace crosslight

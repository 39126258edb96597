#include "accel/wide_bvh.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace crosslight {
namespace {

constexpr shared::WideChild kEmpty{glm::vec3(1e38f), shared::kBvhLeaf, glm::vec3(-1e38f), 0};

struct Pending {
  std::uint32_t node;   // of the binary tree
  std::uint32_t slot;   // of the wide node that it becomes
  std::uint32_t above;  // levels, or children that wait, above it
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

// Up to `most` children: the first `count` of the node.
WideNode open(const Bvh& bvh, std::uint32_t root, std::uint32_t most, std::uint32_t& count) {
  WideNode node;
  node.fill(kEmpty);
  count = 0;
  addChildrenOf(bvh.nodes[root], node, count);
  while (count < most) {
    std::uint32_t largest = shared::kWideChildren;
    double area = -1;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (bvhIsLeaf(node[i].child) || halfArea(node[i]) <= area) continue;
      area = halfArea(node[i]);
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

float planeAt(float origin, std::uint32_t exponent, std::uint32_t byte) {
  return origin + std::bit_cast<float>(exponent << 23) * static_cast<float>(byte);
}

// One axis of a node's grid.
struct Grid {
  float origin;
  std::uint32_t exponent;  // biased, as floats have it

  // The finest one whose last plane is not below `upper`.
  Grid(float lower, float upper) : origin(lower), exponent(1) {
    const double step = (double{upper} - lower) / 255.0;
    if (step > 0) exponent = static_cast<std::uint32_t>(std::clamp(std::ilogb(step) + 127, 1, 253));
    while (planeAt(origin, exponent, 255) < upper) ++exponent;
  }
  // Each starts at the exact quotient and steps outwards until rounding is on the safe side.
  std::uint32_t below(float value) const {
    std::uint32_t byte = std::min(quotient(value) + 1, 255u);
    while (byte > 0 && planeAt(origin, exponent, byte) > value) --byte;
    return byte;
  }
  std::uint32_t above(float value) const {
    std::uint32_t byte = quotient(value) - std::min(quotient(value), 1u);
    while (byte < 255 && planeAt(origin, exponent, byte) < value) ++byte;
    return byte;
  }

 private:
  std::uint32_t quotient(float value) const {
    const double q = (double{value} - origin) / double{std::bit_cast<float>(exponent << 23)};
    return static_cast<std::uint32_t>(std::clamp(q, 0.0, 255.0));
  }
};

shared::QuadNode onGrid(const WideNode& node, std::uint32_t count) {
  Bounds all;
  for (std::uint32_t i = 0; i < count; ++i) all.add(Bounds{node[i].lower, node[i].upper});
  if (count == 0) all = Bounds{glm::vec3(0.0f), glm::vec3(0.0f)};
  shared::QuadNode quad{};
  quad.origin = all.lower;
  std::uint32_t* const lowers[] = {&quad.lowerX, &quad.lowerY, &quad.lowerZ};
  std::uint32_t* const uppers[] = {&quad.upperX, &quad.upperY, &quad.upperZ};
  for (int axis = 0; axis < 3; ++axis) {
    const Grid grid(all.lower[axis], all.upper[axis]);
    quad.exponents |= grid.exponent << (8 * axis);
    for (std::uint32_t i = 0; i < count; ++i) {
      *lowers[axis] |= grid.below(node[i].lower[axis]) << (8 * i);
      *uppers[axis] |= grid.above(node[i].upper[axis]) << (8 * i);
    }
  }
  return quad;
}

}  // namespace

WideBvh widen(const Bvh& bvh) {
  WideBvh wide;
  wide.nodes.emplace_back();
  std::vector<Pending> pending{{0, 0, 1}};
  while (!pending.empty()) {
    const Pending next = pending.back();
    pending.pop_back();
    wide.maxDepth = std::max(wide.maxDepth, next.above);
    std::uint32_t count = 0;
    WideNode node = open(bvh, next.node, shared::kWideChildren, count);
    for (shared::WideChild& c : node) {
      if (bvhIsLeaf(c.child)) continue;
      const auto slot = static_cast<std::uint32_t>(wide.nodes.size());
      wide.nodes.emplace_back();
      pending.push_back({c.child, slot, next.above + 1});
      c.child = slot;
    }
    wide.nodes[next.slot] = node;
  }
  return wide;
}

QuadBvh quantize(const Bvh& bvh) {
  constexpr std::uint32_t kChildren = 4;
  QuadBvh quad;
  quad.nodes.emplace_back();
  std::vector<Pending> pending{{0, 0, 0}};
  while (!pending.empty()) {
    const Pending next = pending.back();
    pending.pop_back();
    std::uint32_t count = 0;
    const WideNode node = open(bvh, next.node, kChildren, count);
    shared::QuadNode packed = onGrid(node, count);
    std::uint32_t* const children[] = {&packed.child0, &packed.child1, &packed.child2, &packed.child3};
    for (std::uint32_t* const child : children) *child = shared::kBvhLeaf;
    // While one child is walked the others wait.
    const std::uint32_t waiting = next.above + (count > 0 ? count - 1 : 0);
    quad.mostWaiting = std::max(quad.mostWaiting, waiting);
    for (std::uint32_t i = 0; i < count; ++i) {
      *children[i] = node[i].child;
      if (bvhIsLeaf(node[i].child)) continue;
      const auto slot = static_cast<std::uint32_t>(quad.nodes.size());
      quad.nodes.emplace_back();
      pending.push_back({node[i].child, slot, waiting});
      *children[i] = slot;
    }
    quad.nodes[next.slot] = packed;
  }
  return quad;
}

}  // namespace crosslight

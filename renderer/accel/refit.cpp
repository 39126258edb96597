#include "accel/refit.h"

#include <algorithm>

#include "accel/bvh_box.h"
#include "accel/bvh_team.h"
#include "base/check.h"

namespace crosslight {
namespace accel {
namespace {

constexpr std::uint32_t kPieceNodes = 8192;

// Nodes [begin, end) are a subtree: depth-first order keeps one together, children behind their parent.
struct Part {
  std::uint32_t begin = 0, end = 0;
};

Box boxOf(const Bounds& b) {
  return {Float4{b.lower.x, b.lower.y, b.lower.z, 0} + splat(0), Float4{b.upper.x, b.upper.y, b.upper.z, 0} + splat(0)};
}

Box childBox(const shared::BvhNode& node, int child) {
  Bounds b;
  b.lower = child == 0 ? node.lower0 : node.lower1;
  b.upper = child == 0 ? node.upper0 : node.upper1;
  return boxOf(b);
}

class Refitter {
 public:
  Refitter(Bvh& bvh, std::span<const Bounds> primitives) : nodes_(bvh.nodes), order_(bvh.order), boxes_(primitives) {}

  // Sum over the nodes' children of half area, times the primitives of a leaf; those below are ready.
  double update(std::uint32_t begin, std::uint32_t end) {
    double area = 0;
    for (std::uint32_t i = end; i-- > begin;) area += updateNode(i);
    return area;
  }

  double updateNode(std::uint32_t i) {
    shared::BvhNode& node = nodes_[i];
    const std::uint32_t children[2] = {node.child0, node.child1};
    if (children[1] == shared::kBvhLeaf && bvhLeafCount(children[0]) == 0) return 0;  // a tree of nothing
    Box boxes[2];
    double area = 0;
    for (int c = 0; c < 2; ++c) {
      if (children[c] == shared::kBvhLeaf) {
        boxes[c] = childBox(node, c);
        continue;
      }
      boxes[c] = boxOfChild(children[c]);
      area += boxes[c].halfArea() * (bvhIsLeaf(children[c]) ? bvhLeafCount(children[c]) : 1u);
    }
    writeNode(node, boxes[0], boxes[1], node.splitAxis, node.parent);
    node.child0 = children[0];
    node.child1 = children[1];
    return area;
  }

 private:
  Box boxOfChild(std::uint32_t child) const {
    Box box;
    if (!bvhIsLeaf(child)) return joined(childBox(nodes_[child], 0), childBox(nodes_[child], 1));
    const std::uint32_t first = bvhLeafFirst(child);
    for (std::uint32_t i = first; i < first + bvhLeafCount(child); ++i) box.add(boxOf(boxes_[order_[i]]));
    return box;
  }

  std::vector<shared::BvhNode>& nodes_;
  const std::vector<std::uint32_t>& order_;
  std::span<const Bounds> boxes_;
};

// Subtrees that one thread takes, and the nodes above them in depth-first order.
void cut(const std::vector<shared::BvhNode>& nodes, const Part& part, std::vector<Part>& parts,
         std::vector<std::uint32_t>& above) {
  if (part.end - part.begin <= kPieceNodes) return parts.push_back(part);
  above.push_back(part.begin);
  const shared::BvhNode& node = nodes[part.begin];
  const std::uint32_t middle = bvhIsLeaf(node.child1) ? part.end : node.child1;
  if (!bvhIsLeaf(node.child0)) cut(nodes, {node.child0, middle}, parts, above);
  if (!bvhIsLeaf(node.child1)) cut(nodes, {node.child1, part.end}, parts, above);
}

void checkSound(std::span<const Bounds> boxes, Team& team) {
  constexpr std::size_t kBlock = 65536;
  constexpr float kMost = std::numeric_limits<float>::max();
  team.forEach(static_cast<std::uint32_t>((boxes.size() + kBlock - 1) / kBlock), [&](std::uint32_t b) {
    Int4 sound{-1, -1, -1, -1};
    for (std::size_t i = b * kBlock; i < std::min(boxes.size(), (b + 1) * kBlock); ++i) {
      const Box box = boxOf(boxes[i]);
      sound &= (box.lower <= box.upper) & (box.lower >= -kMost) & (box.upper <= kMost);
    }
    CL_CHECK((sound[0] & sound[1] & sound[2]) != 0 && "every box of the BVH is finite and not empty");
  });
}

}  // namespace
}  // namespace accel

RefitResult refit(Bvh& bvh, std::span<const Bounds> primitives, std::uint32_t threads) {
  using namespace accel;
  CL_CHECK_EQ(primitives.size(), std::size_t{bvh.stats.primitives});
  if (primitives.empty()) return {bvh.stats.sahCost, 1};
  Team team(usefulThreads(threads, primitives.size() / 8));  // a node is refitted in a tenth of its building time
  checkSound(primitives, team);
  std::vector<Part> parts;
  std::vector<std::uint32_t> above;
  cut(bvh.nodes, {0, static_cast<std::uint32_t>(bvh.nodes.size())}, parts, above);
  Refitter refitter(bvh, primitives);
  std::vector<double> areas(parts.size());
  team.forEach(static_cast<std::uint32_t>(parts.size()),
               [&](std::uint32_t i) { areas[i] = refitter.update(parts[i].begin, parts[i].end); });
  double area = 0;
  for (const double a : areas) area += a;
  for (std::size_t i = above.size(); i-- > 0;) area += refitter.updateNode(above[i]);
  Box all = childBox(bvh.nodes[0], 0);
  if (bvh.nodes[0].child1 != shared::kBvhLeaf) all.add(childBox(bvh.nodes[0], 1));
  bvh.bounds.lower = asVec3(all.lower);
  bvh.bounds.upper = asVec3(all.upper);
  const double rootArea = all.halfArea();
  if (rootArea > 0) bvh.stats.sahCost = 1 + area / rootArea;
  return {bvh.stats.sahCost, bvh.stats.sahCost / bvh.stats.builtSahCost};
}

}  // namespace crosslight

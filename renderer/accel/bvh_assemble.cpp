#include "accel/bvh_assemble.h"

#include <algorithm>

#include "base/check.h"

namespace crosslight::accel {
namespace {

// Places of everything in the depth-first order of the whole tree.
struct Places {
  std::vector<std::uint32_t> ofTop, ofPiece;
  std::vector<std::uint32_t> parentOfTop, parentOfPiece;
  std::uint32_t count = 0;
};

void place(const Parts& parts, std::uint32_t top, std::uint32_t parent, Places& places) {
  const std::uint32_t node = places.count++;
  places.ofTop[top] = node;
  places.parentOfTop[top] = parent;
  for (const TopNode::Child& child : parts.top[top].children) {
    if (!child.isPiece) {
      place(parts, child.index, node, places);
      continue;
    }
    places.ofPiece[child.index] = places.count;
    places.parentOfPiece[child.index] = node;
    places.count += parts.pieces[child.index].nodeCount;
  }
}

Places placesOf(const Parts& parts) {
  Places places;
  places.ofTop = places.parentOfTop = std::vector<std::uint32_t>(parts.top.size(), shared::kNoId);
  places.ofPiece = places.parentOfPiece = std::vector<std::uint32_t>(parts.pieces.size(), shared::kNoId);
  if (parts.top.empty()) {
    places.ofPiece[0] = 0;
    places.count = parts.pieces[0].nodeCount;
  } else {
    place(parts, 0, shared::kNoId, places);
  }
  return places;
}

std::uint32_t referenceOf(const Parts& parts, const Places& places, const TopNode::Child& child) {
  if (!child.isPiece) return places.ofTop[child.index];
  const Piece& piece = parts.pieces[child.index];
  return piece.nodeCount == 0 ? piece.root + piece.firstOfOrder : places.ofPiece[child.index];
}

void copyPiece(const Piece& piece, std::uint32_t at, std::uint32_t parent, std::vector<shared::BvhNode>& nodes) {
  for (std::uint32_t i = 0; i < piece.nodeCount; ++i) {
    shared::BvhNode node = piece.nodes[i];
    node.child0 += bvhIsLeaf(node.child0) ? piece.firstOfOrder : at;
    node.child1 += bvhIsLeaf(node.child1) ? piece.firstOfOrder : at;
    node.parent = i == 0 ? parent : node.parent + at;
    nodes[at + i] = node;
  }
}

void finishStats(const Parts& parts, TreeStats all, Bvh& bvh) {
  for (const Piece& piece : parts.pieces) {
    all.area += piece.stats.area;
    all.leaves += piece.stats.leaves;
    all.maxDepth = std::max(all.maxDepth, piece.stats.maxDepth);
  }
  const double rootArea = parts.bounds.halfArea();
  bvh.stats.nodeCount = static_cast<std::uint32_t>(bvh.nodes.size());
  bvh.stats.leafCount = all.leaves;
  bvh.stats.maxDepth = all.maxDepth;
  // In units of one box or primitive test, for a ray that meets the root's box: Goldsmith and Salmon 1987. A tree
  // without area: every node counts as met.
  bvh.stats.sahCost = rootArea > 0 ? 1 + all.area / rootArea : static_cast<double>(bvh.nodes.size() + bvh.order.size());
  CL_CHECK_LT(bvh.stats.maxDepth, shared::kBvhStackSize);
}

void addPieces(const Parts& parts, std::uint32_t top, std::vector<std::uint32_t>& pieces) {
  for (const TopNode::Child& child : parts.top[top].children) {
    if (child.isPiece) {
      pieces.push_back(child.index);
    } else {
      addPieces(parts, child.index, pieces);
    }
  }
}

}  // namespace

std::vector<std::uint32_t> piecesInOrder(const Parts& parts) {
  if (parts.top.empty()) return {0};
  std::vector<std::uint32_t> pieces;
  addPieces(parts, 0, pieces);
  return pieces;
}

void assemble(const Parts& parts, Team& team, Bvh& bvh) {
  const Places places = placesOf(parts);
  bvh.nodes.reserve(places.count);
  adviseHugePages(bvh.nodes.data(), places.count * sizeof(shared::BvhNode));
  bvh.nodes.resize(places.count);
  team.forEach(static_cast<std::uint32_t>(parts.pieces.size()), [&](std::uint32_t p) {
    copyPiece(parts.pieces[p], places.ofPiece[p], places.parentOfPiece[p], bvh.nodes);
  });
  TreeStats stats;
  for (std::uint32_t t = 0; t < parts.top.size(); ++t) {
    const TopNode& top = parts.top[t];
    shared::BvhNode& node = bvh.nodes[places.ofTop[t]];
    writeNode(node, top.children[0].bounds, top.children[1].bounds, top.axis, places.parentOfTop[t]);
    node.child0 = referenceOf(parts, places, top.children[0]);
    node.child1 = referenceOf(parts, places, top.children[1]);
    stats.addChild(top.children[0].bounds, node.child0);
    stats.addChild(top.children[1].bounds, node.child1);
  }
  // Leaves that are pieces were counted as children here; their depth is below that of some piece or of its parent.
  for (std::uint32_t t = 0; t < parts.top.size(); ++t) {
    std::uint32_t depth = 1;
    for (std::uint32_t p = places.parentOfTop[t]; p != shared::kNoId; p = bvh.nodes[p].parent) ++depth;
    stats.maxDepth = std::max(stats.maxDepth, depth);
  }
  bvh.bounds.lower = asVec3(parts.bounds.lower);
  bvh.bounds.upper = asVec3(parts.bounds.upper);
  finishStats(parts, stats, bvh);
}

void assembleTiny(const Work& root, Bvh& bvh) {
  Box empty;
  const Bounds none;
  empty.lower = Float4{none.lower.x, none.lower.y, none.lower.z, 0};
  empty.upper = Float4{none.upper.x, none.upper.y, none.upper.z, 0};
  const bool one = root.count == 1;
  bvh.nodes.resize(1);
  writeNode(bvh.nodes[0], one ? root.bounds : empty, empty, 0, shared::kNoId);
  bvh.nodes[0].child0 = one ? leafReference(0, 1) : kEmptyLeaf;
  bvh.nodes[0].child1 = kEmptyLeaf;
  bvh.stats.nodeCount = 1;
  bvh.stats.leafCount = root.count;
  bvh.stats.maxDepth = 1;
  bvh.stats.sahCost = 1 + root.count;
  if (!one) return;
  bvh.order.push_back(0);
  bvh.bounds.lower = asVec3(root.bounds.lower);
  bvh.bounds.upper = asVec3(root.bounds.upper);
}

}  // namespace crosslight::accel

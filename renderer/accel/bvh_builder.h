// Working data of the BVH builders: ranges of references that become subtrees, the pieces that threads build, and the
// tree above them. Private to the room; bvh.h is the interface.
#pragma once

#include <bit>
#include <span>
#include <vector>

#include "accel/bvh_box.h"
#include "accel/bvh_memory.h"
#include "accel/bvh_split.h"
#include "accel/bvh_team.h"

namespace crosslight::accel {

// Levels of inner nodes that a path may have; the shaders' stack holds one entry less than it has places.
inline constexpr std::uint32_t kMaxDepth = shared::kBvhStackSize - 1;
inline constexpr std::uint32_t kEmptyLeaf = shared::kBvhLeaf;
// Primitives that one thread handles at a time where all work on one range.
inline constexpr std::uint32_t kBlock = 8192;

inline std::uint32_t leafReference(std::uint32_t first, std::uint32_t count) {
  return shared::kBvhLeaf | (count << shared::kBvhCountShift) | first;
}

// Inner nodes on the longest path of a tree over `count` primitives that is halved down to single primitives:
// ceil(log2(count)).
inline std::uint32_t medianHeight(std::uint32_t count) {
  return count < 2 ? 0u : static_cast<std::uint32_t>(std::bit_width(count - 1));
}

// Proof that no path exceeds kMaxDepth = 63 inner nodes. Claim: every range that becomes a subtree satisfies
//   depth + medianHeight(count) <= 63.
// The root: depth 0, count < 2^27, so at most 27. A split is taken only if both children satisfy the claim: this.
// Otherwise the range is halved: the larger half has ceil(count / 2) primitives, medianHeight of which is
// medianHeight(count) - 1, while the depth grows by one, so the sum does not grow. An inner node at depth d has count
// >= 2, thus medianHeight >= 1 and d <= 62; its path has at most d + 1 <= 63 inner nodes.
inline bool fitsDepth(std::uint32_t depth, std::uint32_t largerCount) {
  return depth + 1 + medianHeight(largerCount) <= kMaxDepth;
}

// References [begin, begin + count) that become one subtree.
struct Work {
  Box bounds;
  Box centers;
  std::uint32_t begin = 0;
  std::uint32_t count = 0;
  std::uint32_t depth = 0;  // inner nodes above
  std::uint32_t side = 0;   // which of the two buffers holds them
};

// Two buffers: partitioning reads one and writes the other, which keeps the references' order on either side. The tree
// is then the same however the work is cut into blocks and tasks.
struct Buffers {
  RawArray<Reference> sides[2];

  std::span<Reference> range(const Work& work) const { return {sides[work.side].data() + work.begin, work.count}; }
};

struct TreeStats {
  double area = 0;  // sum over children of half area, times the primitives of a leaf
  std::uint32_t leaves = 0;
  std::uint32_t maxDepth = 0;

  void addChild(const Box& box, std::uint32_t child) {
    const bool leaf = bvhIsLeaf(child);
    area += box.halfArea() * (leaf ? bvhLeafCount(child) : 1u);
    leaves += leaf ? 1u : 0u;
  }
};

// A subtree that one thread built: nodes in depth-first order that refer to each other from 0 on; or a leaf alone.
struct Piece {
  const shared::BvhNode* nodes = nullptr;
  std::uint32_t nodeCount = 0;
  std::uint32_t root = 0;          // 0 or a leaf
  std::uint32_t firstOfOrder = 0;  // added to what its leaves name
  Box bounds;
  TreeStats stats;
};

// A node above the pieces; a child is another of them or a piece.
struct TopNode {
  struct Child {
    bool isPiece = false;
    std::uint32_t index = 0;
    Box bounds;
  };
  Child children[2];
  std::uint32_t axis = 0;
};

// What builders hand to assemble(): the root is top[0], or pieces[0] where there is no top.
struct Parts {
  std::vector<TopNode> top;
  std::vector<Piece> pieces;
  Box bounds;
};

// What every builder of subtrees needs.
struct Plan {
  BvhOptions options;
  float unit = 1;  // areaUnit() of the tree
  std::uint32_t* order = nullptr;
};

// Whether `count` primitives stay together; splitCost in tests per ray that meets them, infinity for "no split".
inline bool staysLeaf(const BvhOptions& options, std::uint32_t count, std::uint32_t depth, double splitCost) {
  if (count == 1) return true;
  if (count > options.maxLeafSize || depth == 0) return false;
  return !(double{options.nodeCost} + splitCost < count);
}

// Nodes of one subtree as they are made.
struct NodeSink {
  shared::BvhNode* nodes = nullptr;
  std::uint32_t count = 0;
  TreeStats stats;

  std::uint32_t open() { return count++; }
  void close(std::uint32_t node, const Box (&boxes)[2], const std::uint32_t (&children)[2]) {
    nodes[node].child0 = children[0];
    nodes[node].child1 = children[1];
    for (int c = 0; c < 2; ++c) stats.addChild(boxes[c], children[c]);
  }
};

}  // namespace crosslight::accel

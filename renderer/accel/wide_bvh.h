// The same tree with up to eight children per node, for kernels whose lanes test one child each.
#pragma once

#include <array>

#include "accel/bvh.h"

namespace crosslight {

using WideNode = std::array<shared::WideChild, shared::kWideChildren>;

struct WideBvh {
  std::vector<WideNode> nodes;  // nodes[0] is the root
  std::uint32_t maxDepth = 0;   // inner nodes on the longest path
};

struct QuadBvh {
  std::vector<shared::QuadNode> nodes;  // nodes[0] is the root
  std::uint32_t mostWaiting = 0;        // children that wait at once in a walk: a stack of this many never overflows
};

// Opens the child of largest surface area until eight are there or only leaves are left. Leaves, and the order of
// primitives, stay those of `bvh`; the same tree gives the same wide tree.
WideBvh widen(const Bvh& bvh);
// Likewise with four children, whose boxes are rounded outwards to a grid.
QuadBvh quantize(const Bvh& bvh);

}  // namespace crosslight

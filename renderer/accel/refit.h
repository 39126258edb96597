// The same tree over primitives that have moved: for animation, where building anew costs more than rays lose.
#pragma once

#include "accel/bvh.h"

namespace crosslight {

struct RefitResult {
  double sahCost = 0;
  double growth = 1;  // of the cost since the tree was built: beyond about 1.5, building anew pays
};

// Gives every node the exact boxes of its primitives' new ones, primitive i of those the tree was built over. The same
// boxes give the same bits again, but for a tree of spatial splits, whose boxes then hold whole triangles. `threads` as
// in BvhOptions; the result does not depend on it. Boxes must be finite and not empty (checked).
RefitResult refit(Bvh& bvh, std::span<const Bounds> primitives, std::uint32_t threads = 0);

}  // namespace crosslight

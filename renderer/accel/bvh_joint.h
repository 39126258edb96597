// The levels near the root, on which threads join: each level's ranges are cut into blocks of equal size. Private to
// the room.
#pragma once

#include "accel/bvh_builder.h"

namespace crosslight::accel {

// Splits until no range has more than `piecePrimitives`. Fills parts.top; returns the work that is left, in the order
// of the pieces to be.
std::vector<Work> splitJointly(const Plan& plan, const Buffers& buffers, const Work& root,
                               std::uint32_t piecePrimitives, Team& team, Parts& parts);

}  // namespace crosslight::accel

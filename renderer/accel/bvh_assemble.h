// From the parts that builders leave to the finished tree, with its statistics. Private to the room.
#pragma once

#include "accel/bvh_builder.h"

namespace crosslight::accel {

void assemble(const Parts& parts, Team& team, Bvh& bvh);

// Indices of the pieces in the order of the tree's leaves.
std::vector<std::uint32_t> piecesInOrder(const Parts& parts);

// Of 0 primitives or 1.
void assembleTiny(const Work& root, Bvh& bvh);

}  // namespace crosslight::accel

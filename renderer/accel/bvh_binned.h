// The builder of quality medium: binned splits. Private to the room.
#pragma once

#include "accel/bvh_builder.h"

namespace crosslight::accel {

// Threads join on the ranges that are too large for one; what is left are pieces, built by one thread each. `nodes` has
// room for as many as there are references; pieces lie in it.
Parts buildBinned(const Plan& plan, const Buffers& buffers, const Work& root, shared::BvhNode* nodes, Team& team);

}  // namespace crosslight::accel

// The builder of quality fast: primitives in Morton order, split where their codes differ. Private to the room.
#pragma once

#include "accel/bvh_builder.h"

namespace crosslight::accel {

// As buildBinned(); the references end up in the second buffer.
Parts buildMorton(const Plan& plan, const Buffers& buffers, const Work& root, shared::BvhNode* nodes, Team& team);

}  // namespace crosslight::accel

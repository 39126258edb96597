// Primitives become references, in blocks that threads share. Private to the room.
#pragma once

#include "accel/bvh_builder.h"

namespace crosslight::accel {

// Fills `references`; the box of all and of their centers. InternalError where a box is empty or not finite.
Work readReferences(std::span<const Bounds> primitives, Reference* references, Team& team);
Work readReferences(const BvhTriangles& triangles, Reference* references, Team& team);

}  // namespace crosslight::accel

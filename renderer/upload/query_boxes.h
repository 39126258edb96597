// A box per triangle for devices that search boxes themselves (gpu/box_search.h).
#pragma once

#include <vector>

#include "gpu/box_search.h"
#include "upload/flatten.h"

namespace crosslight {

// Boxes of the flattened triangles, in their order, wide enough that a device which rounds its box tests to single
// precision finds every triangle that the shaders' test would let a ray meet, if the ray begins at a perspective
// camera, in front of an orthographic one, or within the scene's bounds. (Not: far away on an unbounded plane.)
std::vector<gpu::SearchBox> queryBoxes(const FlatScene& flat);

}  // namespace crosslight

// The box of a triangle's part between two planes. Private to the room.
#pragma once

#include "accel/bvh_box.h"

namespace crosslight::accel {

struct Corners {
  glm::vec3 points[3];
};

Corners cornersOf(const BvhTriangles& triangles, std::uint32_t triangle);

// Contains the part of the triangle that lies within `box` and from `low` to `high` on `axis`: rounded outward. Lower
// above upper where there is none.
Box clippedBox(const Corners& triangle, const Box& box, int axis, float low, float high);

}  // namespace crosslight::accel

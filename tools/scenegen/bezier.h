// A bicubic Bezier patch: point, derivatives and the unit normal, at degenerate edges included.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace crosslight::scenegen {

// points[j][i]: i runs with u, j with v.
struct BezierPatch {
  std::array<std::array<glm::dvec3, 4>, 4> points;
};

// On an edge (u or v exactly 0 or 1) the result depends on the edge's own control points only, bit for bit: patches
// that share them share the edge.
glm::dvec3 pointAt(const BezierPatch& patch, double u, double v);

glm::dvec3 derivativeU(const BezierPatch& patch, double u, double v);
glm::dvec3 derivativeV(const BezierPatch& patch, double u, double v);
glm::dvec3 derivativeUV(const BezierPatch& patch, double u, double v);

// du x dv, unit. Where an edge v = 0 or v = 1 has shrunk to a point, du vanishes and the limit is taken from inside.
glm::dvec3 normalAt(const BezierPatch& patch, double u, double v);

}  // namespace crosslight::scenegen

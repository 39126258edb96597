// What a primitive needs and a file may leave out: flat normals, normals that can be used, tangents. Free functions
// over plain values.
#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace crosslight {

// Gives every corner a vertex of its own; all attributes follow. Afterwards indices are 0, 1, 2, ...
void splitVertices(Primitive& primitive);

// Splits the vertices and gives them their triangle's normal (zero where the triangle has no area).
void makeFlatNormals(Primitive& primitive);

// Normals to unit length; those that are zero or not finite become the normal of the first triangle with an area that
// uses the vertex. The number of those.
std::size_t repairNormals(Primitive& primitive);

// Tangents to unit length, orthogonal to the normal, w to +1 or -1. The number of those that could not be used and
// became some direction across the normal.
std::size_t repairTangents(Primitive& primitive);

// Tangents along increasing u, per vertex: the triangles' own directions, weighted by the corner's angle, vertices
// split where mirrored and unmirrored texture coordinates meet. Not MikkTSpace bit for bit (that is a later issue):
// it welds and weights in another order, so baked normal maps can differ slightly along seams.
void makeTangents(Primitive& primitive, const std::vector<glm::vec2>& uv);

// Twice the area times the unit normal, in double.
glm::dvec3 triangleCross(const Primitive& primitive, std::size_t triangle);

}  // namespace crosslight

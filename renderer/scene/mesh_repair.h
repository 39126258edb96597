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

// Tangents as glTF prescribes where a mesh has none: MikkTSpace's rules, on the texture coordinates `uv`. Vertices are
// split where it asks for several (tangent_space.cpp).
void makeTangents(Primitive& primitive, const std::vector<glm::vec2>& uv);

// Angle at a corner of a triangle, radians.
double cornerAngle(const Primitive& primitive, std::size_t triangle, std::size_t corner);

// Copies a vertex to the end; its index.
std::uint32_t duplicateVertex(Primitive& primitive, std::uint32_t vertex);

// Some unit vector across n: n crossed with the axis that it is farthest from.
glm::dvec3 anyAcross(const glm::dvec3& n);

// Twice the area times the unit normal, in double.
glm::dvec3 triangleCross(const Primitive& primitive, std::size_t triangle);

}  // namespace crosslight

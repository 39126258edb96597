// Meshes that are no analytic shapes: grids, quadrilaterals, a torus knot, the five Platonic solids; and what is done
// to meshes as a whole. Right-handed, counter-clockwise fronts.
#pragma once

#include <array>
#include <functional>
#include <glm/mat4x4.hpp>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace crosslight::scenegen {

// A flat rectangle center +- halfU +- halfV, steps x steps quads, normal halfU x halfV; uv runs over [0,1]^2, v down.
Primitive gridMesh(const glm::dvec3& center, const glm::dvec3& halfU, const glm::dvec3& halfV, int steps);

// The squares (i + j) % 2 == parity of a steps x steps board on the plane y = 0, centered, facing up.
Primitive checkerMesh(double halfSize, int steps, int parity);

// Quadrilaterals, each turned so that its front faces the point `toward`.
Primitive quadMesh(std::span<const std::array<glm::dvec3, 4>> quads, const glm::dvec3& toward);

// Tube around the (2,3) torus knot on a torus with the given radii, axis y. Chiral: no rotation maps it to its mirror
// image.
Primitive torusKnotMesh(double ringRadius, double crossRadius, double tubeRadius, int stepsAlong, int stepsAround);

struct PlatonicSolid {
  std::string name;
  std::vector<glm::dvec3> vertices;     // on the unit sphere
  std::vector<glm::dvec3> faceNormals;  // unit
};
std::vector<PlatonicSolid> platonicSolids();

// Without normals: flat shading by glTF's rule. Faces are fans.
Primitive polyhedronMesh(const PlatonicSolid& solid);

// Positions, and normals by the cofactor matrix; a mirroring transform reverses the triangles. In double, rounded once.
Primitive transformed(const Primitive& mesh, const glm::dmat4& transform);

Primitive joined(const Primitive& a, const Primitive& b);
Primitive withoutUv(Primitive mesh);

}  // namespace crosslight::scenegen

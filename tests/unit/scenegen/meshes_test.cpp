// The scenes' other meshes: closed where they bound a body, wound outwards, with the right normals.
#include "scenegen/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <numbers>

#include "scene/shape_mesh.h"
#include "unit/scenegen/mesh_checks.h"

namespace crosslight::scenegen {
namespace {

using glm::dvec3;

constexpr double kFloatRoundoff = 0x1p-24;

TEST(TorusKnot, isClosedAndWoundOutwards) {
  const Primitive knot = torusKnotMesh(0.8, 0.32, 0.16, 120, 14);
  EXPECT_EQ(boundaryOf(knot).size(), 0u);
  EXPECT_GT(sixfoldVolume(knot), 0.0);
  for (const Triangle& t : trianglesOf(knot)) ASSERT_GT(glm::dot(t.areaNormal(), t.n[0] + t.n[1] + t.n[2]), 0.0);
}

TEST(TorusKnot, hasItsNormalsSquareToBothDirections) {
  const int along = 4000, around = 40;
  const Primitive knot = torusKnotMesh(0.8, 0.32, 0.16, along, around);
  const auto at = [&](int i, int j) { return static_cast<std::size_t>(i * (around + 1) + j); };
  for (int i = 1; i < along; i += 37) {
    for (int j = 1; j < around; ++j) {
      const dvec3 n = knot.normals[at(i, j)];
      const dvec3 du = dvec3(knot.positions[at(i + 1, j)]) - dvec3(knot.positions[at(i - 1, j)]);
      const dvec3 dv = dvec3(knot.positions[at(i, j + 1)]) - dvec3(knot.positions[at(i, j - 1)]);
      // Across, three points of a circle: exact. Along, the difference misses by the third derivative (at most
      // 3^3 * 1.3) times the cubed step over 3. Both: four rounded coordinates.
      const double step = 2.0 * std::numbers::pi / along;
      const double rounding = 8 * kFloatRoundoff * 1.3;
      EXPECT_LE(std::abs(glm::dot(n, du)), 27.0 * 1.3 * step * step * step / 3.0 + rounding);
      EXPECT_LE(std::abs(glm::dot(n, dv)), rounding);
    }
  }
}

TEST(TorusKnot, isNotItsOwnMirrorImage) {
  const Primitive knot = torusKnotMesh(0.8, 0.32, 0.16, 120, 14);
  std::set<Point> points;
  int shared = 0;
  for (const glm::vec3& p : knot.positions) points.insert(keyOf(p));
  for (const glm::vec3& p : knot.positions) shared += points.contains(keyOf({p.x, -p.y, p.z})) ? 1 : 0;
  EXPECT_LT(shared, static_cast<int>(knot.positions.size()) / 4);
}

TEST(Polyhedra, areTheFivePlatonicSolids) {
  const std::map<std::string, std::pair<std::size_t, std::size_t>> verticesAndFaces = {{"tetrahedron", {4, 4}},
                                                                                       {"cube", {8, 6}},
                                                                                       {"octahedron", {6, 8}},
                                                                                       {"dodecahedron", {20, 12}},
                                                                                       {"icosahedron", {12, 20}}};
  for (const PlatonicSolid& solid : platonicSolids()) {
    SCOPED_TRACE(solid.name);
    const auto [vertices, faces] = verticesAndFaces.at(solid.name);
    EXPECT_EQ(solid.vertices.size(), vertices);
    EXPECT_EQ(solid.faceNormals.size(), faces);
    const Primitive mesh = polyhedronMesh(solid);
    EXPECT_TRUE(mesh.flatNormals);
    EXPECT_TRUE(mesh.normals.empty());
    EXPECT_EQ(boundaryOf(mesh).size(), 0u);
    // Euler: V - E + F = 2, with the faces cut into triangles E = 3 F / 2.
    const std::size_t triangles = mesh.indices.size() / 3;
    EXPECT_EQ(vertices + triangles, 2 + 3 * triangles / 2);
    for (const Triangle& t : trianglesOf(mesh)) EXPECT_GT(glm::dot(t.areaNormal(), t.p[0]), 0.0);
  }
}

TEST(Quads, faceThePointTheyAreToldTo) {
  const dvec3 inside(0.5, 0.5, 0.5);
  const std::array<dvec3, 4> floor = {dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(1, 0, 1), dvec3(0, 0, 1)};
  std::array<dvec3, 4> reversed = floor;
  std::swap(reversed[1], reversed[3]);
  for (const auto& quad : {floor, reversed}) {
    const Primitive mesh = quadMesh(std::vector{quad}, inside);
    for (const Triangle& t : trianglesOf(mesh)) {
      EXPECT_GT(t.areaNormal().y, 0.0);
      EXPECT_EQ(t.n[0], dvec3(0.0, 1.0, 0.0));
    }
  }
}

TEST(Checker, colorsTogetherCoverTheBoardOnce) {
  const auto areaOf = [](const Primitive& mesh) {
    double twofold = 0.0;
    for (const Triangle& t : trianglesOf(mesh)) twofold += t.areaNormal().y;
    return 0.5 * twofold;
  };
  const Primitive light = checkerMesh(3.0, 6, 0), dark = checkerMesh(3.0, 6, 1);
  EXPECT_DOUBLE_EQ(areaOf(light), 18.0);
  EXPECT_DOUBLE_EQ(areaOf(dark), 18.0);
  EXPECT_TRUE(boundaryOf(joined(light, dark)).size() == 4u * 6u) << "squares share all inner edges";
}

// The textbook's example: under the scale (1,10,1) the normal (1,1,0) becomes (10,1,0), not (1,10,0).
TEST(Transformed, takesNormalsByTheCofactors) {
  Primitive mesh;
  mesh.positions = {{0, 0, 0}, {1, -1, 0}, {0, 0, 1}};
  mesh.normals.assign(3, glm::vec3(glm::normalize(dvec3(1.0, 1.0, 0.0))));
  mesh.indices = {0, 2, 1};
  const Primitive scaled = transformed(mesh, glm::scale(glm::dmat4(1.0), {1.0, 10.0, 1.0}));
  EXPECT_NEAR(scaled.normals[0].x, 0.995037190210, 2 * kFloatRoundoff);
  EXPECT_NEAR(scaled.normals[0].y, 0.099503719021, 2 * kFloatRoundoff);
}

TEST(Transformed, mirroringKeepsTheOutside) {
  const Primitive ball = tessellateShape(ShapeKind::sphere, {1.0f, 0.0f, 0.0f, 0.0f}, 16);
  const Primitive mirrored = transformed(ball, glm::scale(glm::dmat4(1.0), {-1.0, 1.0, 1.0}));
  EXPECT_GT(sixfoldVolume(mirrored), 0.0);
  for (const Triangle& t : trianglesOf(mirrored)) {
    ASSERT_GT(glm::dot(t.areaNormal(), t.n[0] + t.n[1] + t.n[2]), 0.0);
    ASSERT_GT(glm::dot(t.p[0], t.n[0]), 0.0);
  }
}

}  // namespace
}  // namespace crosslight::scenegen

// Tangents against meshes whose tangents are known: from calculus, or worked out by hand from MikkTSpace's rules.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "scene/mesh_repair.h"
#include "scene/shape_mesh.h"

namespace crosslight::test {
namespace {

glm::vec3 tangentAt(const Primitive& p, std::size_t corner) { return glm::vec3(p.tangents[p.indices[corner]]); }

// Two triangles of one plane whose u run 90 degrees apart: at the two vertices that they share, the mean of both
// directions by the angles of the corners.
TEST(TangentSpace, SharedVerticesTakeTheMeanByTheCornersAngles) {
  Primitive p;
  p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 2, 0}};
  p.normals.assign(4, {0, 0, 1});
  p.indices = {0, 1, 2, 2, 1, 3};
  // v downwards. The first triangle: u = x. The second: v of its far corner makes u run otherwise.
  p.uv0 = {{0, 0}, {1, 0}, {0, -1}, {4, -1}};
  const auto direction = [&](std::size_t t) {
    const auto at = [&](std::size_t c) { return glm::dvec3(p.positions[p.indices[3 * t + c]]); };
    const auto uv = [&](std::size_t c) { return glm::dvec2(p.uv0[p.indices[3 * t + c]]); };
    const glm::dvec2 a = uv(1) - uv(0), b = uv(2) - uv(0);
    // Solves dP = Pu du + Pv dv.
    return glm::normalize(((at(1) - at(0)) * b.y - (at(2) - at(0)) * a.y) / (a.x * b.y - a.y * b.x));
  };
  const glm::dvec3 first = direction(0), second = direction(1);
  ASSERT_GT(glm::length(first - second), 0.1);
  const double angle0 = std::atan2(1.0, 1.0);  // of the first triangle at vertex 1
  const glm::dvec3 to2(-1, 1, 0), to3(1, 2, 0);
  const double angle1 = std::acos(glm::dot(glm::normalize(to2), glm::normalize(to3)));
  const glm::dvec3 expected = glm::normalize(first * angle0 + second * angle1);
  makeTangents(p, p.uv0);
  ASSERT_EQ(p.positions.size(), 4u);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(p.tangents[1][i], expected[i], 1e-6);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(p.tangents[0][i], first[i], 1e-6);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(p.tangents[3][i], second[i], 1e-6);
}

// Vertices that a file keeps apart although they are equal are one: the tangent does not know of the split.
TEST(TangentSpace, EqualVerticesAreOne) {
  Primitive split = tessellateShape(ShapeKind::sphere, {1, 0, 0, 0}, 16, 1);
  Primitive shared = split;
  splitVertices(split);
  makeTangents(split, split.uv0);
  makeTangents(shared, shared.uv0);
  ASSERT_EQ(split.indices.size(), shared.indices.size());
  for (std::size_t i = 0; i < split.indices.size(); ++i) {
    EXPECT_LE(glm::length(tangentAt(split, i) - tangentAt(shared, i)), 1e-6f) << i;
  }
}

// u runs once around the axis: tangents lie along the circles of latitude, up to what the facets turn.
TEST(TangentSpace, OnASphereTangentsFollowTheCirclesOfLatitude) {
  Primitive p = tessellateShape(ShapeKind::sphere, {1, 0, 0, 0}, 64, 1);
  makeTangents(p, p.uv0);
  double worst = 0;
  for (std::size_t i = 0; i < p.positions.size(); ++i) {
    const glm::dvec3 n(p.normals[i]), t{glm::vec3(p.tangents[i])};
    const double radius = std::hypot(n.x, n.z);
    EXPECT_NEAR(glm::dot(n, t), 0.0, 1e-6);
    EXPECT_NEAR(glm::length(t), 1.0, 1e-6);
    if (radius < 0.2) continue;  // triangles at the poles see only part of a turn
    const glm::dvec3 around(-n.z / radius, 0, n.x / radius);
    worst = std::max(worst, 1 - std::abs(glm::dot(around, t)));
  }
  EXPECT_LE(worst, 2e-3);  // 1 - cos(2 pi / 64 / 2) = 1.2e-3: half a facet at the seam, where one side is missing
}

TEST(TangentSpace, MirroredSidesOfASeamKeepTheirHands) {
  Primitive p;
  p.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  p.normals.assign(6, {0, 0, 1});
  p.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}, {0, 1}, {0, 0}};  // u comes back
  p.indices = {0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2};
  makeTangents(p, p.uv0);
  EXPECT_EQ(p.positions.size(), 8u);  // both vertices of the seam twice
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(p.tangents[p.indices[i]], glm::vec4(1, 0, 0, 1)) << i;
  for (std::size_t i = 6; i < 12; ++i) EXPECT_EQ(p.tangents[p.indices[i]], glm::vec4(-1, 0, 0, -1)) << i;
}

TEST(TangentSpace, CoordinatesWithoutAreaStillGiveADirectionAcrossTheNormal) {
  Primitive p;
  p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  p.normals.assign(3, {0, 0, 1});
  p.indices = {0, 1, 2};
  p.uv0.assign(3, {0.5f, 0.5f});
  makeTangents(p, p.uv0);
  for (const glm::vec4& t : p.tangents) {
    EXPECT_EQ(t.z, 0.0f);
    EXPECT_NEAR(glm::length(glm::vec3(t)), 1.0f, 1e-6f);
  }
}

}  // namespace
}  // namespace crosslight::test

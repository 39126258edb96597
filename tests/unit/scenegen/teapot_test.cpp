// The teapot's patches and their tessellation, against de Casteljau's construction and numeric derivatives.
#include "scenegen/teapot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenegen/teapot_data.h"
#include "unit/scenegen/mesh_checks.h"

namespace crosslight::scenegen {
namespace {

using glm::dvec3;

constexpr double kDoubleRoundoff = 0x1p-53;
constexpr double kFloatRoundoff = 0x1p-24;
constexpr double kLargestCoordinate = 4.0;

dvec3 deCasteljau(std::array<dvec3, 4> p, double t) {
  for (std::size_t level = 3; level > 0; --level) {
    for (std::size_t i = 0; i < level; ++i) p[i] = (1.0 - t) * p[i] + t * p[i + 1];
  }
  return p[0];
}

dvec3 twinPointAt(const BezierPatch& patch, double u, double v) {
  std::array<dvec3, 4> column;
  for (std::size_t j = 0; j < 4; ++j) column[j] = deCasteljau(patch.points[j], u);
  return deCasteljau(column, v);
}

// Largest third difference of the control points along u: a sixth of the largest third derivative.
double thirdDifference(const BezierPatch& patch, bool alongU) {
  double largest = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto at = [&](std::size_t i) { return alongU ? patch.points[k][i] : patch.points[i][k]; };
    largest = std::max(largest, glm::length(at(3) - 3.0 * at(2) + 3.0 * at(1) - at(0)));
  }
  return largest;
}

TEST(Teapot, hasItsThirtyTwoPatchesOver306Points) {
  const auto patches = teapotPatches();
  EXPECT_EQ(patches.size(), 32u);
  std::set<std::array<double, 3>> points;
  for (const BezierPatch& patch : patches) {
    for (const auto& row : patch.points) {
      for (const dvec3& p : row) points.insert({p.x, p.y, p.z});
    }
  }
  // The classic list has 306 rows: four that no patch uses (the knob's top, moved aside by 0.002), and the twelve of
  // the ring where the bottom joins the body twice.
  EXPECT_EQ(points.size(), 306u - 4u - 12u);
  EXPECT_TRUE(points.contains({3.525, -0.25, 2.49375}));
  EXPECT_TRUE(points.contains({0.84, 1.5, 0.075}));
}

TEST(Teapot, pointsAgreeWithDeCasteljau) {
  for (const BezierPatch& patch : teapotPatches()) {
    for (int i = 0; i <= 8; ++i) {
      for (int j = 0; j <= 8; ++j) {
        const double u = i / 8.0, v = j / 8.0;
        // Some twenty rounded operations on values below the largest coordinate each way.
        EXPECT_LE(glm::distance(pointAt(patch, u, v), twinPointAt(patch, u, v)),
                  40 * kDoubleRoundoff * kLargestCoordinate);
      }
    }
  }
}

TEST(Teapot, normalsAreSquareToNumericDerivatives) {
  const double h = 1e-4;
  for (const BezierPatch& patch : teapotPatches()) {
    for (int i = 1; i < 16; ++i) {
      for (int j = 1; j < 16; ++j) {
        const double u = i / 16.0, v = j / 16.0;
        const dvec3 n = normalAt(patch, u, v);
        const dvec3 du = (twinPointAt(patch, u + h, v) - twinPointAt(patch, u - h, v)) / (2.0 * h);
        const dvec3 dv = (twinPointAt(patch, u, v + h) - twinPointAt(patch, u, v - h)) / (2.0 * h);
        // A central difference of a cubic is off by h^2 times its third difference; rounding is divided by h.
        const double rounding = 20 * kDoubleRoundoff * kLargestCoordinate / h;
        EXPECT_NEAR(glm::length(n), 1.0, 4 * kDoubleRoundoff);
        EXPECT_LE(std::abs(glm::dot(n, du)), h * h * thirdDifference(patch, true) + rounding);
        EXPECT_LE(std::abs(glm::dot(n, dv)), h * h * thirdDifference(patch, false) + rounding);
        EXPECT_GT(glm::dot(glm::cross(du, dv), n), 0.0);
      }
    }
  }
}

TEST(Teapot, normalsAtThePolesAreTheLimitsFromInside) {
  int poles = 0;
  for (const BezierPatch& patch : teapotPatches()) {
    for (const double pole : {0.0, 1.0}) {
      const auto& row = patch.points[pole == 0.0 ? 0 : 3];
      if (row[0] != row[3]) continue;
      ++poles;
      const dvec3 limit = normalAt(patch, 0.4, pole);
      EXPECT_EQ(limit.x, 0.0);
      EXPECT_EQ(limit.y, 0.0);
      EXPECT_NEAR(limit.z, row[0].z > 0.0 ? 1.0 : -1.0, 2 * kDoubleRoundoff);
      const auto gap = [&](double v) { return glm::distance(normalAt(patch, 0.4, std::abs(pole - v)), limit); };
      if (row[0].z > 0.0) {  // the knob is curved, the bottom's middle flat to third order
        EXPECT_LE(gap(1e-3), 0.2 * gap(1e-2));
        EXPECT_LE(gap(1e-4), 0.2 * gap(1e-3));
      }
      EXPECT_LE(gap(1e-4), 1e-3);
    }
  }
  EXPECT_EQ(poles, 8);
}

class TeapotMesh : public testing::TestWithParam<int> {
 protected:
  Primitive mesh = tessellateTeapot(GetParam());
};

TEST_P(TeapotMesh, isOpenAtItsSixKnownEdgesOnly) {
  const auto loops = boundaryLoops(mesh);
  std::multiset<std::string> names;
  for (const auto& loop : loops) {
    dvec3 middle(0.0);
    for (const Point& p : loop) middle += dvec3(p[0], p[1], p[2]) / static_cast<double>(loop.size());
    const double r = std::hypot(double(loop[0][0]), double(loop[0][2]));
    if (std::abs(middle.x) < 1e-3) names.insert(r < 1.35 ? "lid" : "rim");
    if (middle.x < -1.7) names.insert("handle below");
    if (middle.x < -1.0 && middle.x > -1.7) names.insert("handle above");
    if (middle.x > 2.5) names.insert("spout's mouth");
    if (middle.x > 1.0 && middle.x < 2.0) names.insert("spout's foot");
  }
  EXPECT_EQ(names, (std::multiset<std::string>{"lid", "rim", "handle below", "handle above", "spout's mouth",
                                               "spout's foot"}));
}

TEST_P(TeapotMesh, isWoundTheWayItsNormalsPoint) {
  for (const Triangle& t : trianglesOf(mesh)) {
    ASSERT_GT(glm::length(t.areaNormal()), 0.0);
    ASSERT_GT(glm::dot(t.areaNormal(), t.n[0] + t.n[1] + t.n[2]), 0.0);
  }
}

// Patches meet smoothly all over the teapot; where texture coordinates have a seam, the two
// vertices carry the same normal. The one point that two parts share by chance is where the handle's end touches the
// body.
TEST_P(TeapotMesh, hasTheSameNormalOnBothSidesOfEachSeam) {
  std::map<Point, dvec3> seen;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const auto [at, isNew] = seen.emplace(keyOf(mesh.positions[i]), mesh.normals[i]);
    // Two crosses of derivatives of size >= 0.1, each rounded to float once.
    if (isNew || keyOf(mesh.positions[i]) == Point{-2.0f, 0.9f, 0.0f}) continue;
    EXPECT_LE(glm::distance(at->second, dvec3(mesh.normals[i])), 4 * kFloatRoundoff);
  }
  EXPECT_LT(seen.size(), mesh.positions.size());
}

TEST_P(TeapotMesh, fillsTheKnownBox) {
  DBounds bounds;
  for (const glm::vec3& p : mesh.positions) bounds.add(p);
  // y up here. The spout's tip is where its upper profile is farthest: 3.434 for the curve, less by the sagitta of one
  // step (at most |second derivative| / 8 n^2 <= 6 max|second difference| / 8 n^2 = 0.4 / n^2).
  const double sagitta = 0.4 / (GetParam() * GetParam());
  EXPECT_NEAR(bounds.lower.x, -3.0, sagitta);
  EXPECT_NEAR(bounds.upper.x, 3.434, sagitta + 5e-4);
  EXPECT_EQ(bounds.lower.y, 0.0);
  EXPECT_NEAR(bounds.upper.y, 3.15, kFloatRoundoff * 4);
  EXPECT_NEAR(bounds.lower.z, -2.0, sagitta);
  EXPECT_NEAR(bounds.upper.z, 2.0, sagitta);
}

INSTANTIATE_TEST_SUITE_P(steps, TeapotMesh, testing::Values(4, 7, 8, 18));

}  // namespace
}  // namespace crosslight::scenegen

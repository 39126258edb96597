// What every tessellated shape must be: watertight, wound outwards, with the implicit surface's own normals, no farther
// from the surface than its sagitta. The surfaces are written here a second time, as their equations.
#include "scene/shape_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <set>

namespace crosslight {
namespace {

using glm::dvec3;

constexpr double kUnitRoundoff = 0x1p-24;

#define CL_KIND_ROW(value, name, ...) ShapeKind::name,
constexpr ShapeKind kAllKinds[] = {CL_SHAPE_KINDS(CL_KIND_ROW)};
#undef CL_KIND_ROW

using Point = std::array<float, 3>;
Point keyOf(const glm::vec3& p) { return {p.x, p.y, p.z}; }

glm::vec4 paramsOf(ShapeKind kind) {
  if (kind == ShapeKind::box) return {1.5f, 0.7f, 2.25f, 0.0f};
  if (kind == ShapeKind::torus) return {1.5f, 0.4f, 0.0f, 0.0f};
  return {1.3f, 2.1f, 0.0f, 0.0f};
}

bool isOpen(ShapeKind kind) { return kind == ShapeKind::plane || kind == ShapeKind::disk; }

struct Corners {
  dvec3 p[3], n[3];
  dvec3 cross() const { return glm::cross(p[1] - p[0], p[2] - p[0]); }
};

std::vector<Corners> cornersOf(const Primitive& mesh) {
  std::vector<Corners> all;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    Corners c;
    for (std::size_t k = 0; k < 3; ++k) {
      c.p[k] = mesh.positions[mesh.indices[i + k]];
      c.n[k] = mesh.normals[mesh.indices[i + k]];
    }
    all.push_back(c);
  }
  return all;
}

// Directed edges, by position, that no edge of another triangle runs against.
std::multiset<std::pair<Point, Point>> boundaryOf(const Primitive& mesh) {
  std::multiset<std::pair<Point, Point>> open;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Point a = keyOf(mesh.positions[mesh.indices[i + k]]);
      const Point b = keyOf(mesh.positions[mesh.indices[i + (k + 1) % 3]]);
      const auto reverse = open.find({b, a});
      if (reverse != open.end()) {
        open.erase(reverse);
      } else {
        open.insert({a, b});
      }
    }
  }
  return open;
}

double radial(const dvec3& p) { return std::hypot(p.x, p.z); }

// Signed distance-like value of the surface: 0 on it, and never smaller in magnitude than a constant times the
// distance.
double distanceOf(ShapeKind kind, const glm::dvec4& q, const dvec3& p) {
  const double halfHeight = 0.5 * q.y;
  switch (kind) {
    case ShapeKind::sphere:
      return glm::length(p) - q.x;
    case ShapeKind::plane:
      return p.y;
    case ShapeKind::disk:
      return std::max(std::abs(p.y), radial(p) - q.x);
    case ShapeKind::box: {
      const dvec3 d = glm::abs(p) - 0.5 * dvec3(q);
      return std::max({d.x, d.y, d.z});
    }
    case ShapeKind::cylinder:
      return std::max(radial(p) - q.x, std::abs(p.y) - halfHeight);
    case ShapeKind::cone: {
      const double wall = (q.y * radial(p) - q.x * (halfHeight - p.y)) / std::hypot(q.x, q.y);
      return std::max(wall, -halfHeight - p.y);
    }
    case ShapeKind::torus:
      return std::hypot(radial(p) - q.x, p.y) - q.y;
  }
  return NAN;
}

class ShapeMesh : public testing::TestWithParam<std::tuple<ShapeKind, int>> {
 protected:
  ShapeKind kind = std::get<0>(GetParam());
  int segments = std::get<1>(GetParam());
  glm::vec4 params = paramsOf(kind);
  Primitive mesh = tessellateShape(kind, params, segments, 3.0);
  double size = 5.0;  // no coordinate or parameter is larger
};

TEST_P(ShapeMesh, hasEqualNumbersOfEverythingAndValidIndices) {
  EXPECT_EQ(mesh.positions.size(), mesh.normals.size());
  EXPECT_EQ(mesh.positions.size(), mesh.uv0.size());
  ASSERT_EQ(mesh.indices.size() % 3, 0u);
  std::set<std::uint32_t> used(mesh.indices.begin(), mesh.indices.end());
  EXPECT_EQ(used.size(), mesh.positions.size()) << "every vertex is used";
  EXPECT_EQ(*used.rbegin() + 1, mesh.positions.size());
}

TEST_P(ShapeMesh, isClosedOrEndsAtItsRimOnly) {
  const auto open = boundaryOf(mesh);
  if (!isOpen(kind)) {
    EXPECT_EQ(open.size(), 0u);
    return;
  }
  EXPECT_GT(open.size(), 0u);
  for (const auto& [a, b] : open) {
    const dvec3 p(a[0], a[1], a[2]);
    const double rim = kind == ShapeKind::disk ? radial(p) - params.x : std::max(std::abs(p.x), std::abs(p.z)) - 3.0;
    EXPECT_NEAR(rim, 0.0, 2 * kUnitRoundoff * size);
  }
}

TEST_P(ShapeMesh, isWoundTheWayItsNormalsPoint) {
  for (const Corners& c : cornersOf(mesh)) {
    ASSERT_GT(glm::length(c.cross()), 0.0);
    ASSERT_GT(glm::dot(c.cross(), c.n[0] + c.n[1] + c.n[2]), 0.0);
  }
}

TEST_P(ShapeMesh, enclosesAPositiveVolumeWhereItEnclosesOne) {
  if (isOpen(kind)) return;
  double sixfold = 0.0;
  for (const Corners& c : cornersOf(mesh)) sixfold += glm::dot(c.p[0], glm::cross(c.p[1], c.p[2]));
  EXPECT_GT(sixfold, 0.0);
}

TEST_P(ShapeMesh, hasItsVerticesOnTheSurface) {
  if (kind == ShapeKind::plane) size = 3.0;
  for (const glm::vec3& p : mesh.positions) {
    // Three coordinates rounded once each; the distances above have a Lipschitz constant of at most 1.
    ASSERT_NEAR(distanceOf(kind, params, p), 0.0, std::sqrt(3.0) * kUnitRoundoff * size)
        << p.x << ' ' << p.y << ' ' << p.z;
  }
}

TEST_P(ShapeMesh, hasUnitNormals) {
  // Each component is rounded once: at most u relative, so the length is too.
  for (const glm::vec3& n : mesh.normals) ASSERT_NEAR(glm::length(dvec3(n)), 1.0, 2 * kUnitRoundoff);
}

// A small step along the normal moves away from the surface by just that step, and a step along any tangent stays on it
// to second order. On edges and at the apex the distance has a kink, so the test looks at the triangles' insides.
TEST_P(ShapeMesh, hasTheNormalsOfTheSurface) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const dvec3 p = mesh.positions[i], n = mesh.normals[i];
    const double step = 1e-3;
    // Curvature is at most 1 / 0.4 (the torus' tube); the cone's apex and all rims only ever let the distance be
    // smaller.
    const double moved = distanceOf(kind, params, p + step * n);
    ASSERT_LE(moved, step + 4 * kUnitRoundoff * size);
    if (kind == ShapeKind::sphere || kind == ShapeKind::torus || kind == ShapeKind::plane) {
      ASSERT_NEAR(moved, step, 4 * kUnitRoundoff * size);
    }
    if (kind == ShapeKind::sphere) {
      ASSERT_LE(glm::length(p / double(params.x) - n), 2 * kUnitRoundoff);  // both rounded once
    }
    if (kind == ShapeKind::torus) {
      const dvec3 center = dvec3(p.x, 0.0, p.z) * (double(params.x) / radial(p));
      const double bound = kUnitRoundoff * (2.0 * size / double(params.y) + 1.0);  // the point's error over the tube
      ASSERT_LE(glm::length((p - center) / double(params.y) - n), bound);
    }
  }
}

// Faces of cylinder and cone are flat trapezoids between two rulings, so the sagitta is that of one step around. Curved
// both ways: Filip, Magedson, Markot 1986, "Surface Algorithms Using Bounds on Derivatives", Theorem 3.1: a triangle
// over a step du x dv is within (|Suu| du^2 + 2 |Suv| du dv + |Svv| dv^2) / 8 of its surface.
double sagittaBound(ShapeKind kind, const glm::dvec4& q, const Primitive& mesh, int segments) {
  const double du = 2.0 * std::numbers::pi / segments;
  if (kind == ShapeKind::plane || kind == ShapeKind::box || kind == ShapeKind::disk) return 0.0;
  if (kind == ShapeKind::cylinder || kind == ShapeKind::cone) return q.x * (1.0 - std::cos(0.5 * du));
  float height = 0.0f;  // of a row, as texture coordinates have it
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    height = std::max(height, std::abs(mesh.uv0[mesh.indices[i]].y - mesh.uv0[mesh.indices[i + 1]].y));
    height = std::max(height, std::abs(mesh.uv0[mesh.indices[i]].y - mesh.uv0[mesh.indices[i + 2]].y));
  }
  if (kind == ShapeKind::sphere) {
    const double dv = std::numbers::pi * double(height);
    return q.x * (du + dv) * (du + dv) / 8.0;
  }
  const double dv = 2.0 * std::numbers::pi * double(height);
  return ((q.x + q.y) * du * du + 2.0 * q.y * du * dv + q.y * dv * dv) / 8.0;
}

TEST_P(ShapeMesh, isNoFartherFromTheSurfaceThanItsSagitta) {
  const double bound = sagittaBound(kind, params, mesh, segments) + 2 * kUnitRoundoff * size;
  for (const Corners& c : cornersOf(mesh)) {
    for (int a = 0; a <= 4; ++a) {
      for (int b = 0; b <= 4 - a; ++b) {
        const dvec3 p = (c.p[0] * double(a) + c.p[1] * double(b) + c.p[2] * double(4 - a - b)) / 4.0;
        const double d = distanceOf(kind, params, p);
        ASSERT_LE(std::abs(d), bound);
      }
    }
  }
}

TEST_P(ShapeMesh, fillsItsBounds) {
  const auto bounds = shapeBounds(kind, params);
  if (kind == ShapeKind::plane) {
    EXPECT_FALSE(bounds.has_value());
    return;
  }
  ASSERT_TRUE(bounds.has_value());
  DBounds seen;
  for (const glm::vec3& p : mesh.positions) seen.add(p);
  for (int i = 0; i < 3; ++i) {
    EXPECT_GE(seen.lower[i], bounds->lower[i] - kUnitRoundoff * size);  // a vertex is rounded once
    EXPECT_LE(seen.upper[i], bounds->upper[i] + kUnitRoundoff * size);
  }
  if (segments % 4 != 0) return;
  for (int i = 0; i < 3; ++i) {  // points at the quarter turns touch the bounds, but the torus' tube may have odd rows
    const bool loose = kind == ShapeKind::torus && i == 1;
    const double slack = loose ? (1.0 - std::cos(std::numbers::pi / 4)) * double(params.y) : 2 * kUnitRoundoff * size;
    EXPECT_NEAR(seen.lower[i], bounds->lower[i], slack);
    EXPECT_NEAR(seen.upper[i], bounds->upper[i], slack);
  }
}

TEST_P(ShapeMesh, hasTextureCoordinatesThatGrowAlongTheSurface) {
  if (kind == ShapeKind::plane) return;  // in scene units there
  for (const glm::vec2& uv : mesh.uv0) {
    ASSERT_GE(uv.x, 0.0f);
    ASSERT_LE(uv.x, 1.0f);
    ASSERT_GE(uv.y, 0.0f);
    ASSERT_LE(uv.y, 1.0f);
  }
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {  // no triangle spans the seam
    float low = 1.0f, high = 0.0f;
    for (std::size_t k = 0; k < 3; ++k) {
      low = std::min(low, mesh.uv0[mesh.indices[i + k]].x);
      high = std::max(high, mesh.uv0[mesh.indices[i + k]].x);
    }
    ASSERT_LE(high - low, 0.5f * std::max(2.0f, 4.0f / float(segments)));
  }
}

INSTANTIATE_TEST_SUITE_P(kinds, ShapeMesh,
                         testing::Combine(testing::ValuesIn(kAllKinds), testing::Values(3, 4, 7, 16, 64)),
                         [](const auto& row) {
                           return std::string(nameOf(std::get<0>(row.param))) + "_" +
                                  std::to_string(std::get<1>(row.param));
                         });

TEST(ShapeMeshUv, sphereHasLongitudeAndLatitudeAsTheRaysHaveThem) {
  const Primitive mesh = tessellateShape(ShapeKind::sphere, {2.0f, 0.0f, 0.0f, 0.0f}, 32);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const dvec3 p = mesh.positions[i];
    // The height, rounded to float, moves the latitude by its error over the sine; beside the pole that is a row's.
    const double worst = kUnitRoundoff / (std::numbers::pi * std::sin(std::numbers::pi / 16)) + kUnitRoundoff;
    EXPECT_NEAR(mesh.uv0[i].y, std::acos(std::clamp(p.y / 2.0, -1.0, 1.0)) / std::numbers::pi, worst);
    const bool pole = p.x == 0.0 && p.z == 0.0;
    const bool seam = p.z == 0.0 && p.x < 0.0;
    if (!pole && !seam) {
      EXPECT_NEAR(mesh.uv0[i].x, 0.5 + std::atan2(p.z, p.x) / (2 * std::numbers::pi), 4 * kUnitRoundoff);
    }
  }
}

TEST(ShapeMeshBits, aQuarterTurnOfASphereIsTheSameSphere) {
  const Primitive mesh = tessellateShape(ShapeKind::sphere, {1.7f, 0.0f, 0.0f, 0.0f}, 36);
  std::set<Point> points, turned;
  for (const glm::vec3& p : mesh.positions) {
    points.insert(keyOf(p));
    turned.insert(keyOf(glm::vec3(-p.z + 0.0f, p.y, p.x)));
  }
  EXPECT_EQ(points, turned);
}

TEST(Names, areThoseOfTheLists) {
  EXPECT_STREQ(nameOf(ShapeKind::torus), "torus");
  EXPECT_STREQ(nameOf(LightType::directional), "directional");
  EXPECT_STREQ(nameOf(IlluminationModel::blinnPhong), "blinnPhong");
  EXPECT_STREQ(nameOf(ShadingMethod::gouraud), "gouraud");
}

}  // namespace
}  // namespace crosslight

// The shape oracles against closed forms, and every shape of the list against its own definition sampled along rays.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "accel/intersect.h"
#include "meshes.h"

namespace crosslight::oracle {
namespace {

using testing::Random;

double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

void expectTs(const std::vector<ShapeHit>& hits, const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(hits.size(), expected.size());
  for (std::size_t i = 0; i < hits.size(); ++i) EXPECT_NEAR(hits[i].t, expected[i], tolerance);
}

void expectNear(const glm::dvec3& got, const glm::dvec3& expected, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], expected[i], tolerance) << "component " << i;
}

// Long double carries 11 bits more than the doubles that come back: results are the closed form rounded to double.
constexpr double kRounded = 4 * 0x1p-53;

TEST(SphereOracle, IsExactAtUnitScaleInsideAndAtTheTangent) {
  const glm::vec4 unit(1, 0, 0, 0);
  expectTs(shapeHits(ShapeKind::sphere, unit, {.origin = {0, 0, -5}, .direction = {0, 0, 2}}), {2, 3}, kRounded);
  expectTs(shapeHits(ShapeKind::sphere, unit, {.origin = {0, 0, 0}, .direction = {0, 3, 4}}), {0.2}, kRounded);
  expectTs(shapeHits(ShapeKind::sphere, unit, {.origin = {1, 0, -5}, .direction = {0, 0, 1}}), {5}, kRounded);
  EXPECT_TRUE(
      shapeHits(ShapeKind::sphere, unit, {.origin = {std::nextafter(1.0, 2), 0, -5}, .direction = {0, 0, 1}}).empty());
  EXPECT_TRUE(shapeHits(ShapeKind::sphere, unit, {.origin = {0, 0, 5}, .direction = {0, 0, 1}}).empty());
  EXPECT_TRUE(shapeHits(ShapeKind::sphere, unit, {.origin = {0, 0, 5}, .direction = {0, 0, 0}}).empty());
}

// T5 of the hard cases: radius 1e-3 at distance 1e6, impact at half the radius.
TEST(SphereOracle, KeepsSmallSpheresFarAway) {
  const double r = static_cast<double>(1e-3f);
  const auto hit = closestShapeHit(ShapeKind::sphere, glm::vec4(1e-3f, 0, 0, 0),
                                   {.origin = {r / 2, 0, 1e6}, .direction = {0, 0, -1}});
  ASSERT_TRUE(hit);
  expectNear(hit->normal, {0.5, 0, std::sqrt(3.0) / 2}, kRounded);
  EXPECT_EQ(hit->t, 1e6 - r * std::sqrt(3.0) / 2);
}

// T10: closed box, rays within its faces, along its edges, with zeros of either sign.
TEST(BoxOracle, CountsFacesEdgesAndCorners) {
  const glm::vec4 size(1, 1, 1, 0);
  for (const double zero : {0.0, -0.0}) {
    for (const glm::dvec3& origin :
         {glm::dvec3(-0.5, 0, -2), glm::dvec3(-0.5, -0.5, -2), glm::dvec3(0.5, 0.5, -2), glm::dvec3(0, 0.5, -2)}) {
      expectTs(shapeHits(ShapeKind::box, size, {.origin = origin, .direction = {zero, zero, 1}}), {1.5, 2.5}, kRounded);
    }
  }
  const auto corner = shapeHits(ShapeKind::box, size, {.origin = {-1.5, 0.5, 0}, .direction = {1, 1, 0}});
  EXPECT_TRUE(corner.empty()) << "passes outside";
  expectTs(shapeHits(ShapeKind::box, size, {.origin = {-1.5, -0.5, 0}, .direction = {1, 1, 0}}), {1}, kRounded);
  const auto inside = shapeHits(ShapeKind::box, glm::vec4(2, 4, 6, 0), {.origin = {0, 0, 0}, .direction = {0, -1, 0}});
  expectTs(inside, {2}, kRounded);
  expectNear(inside.at(0).normal, {0, -1, 0}, 0);
}

TEST(PlaneAndDiskOracle, HitOnceAndMissWithinTheirPlane) {
  const Ray down{.origin = {3, 8, 4}, .direction = {0, -2, 0}};
  expectTs(shapeHits(ShapeKind::plane, {}, down), {4}, kRounded);
  expectTs(shapeHits(ShapeKind::disk, glm::vec4(5, 0, 0, 0), down), {4}, kRounded);  // exactly on the rim
  EXPECT_TRUE(shapeHits(ShapeKind::disk, glm::vec4(4.9f, 0, 0, 0), down).empty());
  const Ray within{.origin = {3, 0, 4}, .direction = {1, 0, 1}};
  EXPECT_TRUE(shapeHits(ShapeKind::plane, {}, within).empty());
  EXPECT_TRUE(shapeHits(ShapeKind::disk, glm::vec4(5, 0, 0, 0), within).empty());
  const Ray grazing{.origin = {0, 1, 0}, .direction = {1, -1e-7, 0}};  // T13
  expectTs(shapeHits(ShapeKind::plane, {}, grazing), {1e7}, 1e7 * kRounded);
}

// T14: parallel to the axis, where the quadratic loses its square term.
TEST(CylinderOracle, HandlesRaysAlongItsAxis) {
  const glm::vec4 params(1, 4, 0, 0);
  const auto hits = shapeHits(ShapeKind::cylinder, params, {.origin = {0.5, 10, 0}, .direction = {0, -1, 0}});
  expectTs(hits, {8, 12}, kRounded);
  expectNear(hits.at(0).normal, {0, 1, 0}, 0);
  expectNear(hits.at(1).normal, {0, -1, 0}, 0);
  EXPECT_TRUE(shapeHits(ShapeKind::cylinder, params, {.origin = {1.5, 10, 0}, .direction = {0, -1, 0}}).empty());
  expectTs(shapeHits(ShapeKind::cylinder, params, {.origin = {1, 10, 0}, .direction = {0, -1, 0}}), {8, 12}, kRounded);
  const auto side = shapeHits(ShapeKind::cylinder, params, {.origin = {-3, 1, 0}, .direction = {1, 0, 0}});
  expectTs(side, {2, 4}, kRounded);
  expectNear(side.at(0).normal, {-1, 0, 0}, 0);
}

TEST(ConeOracle, HandlesApexGeneratorsAndTheOtherHalf) {
  const glm::vec4 params(2, 4, 0, 0);  // apex (0, 2, 0), base radius 2 at y = -2
  const auto down = shapeHits(ShapeKind::cone, params, {.origin = {0, 6, 0}, .direction = {0, -1, 0}});
  expectTs(down, {4, 8}, kRounded);
  expectNear(down.at(0).normal, {0, 1, 0}, 0);  // the apex
  expectNear(down.at(1).normal, {0, -1, 0}, 0);
  expectTs(shapeHits(ShapeKind::cone, params, {.origin = {-5, 0, 0}, .direction = {1, 0, 0}}), {4, 6}, kRounded);
  EXPECT_TRUE(shapeHits(ShapeKind::cone, params, {.origin = {-5, 3, 0}, .direction = {1, 0, 0}}).empty()) << "above";
  // Parallel to the generator from (2, -2, 0) to the apex: enters the base's center, leaves the other side at (-1, 0,
  // 0).
  const auto parallel = shapeHits(ShapeKind::cone, params, {.origin = {1, -4, 0}, .direction = {-1, 2, 0}});
  expectTs(parallel, {1, 2}, kRounded);
  const auto side = shapeHits(ShapeKind::cone, params, {.origin = {5, 0, 0}, .direction = {-1, 0, 0}});
  expectNear(side.at(0).normal, glm::dvec3(2, 1, 0) / std::sqrt(5.0), kRounded);
}

// T15, with R = 1 and r = 1/4.
TEST(TorusOracle, FindsTheKnownRoots) {
  const glm::vec4 params(1, 0.25f, 0, 0);
  const auto through = shapeHits(ShapeKind::torus, params, {.origin = {-4, 0, 0}, .direction = {1, 0, 0}});
  expectTs(through, {2.75, 3.25, 4.75, 5.25}, 4 * kRounded);
  const double inward[4] = {-1, 1, -1, 1};
  for (std::size_t i = 0; i < through.size(); ++i) expectNear(through[i].normal, {inward[i], 0, 0}, kRounded);
  EXPECT_TRUE(shapeHits(ShapeKind::torus, params, {.origin = {0, 4, 0}, .direction = {0, -1, 0}}).empty());
  // The plane y = r touches the torus along a circle of radius R: a double root at |x| = 1. A perturbation e of the
  // value moves a double root by sqrt(e / f''), here sqrt(2^-64).
  const auto touching = shapeHits(ShapeKind::torus, params, {.origin = {-4, 0.25, 0}, .direction = {1, 0, 0}});
  ASSERT_GE(touching.size(), 2u);
  for (const ShapeHit& hit : touching) {
    EXPECT_NEAR(std::abs(hit.point.x), 1, 0x1p-30);
    expectNear(hit.normal, {0, 1, 0}, 0x1p-28);
  }
  const double above = std::nextafter(0.25, 1);
  EXPECT_TRUE(shapeHits(ShapeKind::torus, params, {.origin = {-4, above, 0}, .direction = {1, 0, 0}}).empty());
}

struct Case {
  ShapeKind kind;
  glm::vec4 params;
  std::string name;
};

// Every kind of the list; the parameters that no shape has are 0.
std::vector<Case> allShapes() {
  std::vector<Case> cases;
#define CL_CASE(value, name, ...) cases.push_back({ShapeKind::name, glm::vec4(0), #name});
  CL_SHAPE_KINDS(CL_CASE)
#undef CL_CASE
  for (Case& c : cases) c.params = c.kind == ShapeKind::torus ? glm::vec4(1, 0.4f, 0, 0) : glm::vec4(1, 1.5f, 0.75f, 0);
  return cases;
}

// The definitions of CL_SHAPE_KINDS. Flat shapes: which side of the plane, and nothing outside the disk's reach.
bool isInside(const Case& c, const glm::dvec3& p) {
  const double axis = std::sqrt(p.x * p.x + p.z * p.z), a = c.params.x, b = c.params.y;
  switch (c.kind) {
    case ShapeKind::sphere:
      return dot(p, p) <= a * a;
    case ShapeKind::plane:
      return p.y <= 0;
    case ShapeKind::disk:
      return p.y <= 0 && axis <= a;
    case ShapeKind::box:
      return std::abs(p.x) <= a / 2 && std::abs(p.y) <= b / 2 && std::abs(p.z) <= double{c.params.z} / 2;
    case ShapeKind::cylinder:
      return std::abs(p.y) <= b / 2 && axis <= a;
    case ShapeKind::cone:
      return std::abs(p.y) <= b / 2 && axis <= a * (b / 2 - p.y) / b;
    case ShapeKind::torus:
      return (axis - a) * (axis - a) + p.y * p.y <= b * b;
  }
  return false;
}

class EveryShape : public ::testing::TestWithParam<Case> {};

// Along each ray, inside and outside alternate exactly at the hits. For the disk only its face counts, not the tube
// below it that isInside() describes.
TEST_P(EveryShape, IsCrossedWhereItsDefinitionChanges) {
  const Case c = GetParam();
  Random random(77);
  int crossed = 0;
  for (int i = 0; i < 4000; ++i) {
    const glm::dvec3 origin = random.inBox(2.5);
    const Ray ray{.origin = origin, .direction = glm::dvec3(random.inBox(1)) - origin, .tMax = 3};
    const auto hits = shapeHits(c.kind, c.params, ray);
    constexpr int kSteps = 300;
    std::size_t next = 0;
    for (int k = 0; k < kSteps; ++k) {
      const double from = 3.0 * k / kSteps, to = 3.0 * (k + 1) / kSteps;
      const glm::dvec3 a = origin + from * ray.direction, b = origin + to * ray.direction;
      std::size_t between = 0;
      for (; next < hits.size() && hits[next].t <= to; ++next) ++between;
      const bool changes = isInside(c, a) != isInside(c, b);
      if (c.kind == ShapeKind::disk && (a.y <= 0) == (b.y <= 0)) {
        ASSERT_EQ(between, 0u);
        continue;
      }
      if (c.kind == ShapeKind::disk) {
        const double s = a.y / (a.y - b.y);
        ASSERT_EQ(between == 1, isInside(c, {a.x + s * (b.x - a.x), 0, a.z + s * (b.z - a.z)})) << "ray " << i;
      } else {
        ASSERT_EQ(between % 2 == 1, changes) << "ray " << i << " between t = " << from << " and " << to;
      }
      crossed += static_cast<int>(between);
    }
    ASSERT_EQ(next, hits.size());
  }
  EXPECT_GT(crossed, 1000);
}

TEST_P(EveryShape, HasUnitNormalsThatPointOut) {
  const Case c = GetParam();
  Random random(78);
  for (int i = 0; i < 4000; ++i) {
    const glm::dvec3 origin = random.inBox(2.5);
    const Ray ray{.origin = origin, .direction = glm::dvec3(random.inBox(1)) - origin};
    for (const ShapeHit& hit : shapeHits(c.kind, c.params, ray)) {
      EXPECT_NEAR(std::sqrt(dot(hit.normal, hit.normal)), 1, kRounded);
      const glm::dvec3 p = origin + hit.t * ray.direction;
      // Product and sum here, and t itself, are rounded once each; |origin| < 5.
      expectNear(hit.point, p, 3 * 0x1p-53 * (5 + 2 * hit.t * std::sqrt(dot(ray.direction, ray.direction))));
      if (c.kind == ShapeKind::disk) continue;
      // A step of 2^-20 along the normal leaves the shape, a step against it enters: curvature radii are >= 0.3, so
      // the step's deviation from the tangent, 2^-40 / 0.6, is far below it. Edges are within 2^-18 with no hit here.
      EXPECT_FALSE(isInside(c, hit.point + 0x1p-20 * hit.normal)) << "ray " << i;
      EXPECT_TRUE(isInside(c, hit.point - 0x1p-20 * hit.normal)) << "ray " << i;
    }
  }
}

TEST_P(EveryShape, IsHitAtTheSamePointsFromFarAway) {
  const Case c = GetParam();
  Random random(79);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 direction = random.direction(), origin = random.inBox(0.7);
    constexpr double kFar = 0x1p14;
    const glm::dvec3 start = origin - kFar * direction;
    // The rounding of `start`, half an ulp of 2^14, is taken back, so that both rays lie on the same line.
    const auto far = shapeHits(c.kind, c.params, {.origin = start, .direction = direction});
    const auto near =
        shapeHits(c.kind, c.params, {.origin = start + kFar * direction, .direction = direction, .tMin = -1e9});
    if (far.size() != near.size()) continue;  // tangents; their number is bounded by the crossings test
    for (std::size_t k = 0; k < far.size(); ++k) {
      const double cosine = std::abs(dot(far[k].normal, direction));
      // Start and sum are rounded to 2^-40 at 2^14; along the surface that grows with 1 / cosine.
      expectNear(far[k].point, near[k].point, 4 * 0x1p-40 / std::max(cosine, 1e-3));
    }
  }
}

std::string nameOfCase(const ::testing::TestParamInfo<Case>& testCase) { return testCase.param.name; }
INSTANTIATE_TEST_SUITE_P(List, EveryShape, ::testing::ValuesIn(allShapes()), nameOfCase);

}  // namespace
}  // namespace crosslight::oracle

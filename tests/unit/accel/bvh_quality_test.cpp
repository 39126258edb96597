// What the qualities of a tree promise: the same hits, spatial splits that leave no part of a triangle out, and costs
// in the order of their names.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "accel/bvh_clip.h"
#include "meshes.h"

namespace crosslight {
namespace {

using oracle::Triangle;
using testing::Random;

struct Mesh {
  std::vector<Triangle> triangles;
  std::vector<glm::vec3> corners;
  std::vector<std::uint32_t> indices;

  explicit Mesh(std::vector<Triangle> list) : triangles(std::move(list)) {
    for (const Triangle& t : triangles) {
      for (const glm::vec3& p : {t.v0, t.v1, t.v2}) {
        indices.push_back(static_cast<std::uint32_t>(corners.size()));
        corners.push_back(p);
      }
    }
  }
  Bvh build(BvhQuality quality, std::uint32_t threads = 0) const {
    return buildTriangleBvh({corners, indices}, {.threads = threads, .quality = quality});
  }
};

// Long and thin, in every direction: their boxes are nearly all empty.
std::vector<Triangle> needles(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 center = random.inBox(1), reach = glm::vec3(0.5 * random.direction()), width = random.inBox(0.005);
    triangles.push_back({center - reach, center + reach, center + width});
  }
  return triangles;
}

// Large triangles among many small ones, as walls among what stands between them: what spatial splits are for.
std::vector<Triangle> hall(std::size_t count, std::uint64_t seed) {
  std::vector<Triangle> triangles = testing::randomSoup(count, 0.02, seed);
  for (const Triangle& wall : testing::randomSoup(60, 1, seed + 1)) triangles.push_back(wall);
  return triangles;
}

TEST(BvhOfTriangles, EqualsTheOneOfTheirBoxes) {
  const Mesh mesh(testing::torusKnot(400, 20));
  for (const BvhQuality quality : {BvhQuality::fast, BvhQuality::medium}) {
    const Bvh some = mesh.build(quality);
    const Bvh other = buildBvh(testing::boundsOf(mesh.triangles), {.quality = quality});
    ASSERT_EQ(some.nodes.size(), other.nodes.size());
    EXPECT_EQ(0, std::memcmp(some.nodes.data(), other.nodes.data(), some.nodes.size() * sizeof(shared::BvhNode)));
    EXPECT_EQ(some.order, other.order);
  }
}

class EveryQuality : public ::testing::TestWithParam<BvhQuality> {};

TEST_P(EveryQuality, FindsTheHitsOfBruteForce) {
  for (const Mesh& mesh :
       {Mesh(testing::torusKnot(60, 12)), Mesh(needles(1500, 4)), Mesh(testing::randomSoup(1500, 0.3, 5)),
        Mesh(testing::uvSphere(24, 48, glm::dvec3(0), 0.9)), Mesh(testing::randomSoup(3, 1, 6))}) {
    const Bvh bvh = mesh.build(GetParam());
    Random random(77);
    int hits = 0;
    for (int i = 0; i < 1500; ++i) {
      const glm::dvec3 origin = 2.5 * random.direction();
      const oracle::Ray ray{.origin = origin, .direction = glm::dvec3(random.inBox(0.9)) - origin};
      const auto expected = oracle::closestHitNaive<double>(mesh.triangles, ray);
      const auto got = oracle::closestHit(bvh, mesh.triangles, ray);
      ASSERT_EQ(expected.has_value(), got.has_value()) << "ray " << i;
      if (!expected) continue;
      ++hits;
      ASSERT_EQ(expected->t, got->t) << "ray " << i;
      ASSERT_EQ(expected->id, got->id) << "ray " << i;
    }
    EXPECT_GT(hits, 50);
  }
}

// Where cut triangles meet: rays at the very planes of the nodes' faces.
TEST_P(EveryQuality, FindsTheHitsWithinTheFacesOfNodes) {
  const Mesh mesh(hall(300, 9));
  const Bvh bvh = mesh.build(GetParam());
  Random random(78);
  for (int i = 0; i < 6000; ++i) {
    const shared::BvhNode& node = bvh.nodes[random.below(bvh.nodes.size())];
    const glm::vec3 faces[] = {node.lower0, node.upper0, node.lower1, node.upper1};
    const int axis = static_cast<int>(random.below(3)), other = (axis + 1) % 3;
    const Triangle& t = mesh.triangles[random.below(mesh.triangles.size())];
    const double u = random.unit(), v = (1 - u) * random.unit();
    glm::dvec3 target = (1 - u - v) * glm::dvec3(t.v0) + u * glm::dvec3(t.v1) + v * glm::dvec3(t.v2);
    target[axis] = faces[random.below(4)][axis];
    glm::dvec3 direction(0);
    direction[other] = random.below(2) == 0 ? 1 : -1;
    const oracle::Ray ray{.origin = target - 4.0 * direction, .direction = direction};
    const auto expected = oracle::closestHitNaive<double>(mesh.triangles, ray);
    const auto got = oracle::closestHit(bvh, mesh.triangles, ray);
    ASSERT_EQ(expected.has_value(), got.has_value()) << "ray " << i;
    if (!expected) continue;
    ASSERT_EQ(expected->id, got->id) << "ray " << i;
  }
}

TEST_P(EveryQuality, IsTheSameWhateverTheNumberOfThreads) {
  const Mesh mesh(hall(20000, 2));
  const Bvh one = mesh.build(GetParam(), 1);
  for (const std::uint32_t threads : {2u, 5u}) {
    const Bvh other = mesh.build(GetParam(), threads);
    ASSERT_EQ(one.nodes.size(), other.nodes.size());
    EXPECT_EQ(0, std::memcmp(one.nodes.data(), other.nodes.data(), one.nodes.size() * sizeof(shared::BvhNode)));
    EXPECT_EQ(one.order, other.order);
  }
}

std::string nameOfQuality(const ::testing::TestParamInfo<BvhQuality>& info) {
  return std::array{"fast", "medium", "high"}[static_cast<std::size_t>(info.param)];
}
INSTANTIATE_TEST_SUITE_P(Qualities, EveryQuality,
                         ::testing::Values(BvhQuality::fast, BvhQuality::medium, BvhQuality::high), nameOfQuality);

TEST(BvhQualities, CostLessTheHigherTheyAre) {
  const Mesh mesh(hall(4000, 1));
  const double fast = mesh.build(BvhQuality::fast).stats.sahCost, medium = mesh.build(BvhQuality::medium).stats.sahCost,
               high = mesh.build(BvhQuality::high).stats.sahCost;
  EXPECT_LT(medium, 0.9 * fast);
  EXPECT_LT(high, 0.9 * medium);
}

TEST(SpatialSplits, StayWithinTheirBudget) {
  const Mesh mesh(hall(4940, 8));
  double cost = mesh.build(BvhQuality::medium).stats.sahCost;
  for (const float share : {0.0f, 0.02f, 0.1f, 2.0f}) {
    const BvhOptions options{.quality = BvhQuality::high, .mostDuplicates = share};
    const Bvh bvh = buildTriangleBvh({mesh.corners, mesh.indices}, options);
    EXPECT_LE(static_cast<double>(bvh.order.size()), 5000.0 * (1 + double{share}));
    EXPECT_EQ(bvh.order.size() > 5000, share > 0);
    EXPECT_EQ(bvh.stats.primitives, 5000u);
    EXPECT_LT(bvh.stats.sahCost, 1.01 * cost) << "more room, no more cost";
    cost = bvh.stats.sahCost;
  }
}

struct LeafBoxes {
  std::vector<std::vector<Bounds>> of;  // by triangle
};

Bounds gather(const Bvh& bvh, std::uint32_t child, const Bounds& box, LeafBoxes& leaves) {
  if (bvhIsLeaf(child)) {
    for (std::uint32_t i = 0; i < bvhLeafCount(child); ++i)
      leaves.of.at(bvh.order.at(bvhLeafFirst(child) + i)).push_back(box);
    return box;
  }
  const shared::BvhNode& node = bvh.nodes.at(child);
  Bounds all;
  all.add(gather(bvh, node.child0, {node.lower0, node.upper0}, leaves));
  all.add(gather(bvh, node.child1, {node.lower1, node.upper1}, leaves));
  if (child != 0) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LE(box.lower[axis], all.lower[axis]) << "node " << child;
      EXPECT_GE(box.upper[axis], all.upper[axis]) << "node " << child;
    }
  }
  return box;
}

TEST(SpatialSplits, LeaveNoPointOfATriangleOutside) {
  const Mesh mesh(hall(3000, 6));
  const Bvh bvh = mesh.build(BvhQuality::high);
  EXPECT_GT(bvh.order.size(), 3200u);
  EXPECT_LT(bvh.stats.maxDepth, shared::kBvhStackSize);
  LeafBoxes leaves{std::vector<std::vector<Bounds>>(mesh.triangles.size())};
  gather(bvh, 0, {}, leaves);
  Random random(31);
  // A point rounded in double lies off its triangle by a few 2^-53 of coordinates below 2.
  constexpr double kRounded = 0x1p-50;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    ASSERT_FALSE(leaves.of[i].empty());
    const Triangle& t = mesh.triangles[i];
    for (int k = 0; k < 60; ++k) {
      const double u = k < 20 ? 0 : random.unit(), v = (1 - u) * random.unit();
      const glm::dvec3 p = (1 - u - v) * glm::dvec3(t.v0) + u * glm::dvec3(t.v1) + v * glm::dvec3(t.v2);
      const bool inside = std::any_of(leaves.of[i].begin(), leaves.of[i].end(), [&](const Bounds& b) {
        for (int axis = 0; axis < 3; ++axis) {
          if (!(p[axis] >= b.lower[axis] - kRounded && p[axis] <= b.upper[axis] + kRounded)) return false;
        }
        return true;
      });
      ASSERT_TRUE(inside) << "triangle " << i << " in " << leaves.of[i].size() << " leaves";
    }
  }
}

TEST(SpatialSplits, SurviveFlatTinyAndHugeTriangles) {
  for (const float scale : {1e-44f, 1e-38f, 1e-30f, 1e30f, 9.9e37f}) {
    auto triangles = needles(400, 3);
    for (Triangle& t : triangles) t = {t.v0 * (0.6f * scale), t.v1 * (0.6f * scale), t.v2 * (0.6f * scale)};
    const Mesh mesh(triangles);
    const Bvh bvh = mesh.build(BvhQuality::high);
    std::vector<bool> seen(triangles.size());
    for (const std::uint32_t p : bvh.order) seen.at(p) = true;
    EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 400) << "scale " << scale;
  }
  for (int axis = 0; axis < 3; ++axis) {
    auto triangles = needles(400, 3);
    for (Triangle& t : triangles) t.v0[axis] = t.v1[axis] = t.v2[axis] = 0.25f;
    const Bvh bvh = Mesh(triangles).build(BvhQuality::high);
    EXPECT_GE(bvh.order.size(), 400u);
  }
  const Bvh points =
      Mesh(std::vector<Triangle>(300, Triangle{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}})).build(BvhQuality::high);
  EXPECT_EQ(points.order.size(), 300u);
}

// The exact part of a right triangle with legs of 4 between x = 1 and x = 2: y reaches 4 - x.
TEST(SpatialSplits, CutATriangleExactlyWhereFloatsCan) {
  const accel::Corners triangle{{{0, 0, 1}, {4, 0, 1}, {0, 4, 1}}};
  accel::Box box;
  box.lower = accel::Float4{0, 0, 1, 0};
  box.upper = accel::Float4{4, 4, 1, 0};
  const accel::Box part = accel::clippedBox(triangle, box, 0, 1, 2);
  EXPECT_EQ(part.lower[0], 1.0f);
  EXPECT_EQ(part.upper[0], 2.0f);
  EXPECT_GE(part.upper[1], 3.0f);
  EXPECT_LE(part.upper[1], std::nextafter(3.0f, 4.0f)) << "one float of margin";
  EXPECT_EQ(part.lower[2], 1.0f) << "within the box that it had";
  EXPECT_EQ(part.upper[2], 1.0f);
}

}  // namespace
}  // namespace crosslight

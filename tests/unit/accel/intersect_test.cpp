// The triangle oracles, and the tree against brute force: the same hit, bit for bit.
#include "accel/intersect.h"

#include <gtest/gtest.h>

#include <cmath>

#include "meshes.h"

namespace crosslight::oracle {
namespace {

using testing::boundsOf;
using testing::Random;

void expectSameHit(const Bvh& bvh, const std::vector<Triangle>& triangles, const Ray& ray) {
  const auto naive = closestHitNaive<double>(triangles, ray);
  const auto tree = closestHit(bvh, triangles, ray);
  ASSERT_EQ(naive.has_value(), tree.has_value())
      << "ray from " << ray.origin.x << " " << ray.origin.y << " " << ray.origin.z;
  if (!naive) return;
  ASSERT_EQ(naive->t, tree->t);
  ASSERT_EQ(naive->id, tree->id);
}

TEST(TriangleOracle, FindsTheExactHitOfARightTriangle) {
  const Triangle triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const Ray ray{.origin = {1, 2, 8}, .direction = {0, 0, -2}};
  const auto hit = intersectTriangle<double>(triangle, ray);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 4);
  EXPECT_EQ(hit->u, 0.25);
  EXPECT_EQ(hit->v, 0.5);
  EXPECT_FALSE(intersectTriangle<double>(triangle, {.origin = {3, 3, 8}, .direction = {0, 0, -1}}));
  EXPECT_FALSE(intersectTriangle<double>(triangle, {.origin = {1, 1, 8}, .direction = {0, 0, 1}})) << "behind";
  EXPECT_FALSE(intersectTriangle<double>(triangle, {.origin = {-1, 1, 0}, .direction = {1, 0, 0}})) << "in its plane";
  EXPECT_FALSE(intersectTriangle<double>(triangle, {.origin = {1, 1, 8}, .direction = {0, 0, -1}, .tMax = 7.5}));
  EXPECT_FALSE(intersectTriangle<double>(triangle, {.origin = {1, 1, 8}, .direction = {0, 0, -1}, .tMin = 8.5}));
  EXPECT_TRUE(intersectTriangle<double>(triangle, {.origin = {1, 1, 8}, .direction = {0, 0, -1}, .tMax = 8}));
  EXPECT_TRUE(intersectTriangle<double>(triangle, {.origin = {1, 1, -8}, .direction = {0, 0, 1}})) << "from behind";
}

TEST(TriangleOracle, CountsEdgesAndCornersAndNotDegenerateTriangles) {
  const Triangle triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  for (const glm::dvec3& p :
       {glm::dvec3(0, 0, 0), glm::dvec3(4, 0, 0), glm::dvec3(0, 4, 0), glm::dvec3(2, 0, 0), glm::dvec3(2, 2, 0)}) {
    EXPECT_TRUE(intersectTriangle<double>(triangle, {.origin = p + glm::dvec3(0, 0, 1), .direction = {0, 0, -1}}));
  }
  const Triangle line{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, point{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  EXPECT_FALSE(intersectTriangle<double>(line, {.origin = {1, 1, 5}, .direction = {0, 0, -1}}));
  EXPECT_FALSE(intersectTriangle<double>(point, {.origin = {1, 1, 5}, .direction = {0, 0, -1}}));
}

TEST(TriangleOracle, DoubleAndLongDoubleAgreeAwayFromEdges) {
  Random random(21);
  int hits = 0;
  for (int i = 0; i < 100000; ++i) {
    const Triangle triangle{random.inBox(1), random.inBox(1), random.inBox(1)};
    const glm::vec3 middle = (triangle.v0 + triangle.v1 + triangle.v2) / 3.0f;
    const Ray ray{.origin = random.inBox(3), .direction = glm::dvec3(middle + random.inBox(0.3)) - ray.origin};
    const auto fine = intersectTriangle<long double>(triangle, ray);
    const auto coarse = intersectTriangle<double>(triangle, ray);
    if (!fine || !coarse) continue;
    ++hits;
    // Each edge function errs by less than 64 * 2^-53 L^2 (see intersect.cpp), L < 4 sqrt(3) the largest distance of a
    // corner; t = sum(w z) / sum(w) with three of them above and below, and |z| at most L |d_z|^-1.
    const glm::dvec3 d = ray.direction;
    const double dz = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}), largest = 4 * std::sqrt(3.0);
    const glm::dvec3 e1 = glm::dvec3(triangle.v1) - glm::dvec3(triangle.v0),
                     e2 = glm::dvec3(triangle.v2) - glm::dvec3(triangle.v0);
    const glm::dvec3 n{e1.y * e2.z - e1.z * e2.y, e1.z * e2.x - e1.x * e2.z, e1.x * e2.y - e1.y * e2.x};
    const double sum = std::abs(n.x * d.x + n.y * d.y + n.z * d.z) / dz;
    const double bound = 2 * 3 * 64 * 0x1p-53 * largest * largest * (largest / dz) / sum;
    EXPECT_LE(std::abs(static_cast<double>(fine->t - coarse->t)), bound) << "ray " << i;
  }
  EXPECT_GT(hits, 1000);
}

// T8 of the hard cases: from within a closed mesh no ray escapes, not even at corners and edges, far from the origin.
TEST(TriangleOracle, LosesNoRayAtCornersAndEdgesOfAClosedMesh) {
  for (const glm::dvec3& center : {glm::dvec3(0), glm::dvec3(148376, 1234, -223423), glm::dvec3(1e6)}) {
    const auto mesh = testing::uvSphere(12, 24, center, 2);
    Random random(8);
    for (int i = 0; i < 3000; ++i) {
      const Triangle& t = mesh[random.below(mesh.size())];
      const double s = i % 3 == 0 ? 0.0 : random.unit();  // corners, then points on edges
      const glm::dvec3 target = (1 - s) * glm::dvec3(t.v0) + s * glm::dvec3(t.v1);
      const glm::dvec3 origin = center + glm::dvec3(random.inBox(0.5));
      ASSERT_TRUE(closestHitNaive<double>(mesh, {.origin = origin, .direction = target - origin}));
    }
  }
}

TEST(TriangleOracle, OfEquallyNearHitsTakesTheLowestIndex) {
  const Triangle triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const std::vector<Triangle> copies(9, triangle);
  const Ray ray{.origin = {1, 1, 8}, .direction = {0, 0, -1}};
  EXPECT_EQ(closestHitNaive<double>(copies, ray)->id, 0u);
  EXPECT_EQ(closestHit(buildBvh(boundsOf(copies)), copies, ray)->id, 0u);
}

TEST(BvhAgainstBruteForce, FindsTheSameHitsInRandomTriangles) {
  const auto triangles = testing::randomSoup(2000, 0.1, 1);
  for (const std::uint32_t leaf : {1u, 4u, 15u}) {
    const Bvh bvh = buildBvh(boundsOf(triangles), {.maxLeafSize = leaf});
    Random random(leaf);
    for (int i = 0; i < 5000; ++i) {
      Ray ray{.origin = random.inBox(2), .direction = random.direction()};
      if (i % 4 == 0) ray.tMax = random.unit();
      expectSameHit(bvh, triangles, ray);
    }
  }
}

TEST(BvhAgainstBruteForce, FindsTheSameHitsAtCornersOfTriangles) {
  const auto triangles = testing::randomSoup(1500, 0.1, 2);
  const Bvh bvh = buildBvh(boundsOf(triangles));
  Random random(4);
  for (int i = 0; i < 5000; ++i) {
    const Triangle& target = triangles[random.below(triangles.size())];
    const glm::dvec3 origin = random.inBox(2);
    expectSameHit(bvh, triangles, {.origin = origin, .direction = glm::dvec3(target.v1) - origin});
  }
}

// Coordinates on a lattice: box faces coincide, and the rays run exactly within them and through lattice points.
TEST(BvhAgainstBruteForce, FindsTheSameHitsWithinTheFacesOfNodes) {
  Random random(6);
  const auto lattice = [&] { return std::floor(random.between(-4, 5)); };
  std::vector<Triangle> triangles;
  for (int i = 0; i < 1500; ++i) {
    Triangle t;
    for (glm::vec3* v : {&t.v0, &t.v1, &t.v2}) *v = glm::vec3(glm::dvec3(lattice(), lattice(), lattice()));
    triangles.push_back(t);
  }
  const Bvh bvh = buildBvh(boundsOf(triangles));
  int hits = 0;
  for (int i = 0; i < 6000; ++i) {
    glm::dvec3 d(0);
    if (i % 3 == 0) d[static_cast<int>(random.below(3))] = i % 2 == 0 ? 1 : -1;
    if (i % 3 != 0) d = {lattice(), lattice(), i % 3 == 1 ? 0.0 : lattice()};
    if (d == glm::dvec3(0)) continue;
    const Ray ray{.origin = {lattice(), lattice(), lattice()}, .direction = d};
    hits += closestHitNaive<double>(triangles, ray).has_value();
    expectSameHit(bvh, triangles, ray);
  }
  EXPECT_GT(hits, 1000);
}

TEST(BvhAgainstBruteForce, FindsNothingInNothing) {
  EXPECT_FALSE(closestHit(buildBvh({}), {}, {.direction = {0, 0, 1}}));
}

}  // namespace
}  // namespace crosslight::oracle

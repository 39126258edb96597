// Refitting: the same bits where nothing moved, boxes and hits of the moved triangles where something did.
#include "accel/refit.h"

#include <gtest/gtest.h>

#include <cstring>

#include "base/error.h"
#include "meshes.h"

namespace crosslight {
namespace {

using testing::boundsOf;
using testing::Random;

std::vector<oracle::Triangle> twisted(std::vector<oracle::Triangle> triangles, double turns) {
  const auto turn = [&](glm::vec3& p) {
    const double a = turns * 2 * std::numbers::pi * p.y, x = p.x, z = p.z;
    p.x = static_cast<float>(std::cos(a) * x - std::sin(a) * z);
    p.z = static_cast<float>(std::sin(a) * x + std::cos(a) * z);
  };
  for (oracle::Triangle& t : triangles) {
    turn(t.v0);
    turn(t.v1);
    turn(t.v2);
  }
  return triangles;
}

bool sameNodes(const Bvh& a, const Bvh& b) {
  return a.nodes.size() == b.nodes.size() && a.order == b.order &&
         std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(shared::BvhNode)) == 0;
}

// The union of the primitives below a child; every box on the way must be exactly that.
Bounds exactBox(const Bvh& bvh, const std::vector<Bounds>& boxes, std::uint32_t child) {
  Bounds all;
  if (bvhIsLeaf(child)) {
    for (std::uint32_t i = 0; i < bvhLeafCount(child); ++i) all.add(boxes[bvh.order.at(bvhLeafFirst(child) + i)]);
    return all;
  }
  const shared::BvhNode& node = bvh.nodes.at(child);
  for (int c = 0; c < 2; ++c) {
    const Bounds below = exactBox(bvh, boxes, c == 0 ? node.child0 : node.child1);
    if (below.empty()) continue;
    EXPECT_EQ(c == 0 ? node.lower0 : node.lower1, below.lower) << "node " << child;
    EXPECT_EQ(c == 0 ? node.upper0 : node.upper1, below.upper) << "node " << child;
    all.add(below);
  }
  return all;
}

TEST(Refit, OfUnchangedBoxesLeavesTheSameBits) {
  for (const std::size_t count : {0u, 1u, 2u, 5u, 3000u, 60000u}) {
    const auto boxes = boundsOf(testing::randomSoup(count, 0.02, count + 1));
    for (const BvhQuality quality : {BvhQuality::fast, BvhQuality::medium}) {
      const Bvh built = buildBvh(boxes, {.quality = quality});
      Bvh refitted = built;
      const RefitResult result = refit(refitted, boxes);
      EXPECT_TRUE(sameNodes(built, refitted)) << count << " primitives";
      EXPECT_EQ(built.bounds.lower, refitted.bounds.lower);
      EXPECT_EQ(built.bounds.upper, refitted.bounds.upper);
      // The same terms, added in another order: a sum of n positive terms is off by n u of itself.
      EXPECT_NEAR(result.growth, 1, 2.0 * static_cast<double>(count + 1) * 0x1p-53);
    }
  }
}

TEST(Refit, GivesEveryNodeTheExactBoxOfWhatMoved) {
  for (const BvhQuality quality : {BvhQuality::fast, BvhQuality::medium}) {
    const auto before = testing::torusKnot(600, 20);
    const auto boxes = boundsOf(twisted(before, 0.3));
    Bvh bvh = buildBvh(boundsOf(before), {.quality = quality});
    const RefitResult result = refit(bvh, boxes);
    const Bounds all = exactBox(bvh, boxes, 0);
    EXPECT_EQ(bvh.bounds.lower, all.lower);
    EXPECT_EQ(bvh.bounds.upper, all.upper);
    EXPECT_EQ(result.sahCost, bvh.stats.sahCost);
  }
}

TEST(Refit, IsTheSameWhateverTheNumberOfThreads) {
  const auto before = testing::randomSoup(100000, 0.01, 4);
  const Bvh built = buildBvh(boundsOf(before));
  const auto boxes = boundsOf(twisted(before, 0.1));
  Bvh one = built;
  const double cost = refit(one, boxes, 1).sahCost;
  for (const std::uint32_t threads : {2u, 3u, 8u}) {
    Bvh other = built;
    EXPECT_EQ(refit(other, boxes, threads).sahCost, cost);
    EXPECT_TRUE(sameNodes(one, other)) << threads << " threads";
  }
}

TEST(Refit, FindsTheClosestHitsOfBruteForce) {
  const auto before = testing::torusKnot(80, 12);
  for (const BvhQuality quality : {BvhQuality::fast, BvhQuality::medium, BvhQuality::high}) {
    std::vector<glm::vec3> corners;
    std::vector<std::uint32_t> indices;
    for (const auto& t : before) {
      for (const glm::vec3& p : {t.v0, t.v1, t.v2}) {
        indices.push_back(static_cast<std::uint32_t>(corners.size()));
        corners.push_back(p);
      }
    }
    Bvh bvh = buildTriangleBvh({corners, indices}, {.quality = quality});
    const auto after = twisted(before, 0.4);
    refit(bvh, boundsOf(after));
    Random random(21);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec3 origin = 2.0 * random.direction();
      const oracle::Ray ray{.origin = origin, .direction = glm::dvec3(random.inBox(0.8)) - origin};
      const auto expected = oracle::closestHitNaive<double>(after, ray);
      const auto got = oracle::closestHit(bvh, after, ray);
      ASSERT_EQ(expected.has_value(), got.has_value()) << "ray " << i;
      if (!expected) continue;
      ++hits;
      ASSERT_EQ(expected->t, got->t);
      ASSERT_EQ(expected->id, got->id);
    }
    EXPECT_GT(hits, 400);
  }
}

TEST(Refit, SaysHowMuchRaysLose) {
  const auto before = testing::randomSoup(5000, 0.01, 8);
  auto boxes = boundsOf(before);
  Bvh bvh = buildBvh(boxes);
  Random random(3);
  for (std::size_t i = boxes.size() - 1; i > 0; --i) std::swap(boxes[i], boxes[random.below(i + 1)]);
  const RefitResult result = refit(bvh, boxes);
  // Shuffled: every node spans nearly everything, so a ray meets nearly all nodes instead of a path's.
  EXPECT_GT(result.growth, 10);
  EXPECT_DOUBLE_EQ(result.growth, result.sahCost / bvh.stats.builtSahCost);
  EXPECT_LT(refit(bvh, boundsOf(before)).growth, 1.001) << "back in place";
}

TEST(Refit, RefusesAnotherNumberOfBoxesAndUnsoundOnes) {
  const auto boxes = boundsOf(testing::randomSoup(10, 0.1, 1));
  Bvh bvh = buildBvh(boxes);
  EXPECT_THROW(refit(bvh, std::span(boxes).first(9)), InternalError);
  auto bad = boxes;
  bad[4].upper.y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(refit(bvh, bad), InternalError);
}

}  // namespace
}  // namespace crosslight

// The tree's structure: everything in it once, boxes contain, depth bounded, the same whatever the number of threads.
#include "accel/bvh.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "meshes.h"

namespace crosslight {
namespace {

using testing::boundsOf;
using testing::Random;

Bounds childBox(const shared::BvhNode& node, int child) {
  Bounds b;
  b.lower = child == 0 ? node.lower0 : node.lower1;
  b.upper = child == 0 ? node.upper0 : node.upper1;
  return b;
}

bool contains(const Bounds& outer, const Bounds& inner) {
  for (int i = 0; i < 3; ++i) {
    if (!(outer.lower[i] <= inner.lower[i] && inner.upper[i] <= outer.upper[i])) return false;
  }
  return true;
}

bool same(const Bounds& a, const Bounds& b) { return contains(a, b) && contains(b, a); }

struct Audit {
  std::vector<int> seen;       // how often each primitive lies in a leaf
  std::vector<int> nodeSeen;   // how often each node is reached
  std::uint32_t maxDepth = 0;  // inner nodes on the longest path
};

// Walks the subtree and returns the union of its primitives' boxes; every stored box must be exactly that.
Bounds audit(const Bvh& bvh, const std::vector<Bounds>& primitives, const BvhOptions& options, std::uint32_t nodeIndex,
             std::uint32_t depth, Audit& result) {
  const shared::BvhNode& node = bvh.nodes.at(nodeIndex);
  ++result.nodeSeen.at(nodeIndex);
  result.maxDepth = std::max(result.maxDepth, depth);
  EXPECT_LT(node.splitAxis, 3u);
  Bounds all;
  for (int c = 0; c < 2; ++c) {
    const std::uint32_t child = c == 0 ? node.child0 : node.child1;
    Bounds inside;
    if (bvhIsLeaf(child)) {
      EXPECT_LE(bvhLeafCount(child), options.maxLeafSize);
      for (std::uint32_t i = 0; i < bvhLeafCount(child); ++i) {
        const std::uint32_t primitive = bvh.order.at(bvhLeafFirst(child) + i);
        ++result.seen.at(primitive);
        inside.add(primitives[primitive]);
      }
    } else {
      EXPECT_EQ(bvh.nodes.at(child).parent, nodeIndex);
      EXPECT_GT(child, nodeIndex) << "nodes are in depth-first order";
      inside = audit(bvh, primitives, options, child, depth + 1, result);
    }
    if (primitives.size() > 1) {
      EXPECT_FALSE(inside.empty()) << "an empty child below node " << nodeIndex;
    }
    const bool exact = inside.empty() ? childBox(node, c).empty() : same(childBox(node, c), inside);
    EXPECT_TRUE(exact) << "box of child " << c << " of node " << nodeIndex << " is not that of its primitives";
    all.add(inside);
  }
  return all;
}

Audit expectSound(const Bvh& bvh, const std::vector<Bounds>& primitives, const BvhOptions& options = {}) {
  Audit result;
  result.seen.assign(primitives.size(), 0);
  result.nodeSeen.assign(bvh.nodes.size(), 0);
  const Bounds all = audit(bvh, primitives, options, 0, 1, result);
  EXPECT_EQ(std::count(result.seen.begin(), result.seen.end(), 1), static_cast<std::ptrdiff_t>(primitives.size()));
  EXPECT_EQ(std::count(result.nodeSeen.begin(), result.nodeSeen.end(), 1),
            static_cast<std::ptrdiff_t>(bvh.nodes.size()));
  EXPECT_EQ(result.maxDepth, bvh.stats.maxDepth);
  EXPECT_LT(result.maxDepth, shared::kBvhStackSize);
  EXPECT_EQ(bvh.nodes.front().parent, shared::kNoId);
  EXPECT_EQ(bvh.stats.nodeCount, bvh.nodes.size());
  EXPECT_TRUE(primitives.empty() ? bvh.bounds.empty() : same(all, bvh.bounds));
  return result;
}

constexpr BvhQuality kQualities[] = {BvhQuality::fast, BvhQuality::medium, BvhQuality::high};

Bounds boxAt(const glm::vec3& center, float half) {
  Bounds b;
  b.add(center - glm::vec3(half));
  b.add(center + glm::vec3(half));
  return b;
}

TEST(Bvh, HoldsEveryPrimitiveOnceInBoxesThatFit) {
  for (const std::size_t count : {2u, 3u, 4u, 5u, 8u, 33u, 1000u, 20000u}) {
    const auto bounds = boundsOf(testing::randomSoup(count, 0.05, count));
    for (const std::uint32_t leaf : {1u, 4u, 15u}) {
      for (const BvhQuality quality : kQualities) {
        const BvhOptions options{.maxLeafSize = leaf, .quality = quality, .nodeCost = leaf == 15 ? 3.0f : 1.0f};
        expectSound(buildBvh(bounds, options), bounds, options);
      }
    }
  }
}

TEST(Bvh, OfNothingHasTwoEmptyChildren) {
  const Bvh bvh = buildBvh({});
  ASSERT_EQ(bvh.nodes.size(), 1u);
  EXPECT_TRUE(bvh.order.empty());
  EXPECT_TRUE(bvh.bounds.empty());
  expectSound(bvh, {});
}

TEST(Bvh, OfOnePrimitiveHasASecondChildThatIsEmpty) {
  const std::vector<Bounds> one{boxAt(glm::vec3(1, 2, 3), 0.5f)};
  const Bvh bvh = buildBvh(one);
  ASSERT_EQ(bvh.nodes.size(), 1u);
  EXPECT_EQ(bvhLeafCount(bvh.nodes[0].child0), 1u);
  EXPECT_EQ(bvhLeafCount(bvh.nodes[0].child1), 0u);
  EXPECT_TRUE(bvhIsLeaf(bvh.nodes[0].child1));
  EXPECT_TRUE(childBox(bvh.nodes[0], 1).empty());
  expectSound(bvh, one);
}

TEST(Bvh, SeparatesTwoPrimitivesAlongTheAxisThatPartsThem) {
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 offset(0);
    offset[axis] = 5;
    const std::vector<Bounds> two{boxAt(offset, 1), boxAt(-offset, 1)};
    const Bvh bvh = buildBvh(two);
    ASSERT_EQ(bvh.nodes.size(), 1u);
    EXPECT_EQ(bvh.nodes[0].splitAxis, static_cast<std::uint32_t>(axis));
    EXPECT_TRUE(same(childBox(bvh.nodes[0], 0), two[1])) << "child0 lies on the lower side";
  }
}

TEST(Bvh, SurvivesCentersThatNoPlaneSeparates) {
  for (const std::size_t count : {2u, 5u, 16u, 1000u}) {
    std::vector<Bounds> nested, equal, points;
    for (std::size_t i = 0; i < count; ++i) {
      nested.push_back(boxAt(glm::vec3(0), 1.0f + static_cast<float>(i)));
      equal.push_back(boxAt(glm::vec3(3, -1, 2), 0.25f));
      points.push_back(boxAt(glm::vec3(7), 0));
    }
    for (const auto& bounds : {nested, equal, points}) {
      for (const BvhQuality quality : kQualities) {
        const Audit result = expectSound(buildBvh(bounds, {.quality = quality}), bounds);
        // Halving from `count` to leaves of at most 4 takes ceil(log2(count)) levels at most; the last four may be
        // parted one by one, which takes one more.
        EXPECT_LE(result.maxDepth, static_cast<std::uint32_t>(std::bit_width(count - 1)) + 1);
      }
    }
  }
}

TEST(Bvh, SurvivesCoordinatesAtTheEndsOfFloat) {
  Random random(5);
  for (const float scale : {1e-44f, 1e-38f, 1e-30f, 1e30f, 9.9e37f}) {
    std::vector<Bounds> bounds;
    for (int i = 0; i < 500; ++i) {
      Bounds b;
      b.add(random.inBox(1) * scale);
      b.add(random.inBox(1) * scale);
      bounds.push_back(b);
    }
    for (const BvhQuality quality : kQualities) {
      const Bvh bvh = buildBvh(bounds, {.quality = quality});
      expectSound(bvh, bounds);
      EXPECT_TRUE(std::isfinite(bvh.stats.sahCost)) << "scale " << scale;
    }
  }
}

// Centers in geometric progression on x, and for the smallest of them again on y and z: sixteen bins peel off four
// octaves per level, so that the heuristic alone would go about 190 levels deep.
TEST(Bvh, StaysWithinTheStackOnExponentiallySpacedCenters) {
  std::vector<Bounds> bounds;
  for (int axis = 0; axis < 3; ++axis) {
    for (int exponent = -126; exponent <= 126; ++exponent) {
      for (int copy = 0; copy < 16; ++copy) {
        glm::vec3 p(0);
        p[axis] = std::ldexp(1.0f + static_cast<float>(copy) / 16, axis == 0 ? exponent : -126 + (exponent + 126) / 2);
        bounds.push_back(boxAt(p, 0));
      }
    }
  }
  for (const std::uint32_t leaf : {1u, 4u}) {
    const BvhOptions options{.maxLeafSize = leaf};
    expectSound(buildBvh(bounds, {.quality = BvhQuality::fast}), bounds);
    const Audit result = expectSound(buildBvh(bounds, options), bounds, options);
    EXPECT_GE(result.maxDepth, 50u) << "this input is meant to press against the bound";
    EXPECT_LT(result.maxDepth, shared::kBvhStackSize);
  }
}

TEST(Bvh, IsTheSameToTheLastBitWhateverTheNumberOfThreads) {
  const auto bounds = boundsOf(testing::randomSoup(150000, 0.02, 11));
  for (const BvhQuality quality : {BvhQuality::fast, BvhQuality::medium}) {
    const Bvh one = buildBvh(bounds, {.threads = 1, .quality = quality});
    for (const std::uint32_t threads : {0u, 2u, 3u, 8u}) {
      const Bvh other = buildBvh(bounds, {.threads = threads, .quality = quality});
      ASSERT_EQ(one.nodes.size(), other.nodes.size());
      EXPECT_EQ(0, std::memcmp(one.nodes.data(), other.nodes.data(), one.nodes.size() * sizeof(shared::BvhNode)));
      EXPECT_EQ(one.order, other.order);
      EXPECT_EQ(one.stats.sahCost, other.stats.sahCost);
    }
  }
}

TEST(Bvh, OfAMillionPrimitivesIsSound) {
  const auto bounds = boundsOf(testing::randomSoup(1000000, 0.003, 13));
  expectSound(buildBvh(bounds), bounds);
}

// Two unit cubes at distance: root 1, and for each child its chance (area over the root's area) times one test.
TEST(Bvh, ReportsTheSurfaceAreaCost) {
  const std::vector<Bounds> two{boxAt(glm::vec3(0, 0, 0), 0.5f), boxAt(glm::vec3(3, 0, 0), 0.5f)};
  const Bvh bvh = buildBvh(two);
  EXPECT_DOUBLE_EQ(bvh.stats.sahCost, 1 + 2 * 6.0 / 18.0);
  EXPECT_EQ(bvh.stats.leafCount, 2u);
}

TEST(Bvh, ReportsItsMemory) {
  const auto bounds = boundsOf(testing::randomSoup(20000, 0.01, 2));
  const Bvh bvh = buildBvh(bounds);
  EXPECT_EQ(bvh.stats.primitives, 20000u);
  EXPECT_EQ(bvh.stats.sizeBytes, bvh.nodes.size() * 64 + bvh.order.size() * 4);
  EXPECT_DOUBLE_EQ(bvh.stats.bytesPerPrimitive(), static_cast<double>(bvh.stats.sizeBytes) / 20000);
  EXPECT_LE(bvh.stats.bytesPerPrimitive(), 68.0) << "one node less than primitives, and the order";
  EXPECT_GE(bvh.stats.peakBytes, bvh.stats.sizeBytes);
  EXPECT_LE(bvh.stats.peakBytes, 20000u * (2 * 32 + 64 + 4)) << "two references and a node each, and the order";
}

TEST(Bvh, IsCheaperThanOneOfMediansOnUnevenInput) {
  // A dense cluster beside a sparse one: the first split must part the clusters, not halve the number.
  std::vector<Bounds> bounds;
  Random random(3);
  for (int i = 0; i < 900; ++i) bounds.push_back(boxAt(random.inBox(0.1), 0.01f));
  for (int i = 0; i < 100; ++i) bounds.push_back(boxAt(glm::vec3(10, 0, 0) + random.inBox(0.1), 0.01f));
  const Bvh bvh = buildBvh(bounds);
  EXPECT_LT(bvh.nodes[0].upper0.x, 1.0f);
  EXPECT_GT(bvh.nodes[0].lower1.x, 9.0f);
}

TEST(Bvh, RefusesBoxesThatAreEmptyOrNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  for (const glm::vec3& bad : {glm::vec3(nan, 0, 0), glm::vec3(0, inf, 0), glm::vec3(0, 0, 2)}) {
    Bounds b;
    b.lower = bad;
    b.upper = glm::vec3(1);
    EXPECT_THROW(buildBvh(std::vector<Bounds>{boxAt(glm::vec3(0), 1), b}), InternalError);
  }
  EXPECT_THROW(buildBvh({}, {.maxLeafSize = 16}), InternalError);
  EXPECT_THROW(buildBvh({}, {.maxLeafSize = 0}), InternalError);
}

}  // namespace
}  // namespace crosslight

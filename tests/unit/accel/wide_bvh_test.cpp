// The wide tree says what the binary one says.
#include "accel/wide_bvh.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/accel/meshes.h"

namespace crosslight {
namespace {

bool contains(const shared::WideChild& outer, const shared::WideChild& inner) {
  for (int i = 0; i < 3; ++i) {
    if (inner.lower[i] < outer.lower[i] || inner.upper[i] > outer.upper[i]) return false;
  }
  return true;
}

struct Walked {
  std::vector<std::uint32_t> slots;  // of the primitives, as often as they are met
  std::uint32_t depth = 0, nodes = 0;
  bool nested = true;
};

void walk(const WideBvh& wide, std::uint32_t node, std::uint32_t depth, const shared::WideChild* box, Walked& result) {
  ++result.nodes;
  result.depth = std::max(result.depth, depth);
  for (const shared::WideChild& c : wide.nodes[node]) {
    if (c.child == shared::kBvhLeaf) continue;
    if (box != nullptr) result.nested = result.nested && contains(*box, c);
    if (!bvhIsLeaf(c.child)) {
      walk(wide, c.child, depth + 1, &c, result);
      continue;
    }
    for (std::uint32_t i = 0; i < bvhLeafCount(c.child); ++i) result.slots.push_back(bvhLeafFirst(c.child) + i);
  }
}

std::vector<Bounds> boxesOf(const std::vector<oracle::Triangle>& triangles) {
  std::vector<Bounds> boxes;
  for (const oracle::Triangle& t : triangles) boxes.push_back(t.bounds());
  return boxes;
}

class Widened : public ::testing::TestWithParam<std::size_t> {};

TEST_P(Widened, everyPrimitiveIsMetOnceInBoxesThatNest) {
  std::vector<oracle::Triangle> triangles = testing::randomSoup(3000, 0.08, 7);
  triangles.resize(GetParam());
  const Bvh bvh = buildBvh(boxesOf(triangles));
  const WideBvh wide = widen(bvh);
  Walked walked;
  walk(wide, 0, 1, nullptr, walked);
  std::sort(walked.slots.begin(), walked.slots.end());
  ASSERT_EQ(walked.slots.size(), triangles.size());
  for (std::uint32_t i = 0; i < walked.slots.size(); ++i) EXPECT_EQ(walked.slots[i], i);
  EXPECT_TRUE(walked.nested);
  EXPECT_EQ(walked.depth, wide.maxDepth);
  EXPECT_EQ(walked.nodes, wide.nodes.size());
  EXPECT_LE(wide.maxDepth, bvh.stats.maxDepth);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Widened, ::testing::Values(0, 1, 2, 7, 9, 64, 3000));

TEST(WideTree, hasFewNodes) {
  const WideBvh wide = widen(buildBvh(boxesOf(testing::randomSoup(3000, 0.08, 7))));
  EXPECT_LT(wide.nodes.size(), 3000u / 3);  // a full node stands for seven of the binary tree
}

}  // namespace
}  // namespace crosslight

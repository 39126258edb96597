// The wide tree says what the binary one says.
#include "accel/wide_bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

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

// Plane of a byte as the shaders compute it.
float plane(const shared::QuadNode& node, int axis, std::uint32_t word, int child) {
  const float scale = std::bit_cast<float>(((node.exponents >> (8 * axis)) & 255u) << 23);
  return node.origin[axis] + scale * static_cast<float>((word >> (8 * child)) & 255u);
}

struct QuadWalk {
  std::vector<std::uint32_t> slots;
  std::uint32_t mostWaiting = 0;
  bool boxesHold = true;
};

// Bounds of the exact boxes of all primitives below.
Bounds walkQuads(const QuadBvh& quad, const Bvh& bvh, const std::vector<Bounds>& boxes, std::uint32_t at,
                 std::uint32_t waiting, QuadWalk& result) {
  const shared::QuadNode& node = quad.nodes[at];
  const std::uint32_t children[] = {node.child0, node.child1, node.child2, node.child3};
  const std::uint32_t lowers[] = {node.lowerX, node.lowerY, node.lowerZ};
  const std::uint32_t uppers[] = {node.upperX, node.upperY, node.upperZ};
  std::uint32_t there = 0;
  for (const std::uint32_t child : children) there += child != shared::kBvhLeaf;
  if (there > 0) waiting += there - 1;
  result.mostWaiting = std::max(result.mostWaiting, waiting);
  Bounds all;
  for (int c = 0; c < 4; ++c) {
    if (children[c] == shared::kBvhLeaf) continue;
    Bounds exact;
    if (bvhIsLeaf(children[c])) {
      for (std::uint32_t i = 0; i < bvhLeafCount(children[c]); ++i) {
        const std::uint32_t slot = bvhLeafFirst(children[c]) + i;
        result.slots.push_back(slot);
        exact.add(boxes[bvh.order[slot]]);
      }
    } else {
      exact = walkQuads(quad, bvh, boxes, children[c], waiting, result);
    }
    for (int axis = 0; axis < 3; ++axis) {
      result.boxesHold = result.boxesHold && plane(node, axis, lowers[axis], c) <= exact.lower[axis] &&
                         plane(node, axis, uppers[axis], c) >= exact.upper[axis];
    }
    all.add(exact);
  }
  return all;
}

// From tiny to huge, near zero and far from it.
TEST_P(Widened, quantisedBoxesHoldWhatIsInThem) {
  for (const float scale : {1e-30f, 1.0f, 1e25f}) {
    for (const float shift : {0.0f, 1000.0f}) {
      std::vector<oracle::Triangle> triangles = testing::randomSoup(3000, 0.08, 11);
      triangles.resize(GetParam());
      std::vector<Bounds> boxes = boxesOf(triangles);
      for (Bounds& b : boxes) b = {scale * (b.lower + shift), scale * (b.upper + shift)};
      const Bvh bvh = buildBvh(boxes);
      const QuadBvh quad = quantize(bvh);
      QuadWalk walked;
      walkQuads(quad, bvh, boxes, 0, 0, walked);
      EXPECT_TRUE(walked.boxesHold) << scale << ' ' << shift;
      EXPECT_EQ(walked.mostWaiting, quad.mostWaiting);
      std::sort(walked.slots.begin(), walked.slots.end());
      ASSERT_EQ(walked.slots.size(), triangles.size());
      for (std::uint32_t i = 0; i < walked.slots.size(); ++i) EXPECT_EQ(walked.slots[i], i);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Widened, ::testing::Values(0, 1, 2, 7, 9, 64, 3000));

TEST(WideTree, hasFewNodes) {
  const WideBvh wide = widen(buildBvh(boxesOf(testing::randomSoup(3000, 0.08, 7))));
  EXPECT_LT(wide.nodes.size(), 3000u / 3);  // a full node stands for seven of the binary tree
}

}  // namespace
}  // namespace crosslight

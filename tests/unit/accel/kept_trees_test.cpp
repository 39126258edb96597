// A kept tree is moved where triangles move, left alone where they do not, and built anew where moving would hurt.
#include "accel/kept_trees.h"

#include <gtest/gtest.h>

#include <cstring>

#include "accel/refit.h"
#include "meshes.h"

namespace crosslight {
namespace {

struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;

  explicit Mesh(const std::vector<oracle::Triangle>& triangles) {
    for (const oracle::Triangle& t : triangles) {
      for (const glm::vec3& corner : {t.v0, t.v1, t.v2}) {
        indices.push_back(static_cast<std::uint32_t>(positions.size()));
        positions.push_back(corner);
      }
    }
  }
  operator BvhTriangles() const { return {positions, indices}; }
};

void expectCounts(KeptTrees& trees, std::uint32_t built, std::uint32_t moved, std::uint32_t unchanged) {
  const KeptTrees::Counts counts = trees.takeCounts();
  EXPECT_EQ(counts.built, built);
  EXPECT_EQ(counts.moved, moved);
  EXPECT_EQ(counts.unchanged, unchanged);
}

bool sameBits(const Bvh& a, const Bvh& b) {
  return a.order == b.order && a.nodes.size() == b.nodes.size() &&
         std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(shared::BvhNode)) == 0;
}

TEST(KeptTrees, areLeftAloneWhereNothingMoves) {
  const Mesh mesh(testing::torusKnot(200, 40));
  KeptTrees trees;
  const Bvh first = trees.over(3, mesh);
  EXPECT_TRUE(sameBits(first, buildTriangleBvh(mesh)));
  EXPECT_TRUE(sameBits(first, trees.over(3, mesh)));
  expectCounts(trees, 1, 0, 1);
}

TEST(KeptTrees, moveWithTheirTriangles) {
  Mesh mesh(testing::torusKnot(200, 40));
  KeptTrees trees;
  Bvh expected = trees.over(-1, mesh);
  std::vector<Bounds> boxes;
  for (glm::vec3& p : mesh.positions) p = p + glm::vec3(0.3f, -2.0f * p.x * p.x, 1000.0f);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    boxes.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) boxes.back().add(mesh.positions[i + k]);
  }
  refit(expected, boxes);
  EXPECT_TRUE(sameBits(expected, trees.over(-1, mesh)));
  expectCounts(trees, 1, 1, 0);
}

// Triangles that change places make every box of the old tree large.
TEST(KeptTrees, areBuiltAnewWhereRaysWouldPayTooMuch) {
  Mesh mesh(testing::randomSoup(5000, 0.02, 1));
  KeptTrees trees;
  trees.over(0, mesh);
  testing::Random random(2);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    const std::size_t other = 3 * random.below(mesh.positions.size() / 3);
    for (std::size_t k = 0; k < 3; ++k) std::swap(mesh.positions[i + k], mesh.positions[other + k]);
  }
  EXPECT_TRUE(sameBits(trees.over(0, mesh), buildTriangleBvh(mesh)));
  expectCounts(trees, 2, 0, 0);
}

TEST(KeptTrees, areBuiltAnewForOtherTrianglesOfTheSameVertices) {
  Mesh mesh(testing::uvSphere(20, 30, glm::dvec3(0), 1));
  KeptTrees trees;
  trees.over(0, mesh);
  std::swap(mesh.indices[0], mesh.indices[300]);
  EXPECT_TRUE(sameBits(trees.over(0, mesh), buildTriangleBvh(mesh)));
  mesh.indices.resize(mesh.indices.size() - 3);
  EXPECT_TRUE(sameBits(trees.over(0, mesh), buildTriangleBvh(mesh)));
  expectCounts(trees, 3, 0, 0);
}

TEST(KeptTrees, ofOneFrameDoNotDisturbEachOther) {
  const Mesh a(testing::uvSphere(20, 30, glm::dvec3(0), 1)), b(testing::torusKnot(50, 20)), none({});
  KeptTrees trees;
  for (int frame = 0; frame < 2; ++frame) {
    EXPECT_TRUE(sameBits(trees.over(0, a), buildTriangleBvh(a)));
    EXPECT_TRUE(sameBits(trees.over(1, b), buildTriangleBvh(b)));
    EXPECT_TRUE(sameBits(trees.over(2, none), buildTriangleBvh(none)));
  }
  expectCounts(trees, 3, 0, 3);
}

}  // namespace
}  // namespace crosslight

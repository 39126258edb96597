// Bounding volume hierarchy over triangles and bounded shapes, built on the host: surface-area heuristic, two children
// per node. The node layout is the device's own (shaders/shared/structs.h). See refit.h for moved primitives and
// bvh_cache.h for trees kept on disk.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "structs.h"

namespace crosslight {

struct Bounds {
  glm::vec3 lower{1e38f};
  glm::vec3 upper{-1e38f};

  void add(const glm::vec3& p);
  void add(const Bounds& other);
  bool empty() const { return !(lower.x <= upper.x); }
};

// Triangle i has the corners positions[indices[3 i]], [3 i + 1] and [3 i + 2].
struct BvhTriangles {
  std::span<const glm::vec3> positions;
  std::span<const std::uint32_t> indices;

  std::size_t count() const { return indices.size() / 3; }
};

enum class BvhQuality {
  fast,    // Morton order: the quickest build, rays pay for it
  medium,  // binned surface-area heuristic
  high,    // and spatial splits, where triangles are given; of boxes alone the same as medium
};

struct BvhOptions {
  std::uint32_t maxLeafSize = 4;  // at most 15
  std::uint32_t binCount = 16;    // at most 32, more count as 32
  std::uint32_t threads = 0;      // 0: as many as the machine has. The tree does not depend on it.
  BvhQuality quality = BvhQuality::medium;
  float nodeCost = 1;            // of testing a node's two boxes, in triangle tests: more makes leaves larger
  float mostDuplicates = 0.25f;  // of high: references beyond one per triangle, as a share of the triangles
};

struct BvhStats {
  std::uint32_t nodeCount = 0;
  std::uint32_t leafCount = 0;
  std::uint32_t maxDepth = 0;    // inner nodes on the longest path; below kBvhStackSize always
  std::uint32_t primitives = 0;  // that were given; `order` is longer where spatial splits doubled some
  double sahCost = 0;            // expected cost of a ray: 1 per node visited, 1 per primitive tested
  double builtSahCost = 0;       // as built: refit() changes sahCost only
  double buildMs = 0;
  std::uint64_t sizeBytes = 0;  // nodes and order
  std::uint64_t peakBytes = 0;  // allocated at the worst moment of building, the result included, the input not

  double bytesPerPrimitive() const { return primitives == 0 ? 0.0 : static_cast<double>(sizeBytes) / primitives; }
};

// `nodes[0]` is the root; nodes are in depth-first order. With 0 primitives there is one node with two empty boxes;
// with 1, its second child is empty. An empty child has lower > upper and a leaf of count 0. `order` lists primitive
// indices in leaf order.
struct Bvh {
  std::vector<shared::BvhNode> nodes;
  std::vector<std::uint32_t> order;
  Bounds bounds;
  BvhStats stats;
};

// Deterministic: the same bounds give the same tree, whatever the number of threads. Boxes must be finite and not
// empty (checked). The tree's boxes contain the given boxes exactly (no widening: the ray test widens); a zero is
// positive in them.
Bvh buildBvh(std::span<const Bounds> primitives, const BvhOptions& options = {});

// The same tree as from the triangles' boxes, without making them first. Quality high cuts triangles: a leaf's box then
// contains the part of its triangles that its path leads to, and `order` may name a triangle more than once.
Bvh buildTriangleBvh(const BvhTriangles& triangles, const BvhOptions& options = {});

// Child reference of an inner node, taken apart.
inline bool bvhIsLeaf(std::uint32_t child) { return (child & shared::kBvhLeaf) != 0; }
inline std::uint32_t bvhLeafCount(std::uint32_t child) { return (child >> shared::kBvhCountShift) & 15u; }
inline std::uint32_t bvhLeafFirst(std::uint32_t child) { return child & shared::kBvhFirstMask; }

}  // namespace crosslight

// The trees over a flattened scene as the shaders read them.
#pragma once

#include <optional>
#include <vector>

#include "accel/cached_trees.h"
#include "accel/kept_trees.h"
#include "accel/wide_bvh.h"
#include "gpu/box_search.h"
#include "upload/flatten.h"

namespace crosslight {

// One tree over the triangles and one over the bounded shapes, one behind the other, with the primitives in leaf order
// as the shaders read them. Or trees that instances share (shared_trees.h): the first one is over instances then.
struct FlatBvh {
  std::vector<shared::BvhNode> nodes;  // the triangles' root is 0
  std::uint32_t shapeRoot = 0;
  std::vector<shared::BvhPrimitive> primitives;
  std::vector<WideNode> wideNodes;  // if asked for: the triangles' tree, eight children per node
  std::uint32_t wideDepth = 0;
  std::vector<shared::QuadNode> quadNodes;  // if asked for: the same, four children per node
  std::uint32_t quadWaiting = 0;
  std::vector<shared::InstanceRecord> instances;  // empty: one tree over all triangles
  std::vector<shared::InstanceTriangle> instanceTriangles;
  std::optional<std::vector<gpu::SearchBox>> deviceBoxes;  // instead of trees over triangles: one per primitive

  std::uint64_t sizeBytes() const;  // but for deviceBoxes, which go when the device has its structure
};
// Appends trees behind those before them; their references move along. `firstPrimitive` is added to what leaves name.
void appendNodes(const std::vector<shared::BvhNode>& tree, std::uint32_t firstPrimitive,
                 std::vector<shared::BvhNode>& nodes);
// Appends the tree over the bounded shapes, and its primitives.
void appendShapes(const FlatScene& flat, const Scene& scene, const RenderSettings& settings, FlatBvh& all);
// What the walk asks of a draw's triangles: kPrimitive*.
std::uint32_t primitiveFlags(const FlatScene& flat, const Scene& scene, const RenderSettings& settings,
                             std::uint32_t drawId);
// Key among kept trees of that in render space; those of meshes have their numbers.
inline constexpr int kRenderSpaceTree = -1;

// Trees beside the binary one over the triangles that kernels walk.
struct MoreTrees {
  bool wide = true;
  bool quad = true;
  bool byDevice = false;  // none of them: the device searches boxes by a structure of its own (query_boxes.h)
};
// Where trees come from besides being built: the frame before, else the disk. Either may be null.
struct TreeSources {
  KeptTrees* kept = nullptr;
  CachedTrees* cached = nullptr;

  // Valid as long as the result, and of `kept` until the next call with this key.
  std::shared_ptr<const Bvh> over(int key, const BvhTriangles& triangles) const;
};

FlatBvh buildFlatBvh(const FlatScene& flat, const Scene& scene, const RenderSettings& settings, MoreTrees more = {},
                     const TreeSources& sources = {});

}  // namespace crosslight

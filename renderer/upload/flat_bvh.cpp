// The trees over a flattened scene, in one list of nodes.
#include "upload/flat_bvh.h"

#include <algorithm>
#include <future>
#include <numeric>

#include "effects/material_traits.h"
#include "upload/query_boxes.h"

namespace crosslight {
namespace {

std::vector<std::uint32_t> drawOfTriangle(const FlatScene& flat) {
  std::vector<std::uint32_t> drawOf(flat.triangleCount());
  for (std::uint32_t d = 0; d < flat.meshDrawCount; ++d) {
    std::fill_n(drawOf.begin() + flat.draws[d].firstTriangle, flat.draws[d].triangleCount, d);
  }
  return drawOf;
}

void fillPrimitives(const FlatScene& flat, const Scene& scene, const RenderSettings& settings,
                    const std::vector<std::uint32_t>& order, std::vector<shared::BvhPrimitive>& primitives) {
  const std::vector<std::uint32_t> drawOf = drawOfTriangle(flat);
  std::vector<std::uint32_t> flags;
  for (std::uint32_t d = 0; d < flat.meshDrawCount; ++d) flags.push_back(primitiveFlags(flat, scene, settings, d));
  primitives.reserve(order.size() + flat.shapeBounds.size());
  for (const std::uint32_t t : order) {
    const auto corner = [&](std::uint32_t k) { return flat.positions[flat.indices[3 * t + k]]; };
    primitives.push_back({corner(0), t, corner(1), drawOf[t], corner(2), flags[drawOf[t]]});
  }
}

template <class T>
std::uint64_t bytesOf(const std::vector<T>& list) {
  return list.size() * sizeof(T);
}

}  // namespace

std::shared_ptr<const Bvh> TreeSources::over(int key, const BvhTriangles& triangles) const {
  if (kept != nullptr) return {std::shared_ptr<void>(), &kept->over(key, triangles)};
  if (cached != nullptr) return cached->over(triangles);
  return std::make_shared<const Bvh>(buildTriangleBvh(triangles));
}

std::uint64_t FlatBvh::sizeBytes() const {
  return bytesOf(nodes) + bytesOf(primitives) + bytesOf(wideNodes) + bytesOf(quadNodes) + bytesOf(instances) +
         bytesOf(instanceTriangles);
}

std::uint32_t primitiveFlags(const FlatScene& flat, const Scene& scene, const RenderSettings& settings,
                             std::uint32_t drawId) {
  const shared::DrawRecord& draw = flat.draws[drawId];
  const Material& m = scene.materials[draw.materialId];
  std::uint32_t flags = surfaceFlags(m);
  if (settings.twoSided == TwoSided::always) flags &= ~shared::kPrimitiveCutsBackFaces;
  if (draw.flags & shared::kDrawFlipsWinding) flags |= shared::kPrimitiveFlipsWinding;
  return flags;
}

void appendNodes(const std::vector<shared::BvhNode>& tree, std::uint32_t firstPrimitive,
                 std::vector<shared::BvhNode>& nodes) {
  const auto firstNode = static_cast<std::uint32_t>(nodes.size());
  nodes.reserve(nodes.size() + tree.size());
  const auto moved = [&](std::uint32_t child) {
    if (!bvhIsLeaf(child)) return child + firstNode;
    return bvhLeafCount(child) == 0 ? child : child + firstPrimitive;
  };
  for (shared::BvhNode node : tree) {
    node.child0 = moved(node.child0);
    node.child1 = moved(node.child1);
    if (node.parent != shared::kNoId) node.parent += firstNode;
    nodes.push_back(node);
  }
}

void appendShapes(const FlatScene& flat, const Scene& scene, const RenderSettings& settings, FlatBvh& all) {
  const Bvh shapes = buildBvh(flat.shapeBounds);
  all.shapeRoot = static_cast<std::uint32_t>(all.nodes.size());
  appendNodes(shapes.nodes, static_cast<std::uint32_t>(all.primitives.size()), all.nodes);
  for (const std::uint32_t s : shapes.order) {
    const std::uint32_t shape = flat.unboundedShapeCount + s;
    shared::BvhPrimitive p{};
    p.id = shared::kPrimitiveIsShape | shape;
    p.drawId = flat.shapes[shape].drawId;
    p.flags = primitiveFlags(flat, scene, settings, p.drawId);
    all.primitives.push_back(p);
  }
}

namespace {

// Primitives in the order of the flattened triangles: a box's number is its triangle's.
FlatBvh boxesForDevice(const FlatScene& flat, const Scene& scene, const RenderSettings& settings) {
  FlatBvh result;
  std::vector<std::uint32_t> order(flat.triangleCount());
  std::iota(order.begin(), order.end(), 0u);
  fillPrimitives(flat, scene, settings, order, result.primitives);
  result.deviceBoxes = queryBoxes(flat);
  appendShapes(flat, scene, settings, result);
  return result;
}

}  // namespace

FlatBvh buildFlatBvh(const FlatScene& flat, const Scene& scene, const RenderSettings& settings, MoreTrees more,
                     const TreeSources& sources) {
  if (more.byDevice) return boxesForDevice(flat, scene, settings);
  FlatBvh result;
  const bool mine = sources.kept == nullptr && sources.cached == nullptr;
  Bvh own;
  std::shared_ptr<const Bvh> other;
  if (mine)
    own = buildTriangleBvh({flat.positions, flat.indices});
  else
    other = sources.over(kRenderSpaceTree, {flat.positions, flat.indices});
  const Bvh& triangles = mine ? own : *other;
  std::future<WideBvh> widening;
  std::future<QuadBvh> quantizing;
  if (more.quad) quantizing = std::async(std::launch::async, quantize, std::cref(triangles));
  if (more.wide) widening = std::async(std::launch::async, widen, std::cref(triangles));
  fillPrimitives(flat, scene, settings, triangles.order, result.primitives);
  if (more.quad) {
    QuadBvh four = quantizing.get();
    result.quadNodes = std::move(four.nodes);
    result.quadWaiting = four.mostWaiting;
  }
  if (more.wide) {
    WideBvh eight = widening.get();
    result.wideNodes = std::move(eight.nodes);
    result.wideDepth = eight.maxDepth;
  }
  // The first tree's references need not move. Its nodes do not fit twice where it is large.
  result.nodes = mine ? std::move(own.nodes) : triangles.nodes;
  appendShapes(flat, scene, settings, result);
  return result;
}

}  // namespace crosslight

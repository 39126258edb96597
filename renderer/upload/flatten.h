// The scene in render space as flat lists: what raster and rays both read, so that they see the same floats. Vertices
// are moved there in double and rounded once.
#pragma once

#include <vector>

#include "accel/wide_bvh.h"
#include "scene/scene.h"
#include "scene/settings.h"
#include "structs.h"

namespace crosslight {

struct FlatScene {
  std::vector<glm::vec3> positions;
  std::vector<shared::VertexAttributes> attributes;  // as long as positions
  std::vector<std::uint32_t> indices;
  std::vector<shared::DrawRecord> draws;  // those with triangles first, in scene order, then one per shape
  std::uint32_t meshDrawCount = 0;
  std::vector<shared::ShapeRecord> shapes;  // unbounded ones first
  std::vector<Bounds> shapeBounds;          // of the bounded ones, render space
  std::uint32_t unboundedShapeCount = 0;
  Bounds bounds;

  std::uint32_t triangleCount() const { return static_cast<std::uint32_t>(indices.size() / 3); }
};

// `analyticShapes`: keep shapes as such and leave out the meshes that they replace (rays); else draw meshes,
// tessellating shapes that have none (raster). `origin` is the world position that becomes zero. DeviceError beyond
// 2^31 indices.
FlatScene flattenScene(const Scene& scene, const glm::dvec3& origin, bool analyticShapes);

// One tree over the triangles and one over the bounded shapes, one behind the other, with the primitives in leaf order
// as the shaders read them.
struct FlatBvh {
  std::vector<shared::BvhNode> nodes;  // the triangles' root is 0
  std::uint32_t shapeRoot = 0;
  std::vector<shared::BvhPrimitive> primitives;
  std::vector<WideNode> wideNodes;  // if asked for: the triangles' tree, eight children per node
  std::uint32_t wideDepth = 0;
  std::vector<shared::QuadNode> quadNodes;  // if asked for: the same, four children per node
  std::uint32_t quadWaiting = 0;
};
// Trees beside the binary one that kernels walk.
struct MoreTrees {
  bool wide = true;
  bool quad = true;
};
FlatBvh buildFlatBvh(const FlatScene& flat, const Scene& scene, const RenderSettings& settings, MoreTrees more = {});

}  // namespace crosslight

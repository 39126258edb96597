// The scene in render space as flat lists: what raster and rays both read, so that they see the same floats. Vertices
// are moved there in double and rounded once.
#pragma once

#include <vector>

#include "accel/bvh.h"
#include "scene/scene.h"
#include "scene/settings.h"
#include "structs.h"

namespace crosslight {

// Where a mesh instance lies in the lists.
struct FlatInstance {
  std::uint32_t instance = 0;  // index into Scene::instances
  std::uint32_t firstVertex = 0, vertexCount = 0;
  std::uint32_t firstTriangle = 0, triangleCount = 0;
  std::uint32_t firstDraw = 0;
};

struct FlatScene {
  std::vector<glm::vec3> positions;
  std::vector<shared::VertexAttributes> attributes;  // as long as positions
  std::vector<std::uint32_t> indices;
  std::vector<shared::DrawRecord> draws;  // those with triangles first, in scene order, then one per shape
  std::uint32_t meshDrawCount = 0;
  std::vector<FlatInstance> instances;      // of meshes, those with triangles, in scene order
  std::vector<shared::ShapeRecord> shapes;  // unbounded ones first
  std::vector<Bounds> shapeBounds;          // of the bounded ones, render space
  std::uint32_t unboundedShapeCount = 0;
  Bounds bounds;
  glm::dvec3 origin{0.0};  // world position that became zero

  std::uint32_t triangleCount() const { return static_cast<std::uint32_t>(indices.size() / 3); }
};

// What a material makes of its surfaces: bits of kPrimitive*.
std::uint32_t surfaceFlags(const Material& material);

// `analyticShapes`: keep shapes as such and leave out the meshes that they replace (rays); else draw meshes,
// tessellating shapes that have none (raster). `origin` is the world position that becomes zero. DeviceError beyond
// 2^31 indices. Without `meshes` nothing is drawn that has triangles.
FlatScene flattenScene(const Scene& scene, const glm::dvec3& origin, bool analyticShapes, bool meshes = true);

}  // namespace crosslight

#include "upload/flatten.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <future>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>

#include "base/check.h"
#include "base/error.h"
#include "effects/material_traits.h"
#include "scene/shape_mesh.h"
#include "upload/instance_record.h"

namespace crosslight {
namespace {

// Raster draws an unbounded plane as a square; this many times the scene's extent is beyond any sensible view of it.
constexpr double kPlaneExtents = 50.0;
constexpr int kShapeSegments = 64;

// A node's transform, taken apart for points, directions and normals; all in double.
struct Placement {
  glm::dmat3 linear;
  glm::dmat3 normals;  // cofactors times the determinant's sign: outward stays outward
  glm::dvec3 shift;    // of the object's origin, relative to the render origin
  bool mirrors;

  Placement(const glm::dmat4& worldFromObject, const glm::dvec3& origin)
      : linear(worldFromObject), shift(glm::dvec3(worldFromObject[3]) - origin) {
    double largest = 0;
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) largest = std::max(largest, std::abs(linear[c][r]));
    }
    // Scaled first: the determinant of a node scaled by 1e-15 must not vanish (NUMERICS M3).
    const glm::dmat3 m = largest > 0 ? linear / largest : linear;
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    mirrors = glm::dot(m[0], cofactors[0]) < 0;
    normals = mirrors ? -cofactors : cofactors;
  }

  glm::vec3 point(const glm::dvec3& p) const { return glm::vec3(linear * p + shift); }
};

glm::vec3 unitOrZero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 && std::isfinite(length) ? glm::vec3(v / length) : glm::vec3(0.0f);
}

class Flattener {
 public:
  Flattener(const Scene& scene, const glm::dvec3& origin, bool analyticShapes, bool meshes)
      : scene_(scene), origin_(origin), analyticShapes_(analyticShapes), meshes_(meshes) {}

  FlatScene run() {
    flat_.origin = origin_;
    for (const MeshInstance& instance : scene_.instances) {
      if (!meshes_ || (analyticShapes_ && instance.replacedByShape)) continue;
      addInstance(instance);
    }
    if (meshes_ && !analyticShapes_) addShapeMeshes();
    flat_.meshDrawCount = static_cast<std::uint32_t>(flat_.draws.size());
    if (analyticShapes_) addShapes();
    for (const glm::vec3& p : flat_.positions) flat_.bounds.add(p);
    return std::move(flat_);
  }

 private:
  void addInstance(const MeshInstance& instance) {
    const Placement place(instance.worldFromObject, origin_);
    FlatInstance flat{.instance = static_cast<std::uint32_t>(&instance - scene_.instances.data()),
                      .firstVertex = static_cast<std::uint32_t>(flat_.positions.size()),
                      .firstTriangle = flat_.triangleCount(),
                      .firstDraw = static_cast<std::uint32_t>(flat_.draws.size())};
    std::uint32_t primitiveBase = 0;
    for (const Primitive& p : scene_.meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
      addPrimitive(p, p.material, place, instance.instanceId, primitiveBase);
      primitiveBase += static_cast<std::uint32_t>(p.indices.size() / 3);
    }
    flat.vertexCount = static_cast<std::uint32_t>(flat_.positions.size()) - flat.firstVertex;
    flat.triangleCount = flat_.triangleCount() - flat.firstTriangle;
    if (flat.triangleCount > 0) flat_.instances.push_back(flat);
  }

  void addPrimitive(const Primitive& p, int material, const Placement& place, std::uint32_t instanceId,
                    std::uint32_t primitiveBase) {
    const std::size_t firstVertex = flat_.positions.size();
    const std::size_t limit = std::numeric_limits<std::int32_t>::max();
    if (flat_.indices.size() + p.indices.size() > limit || firstVertex + p.positions.size() > limit) {
      throw DeviceError(fmt::format("{}: {} indices are more than the 2^31 that one scene may have",
                                    scene_.source.string(), flat_.indices.size() + p.indices.size()));
    }
    shared::DrawRecord draw{};
    draw.firstTriangle = flat_.triangleCount();
    draw.triangleCount = static_cast<std::uint32_t>(p.indices.size() / 3);
    draw.materialId = static_cast<std::uint32_t>(material);
    draw.instanceId = instanceId;
    draw.primitiveBase = primitiveBase;
    draw.flags = (place.mirrors ? shared::kDrawFlipsWinding : 0u) | (p.colors.empty() ? 0u : shared::kDrawHasColors);
    if (draw.triangleCount == 0) return;
    flat_.draws.push_back(draw);
    for (std::size_t i = 0; i < p.positions.size(); ++i) {
      flat_.positions.push_back(place.point(glm::dvec3(p.positions[i])));
      flat_.attributes.push_back(attributesOf(p, i, place));
    }
    for (const std::uint32_t index : p.indices)
      flat_.indices.push_back(static_cast<std::uint32_t>(firstVertex) + index);
  }

  static shared::VertexAttributes attributesOf(const Primitive& p, std::size_t i, const Placement& place) {
    shared::VertexAttributes a{};
    a.renderNormal = i < p.normals.size() ? unitOrZero(place.normals * glm::dvec3(p.normals[i])) : glm::vec3(0.0f);
    if (i < p.tangents.size()) {
      const glm::vec3 t = unitOrZero(place.linear * glm::dvec3(p.tangents[i]));
      a.renderTangent = glm::vec4(t, place.mirrors ? -p.tangents[i].w : p.tangents[i].w);
    }
    if (i < p.uv0.size()) a.uv0 = p.uv0[i];
    if (i < p.uv1.size()) a.uv1 = p.uv1[i];
    a.color = i < p.colors.size() ? p.colors[i] : glm::vec4(1.0f);
    return a;
  }

  // Raster's stand-ins for shapes whose node has no mesh of its own.
  void addShapeMeshes() {
    std::vector<bool> hasMesh(scene_.instanceCount, false);
    for (const MeshInstance& instance : scene_.instances) {
      if (instance.replacedByShape) hasMesh[instance.instanceId] = true;
    }
    for (const ShapeInstance& shape : scene_.shapes) {
      if (hasMesh[shape.instanceId]) continue;
      const Placement place(shape.worldFromObject, origin_);
      const Primitive mesh = tessellateShape(shape.kind, shape.params, kShapeSegments, planeHalfSize(shape));
      addPrimitive(mesh, shape.material, place, shape.instanceId, 0);
    }
  }

  double planeHalfSize(const ShapeInstance& shape) const {
    const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(shape.worldFromObject))));
    double extent = glm::length(glm::dvec3(shape.worldFromObject[3]) - origin_);
    if (!scene_.worldBounds.empty()) extent += glm::length(scene_.worldBounds.upper - scene_.worldBounds.lower);
    return kPlaneExtents * std::max(extent, scale) / std::max(scale, std::numeric_limits<double>::min());
  }

  void addShapes() {
    for (const bool bounded : {false, true}) {
      for (const ShapeInstance& shape : scene_.shapes) {
        if (shapeBounds(shape.kind, shape.params).has_value() == bounded) addShape(shape, bounded);
      }
    }
  }

  void addShape(const ShapeInstance& shape, bool bounded) {
    const Placement place(shape.worldFromObject, origin_);
    const glm::dmat3 inverse = glm::inverse(place.linear);
    shared::ShapeRecord record{};
    record.kind = static_cast<std::uint32_t>(shape.kind);
    record.drawId = static_cast<std::uint32_t>(flat_.draws.size());
    record.renderCenter = glm::vec3(place.shift);
    record.renderFromObject = glm::mat3(place.linear);
    record.objectFromRender = glm::mat3(inverse);
    record.params = shape.params;
    record.flags = surfaceFlags(scene_.materials[static_cast<std::size_t>(shape.material)]);
    flat_.shapes.push_back(record);
    flat_.draws.push_back({flat_.triangleCount(), 0u, static_cast<std::uint32_t>(shape.material), shape.instanceId, 0u,
                           place.mirrors ? shared::kDrawFlipsWinding : 0u, 0u, 0u});
    if (!bounded) {
      CL_CHECK(shape.kind == ShapeKind::plane);  // what shaders/accel/bvh.glsl relies on
      ++flat_.unboundedShapeCount;
      return;
    }
    flat_.shapeBounds.push_back(boundsOf(*shapeBounds(shape.kind, shape.params), place));
    flat_.bounds.add(flat_.shapeBounds.back());
  }

  // Box of the transformed box, a hair larger than rounding can move a hit point.
  static Bounds boundsOf(const DBounds& box, const Placement& place) {
    const DBounds moved = crosslight::moved(box, place.linear, place.shift);
    Bounds result;
    for (int i = 0; i < 3; ++i) {
      // gamma_8 of the largest coordinate: the shaders' point on a shape is off by gamma_6 at most.
      const double margin =
          8.0 * 6e-8 * std::max({std::abs(moved.lower[i]), std::abs(moved.upper[i]), std::abs(place.shift[i])});
      result.lower[i] = std::nextafter(static_cast<float>(moved.lower[i] - margin), -std::numeric_limits<float>::max());
      result.upper[i] = std::nextafter(static_cast<float>(moved.upper[i] + margin), std::numeric_limits<float>::max());
    }
    return result;
  }

  const Scene& scene_;
  glm::dvec3 origin_;
  bool analyticShapes_;
  bool meshes_;
  FlatScene flat_;
};

}  // namespace

std::uint32_t surfaceFlags(const Material& m) {
  const bool mayPass = m.alphaMode == AlphaMode::mask || isTransparent(m);
  return (m.doubleSided ? 0u : shared::kPrimitiveCutsBackFaces) | (mayPass ? shared::kPrimitiveMayPass : 0u);
}

FlatScene flattenScene(const Scene& scene, const glm::dvec3& origin, bool analyticShapes, bool meshes) {
  return Flattener(scene, origin, analyticShapes, meshes).run();
}

}  // namespace crosslight

// Oracles: the naive twins of the shaders' ray tests, in double and long double on the inputs' exact values. Tests
// compare against them, so they are never optimised; nothing that makes an image calls them.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "accel/bvh.h"
#include "lists.h"

namespace crosslight::oracle {

// Points origin + t direction with tMin <= t <= tMax. The direction has any length but 0; t counts in its lengths.
struct Ray {
  glm::dvec3 origin{0};
  glm::dvec3 direction{0};
  double tMin = 0;
  double tMax = std::numeric_limits<double>::infinity();
};

struct Triangle {
  glm::vec3 v0, v1, v2;

  Bounds bounds() const;
};

// The point is (1 - u - v) v0 + u v1 + v v2.
template <class Real>
struct TriangleHit {
  Real t = 0, u = 0, v = 0;
  std::uint32_t id = shared::kNoId;
};

// Both sides count, edges and corners included; a closed mesh has no gaps, at its corners neither. A ray within the
// triangle's plane misses.
template <class Real>
std::optional<TriangleHit<Real>> intersectTriangle(const Triangle& triangle, const Ray& ray);

// Every triangle is tested. Of equally near hits the one with the lowest index counts.
template <class Real>
std::optional<TriangleHit<Real>> closestHitNaive(std::span<const Triangle> triangles, const Ray& ray);

// The same answer through the tree, to test the tree; triangle `i` is the primitive `i` that the tree was built over.
std::optional<TriangleHit<double>> closestHit(const Bvh& bvh, std::span<const Triangle> triangles, const Ray& ray);

struct ShapeHit {
  double t = 0;
  glm::dvec3 point{0};
  glm::dvec3 normal{0};  // unit, outward; plane and disk: +y; at a cone's apex and where a torus pinches: +y
};

// Every crossing with the shape's surface in object space, nearest first; a tangent ray has one (both, where rounding
// separates them). Solids are closed, edges belong to them. A ray within the plane of a plane or a disk misses.
std::vector<ShapeHit> shapeHits(ShapeKind kind, const glm::vec4& params, const Ray& ray);
std::optional<ShapeHit> closestShapeHit(ShapeKind kind, const glm::vec4& params, const Ray& ray);

}  // namespace crosslight::oracle

// Embree 3 as an oracle of triangle tests, and what its single precision excuses: rays that pass an edge within its
// rounding error, and distances off by that error along the surface's normal.
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <vector>

#include "accel/intersect.h"

namespace crosslight::oracle {

// Embree's robust triangle test (Pluecker): a corner's difference to the origin is rounded once, sums and differences
// of two corners once more, their cross product with the direction four times: an edge function errs by at most
// 16 u |a||b|, u = 2^-24. As a distance from the edge's line that is 16 u L, L the corners' largest distance; likewise
// t is off by 16 u L along the surface's normal, which is 16 u L / cosine along the ray.
inline constexpr double kEmbreeError = 16 * 0x1p-24;

inline double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline glm::dvec3 cross(const glm::dvec3& a, const glm::dvec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const glm::dvec3& v) { return std::sqrt(dot(v, v)); }

class EmbreeScene {
 public:
  explicit EmbreeScene(const std::vector<Triangle>& triangles)
      : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * triangles.size());
    std::memcpy(vertices, triangles.data(), sizeof(Triangle) * triangles.size());
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles.size()));
    for (unsigned i = 0; i < 3 * triangles.size(); ++i) indices[i] = i;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_);
  }
  ~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  std::optional<TriangleHit<double>> closest(const glm::vec3& origin, const glm::vec3& direction) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    alignas(16) RTCRayHit query{};
    query.ray = {origin.x,    origin.y,    origin.z,
                 0,           direction.x, direction.y,
                 direction.z, 0,           std::numeric_limits<float>::infinity(),
                 ~0u,         0,           0};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return TriangleHit<double>{query.ray.tfar, query.hit.u, query.hit.v, query.hit.primID};
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

// Smallest distance between the ray's line and the segment from a to b, both relative to the ray's origin.
inline double distanceToEdge(const glm::dvec3& d, const glm::dvec3& a, const glm::dvec3& b) {
  // Perpendicular to the ray the line is a point: distance of the origin from the projected segment.
  const double dd = dot(d, d);
  const glm::dvec3 p = a - dot(a, d) / dd * d, q = b - dot(b, d) / dd * d, e = q - p;
  const double s = dot(e, e) > 0 ? std::clamp(-dot(p, e) / dot(e, e), 0.0, 1.0) : 0.0;
  return length(p + s * e);
}

inline bool passesAnEdge(const std::vector<Triangle>& triangles, const Ray& ray) {
  return std::any_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
    const glm::dvec3 a = glm::dvec3(t.v0) - ray.origin, b = glm::dvec3(t.v1) - ray.origin,
                     c = glm::dvec3(t.v2) - ray.origin;
    const double farthest = std::max({length(a), length(b), length(c)});
    const double nearest = std::min({distanceToEdge(ray.direction, a, b), distanceToEdge(ray.direction, b, c),
                                     distanceToEdge(ray.direction, c, a)});
    return nearest <= kEmbreeError * farthest;
  });
}

inline double distanceBound(const Triangle& t, const Ray& ray) {
  const glm::dvec3 a = glm::dvec3(t.v0) - ray.origin, b = glm::dvec3(t.v1) - ray.origin,
                   c = glm::dvec3(t.v2) - ray.origin;
  const glm::dvec3 n = cross(b - a, c - a);
  const double cosine = std::abs(dot(n, ray.direction)) / (length(n) * length(ray.direction));
  return kEmbreeError * std::max({length(a), length(b), length(c)}) / (cosine * length(ray.direction));
}

}  // namespace crosslight::oracle

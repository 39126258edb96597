// An independent oracle: Embree 3 traces a million random rays through each of three meshes. It works in single
// precision, so it may differ where a ray passes an edge within its rounding error; nothing else is excused.
#include <embree3/rtcore.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <thread>

#include "accel/intersect.h"
#include "meshes.h"

namespace crosslight::oracle {
namespace {

using testing::Random;

// Embree's robust triangle test (Pluecker): a corner's difference to the origin is rounded once, sums and differences
// of two corners once more, their cross product with the direction four times: an edge function errs by at most
// 16 u |a||b|, u = 2^-24. As a distance from the edge's line that is 16 u L, L the corners' largest distance; likewise
// t is off by 16 u L along the surface's normal, which is 16 u L / cosine along the ray.
constexpr double kEmbreeError = 16 * 0x1p-24;

double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
glm::dvec3 cross(const glm::dvec3& a, const glm::dvec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double length(const glm::dvec3& v) { return std::sqrt(dot(v, v)); }

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
double distanceToEdge(const glm::dvec3& d, const glm::dvec3& a, const glm::dvec3& b) {
  // Perpendicular to the ray the line is a point: distance of the origin from the projected segment.
  const double dd = dot(d, d);
  const glm::dvec3 p = a - dot(a, d) / dd * d, q = b - dot(b, d) / dd * d, e = q - p;
  const double s = dot(e, e) > 0 ? std::clamp(-dot(p, e) / dot(e, e), 0.0, 1.0) : 0.0;
  return length(p + s * e);
}

bool passesAnEdge(const std::vector<Triangle>& triangles, const Ray& ray) {
  return std::any_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
    const glm::dvec3 a = glm::dvec3(t.v0) - ray.origin, b = glm::dvec3(t.v1) - ray.origin,
                     c = glm::dvec3(t.v2) - ray.origin;
    const double farthest = std::max({length(a), length(b), length(c)});
    const double nearest = std::min({distanceToEdge(ray.direction, a, b), distanceToEdge(ray.direction, b, c),
                                     distanceToEdge(ray.direction, c, a)});
    return nearest <= kEmbreeError * farthest;
  });
}

double distanceBound(const Triangle& t, const Ray& ray) {
  const glm::dvec3 a = glm::dvec3(t.v0) - ray.origin, b = glm::dvec3(t.v1) - ray.origin,
                   c = glm::dvec3(t.v2) - ray.origin;
  const glm::dvec3 n = cross(b - a, c - a);
  const double cosine = std::abs(dot(n, ray.direction)) / (length(n) * length(ray.direction));
  return kEmbreeError * std::max({length(a), length(b), length(c)}) / (cosine * length(ray.direction));
}

struct Comparison {
  std::size_t rays = 0, hits = 0, atEdges = 0, unexplained = 0;
};

Comparison compare(const std::vector<Triangle>& triangles, const Bvh& bvh, const EmbreeScene& embree,
                   std::uint64_t seed, std::size_t rays) {
  Comparison result{.rays = rays};
  Random random(seed);
  for (std::size_t i = 0; i < rays; ++i) {
    const glm::vec3 origin(2.5 * random.direction()), target = random.inBox(1);
    const glm::vec3 direction = target - origin;
    const Ray ray{.origin = origin, .direction = direction};
    const auto expected = closestHit(bvh, triangles, ray);
    const auto got = embree.closest(origin, direction);
    result.hits += expected.has_value();
    if (!expected && !got) continue;
    const bool agrees = expected && got &&
                        (std::abs(expected->t - got->t) <= distanceBound(triangles[expected->id], ray) ||
                         std::abs(expected->t - got->t) <= distanceBound(triangles[got->id], ray));
    if (agrees) continue;
    const bool edge = passesAnEdge(triangles, ray);
    ++(edge ? result.atEdges : result.unexplained);
    if (!edge && result.unexplained <= 3) {
      ADD_FAILURE() << "ray " << i << " of seed " << seed << ": t " << (expected ? expected->t : -1) << " here, "
                    << (got ? got->t : -1) << " by Embree";
    }
  }
  return result;
}

struct Mesh {
  const char* name;
  std::vector<Triangle> triangles;
};

class AgainstEmbree : public ::testing::TestWithParam<int> {
 protected:
  static Mesh mesh(int which) {
    if (which == 0) return {"sphere", testing::uvSphere(32, 64, glm::dvec3(0), 0.9)};
    if (which == 1) return {"torusKnot", testing::torusKnot(240, 16)};
    return {"soup", testing::randomSoup(3000, 0.08, 99)};
  }
};

TEST_P(AgainstEmbree, AMillionRaysHitAndMissTheSameAtTheSameDistance) {
  const Mesh m = mesh(GetParam());
  std::vector<Bounds> bounds;
  for (const Triangle& t : m.triangles) bounds.push_back(t.bounds());
  const Bvh bvh = buildBvh(bounds);
  const EmbreeScene embree(m.triangles);
  constexpr std::size_t kParts = 2, kRaysPerPart = 500000;
  std::array<Comparison, kParts> parts;
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < kParts; ++i) {
      threads.emplace_back([&, i] { parts[i] = compare(m.triangles, bvh, embree, 1000 + i, kRaysPerPart); });
    }
  }
  Comparison all;
  for (const Comparison& p : parts) {
    all.rays += p.rays;
    all.hits += p.hits;
    all.atEdges += p.atEdges;
    all.unexplained += p.unexplained;
  }
  RecordProperty("hits", std::to_string(all.hits));
  RecordProperty("differencesAtEdges", std::to_string(all.atEdges));
  std::printf("%s: %zu rays, %zu hits, %zu differences at edges, %zu unexplained\n", m.name, all.rays, all.hits,
              all.atEdges, all.unexplained);
  EXPECT_EQ(all.unexplained, 0u);
  EXPECT_GT(all.hits, all.rays / 10);
  // At most as many as pass an edge within the bound on either side: the edges' length times that width, of at least
  // the 4 units of area that the box of targets shows to any side; corners are at most 2.5 + sqrt(3) away.
  double edges = 0;
  for (const Triangle& t : m.triangles) {
    const glm::dvec3 a(t.v0), b(t.v1), c(t.v2);
    edges += length(b - a) + length(c - b) + length(a - c);
  }
  const double share = edges * 2 * kEmbreeError * (2.5 + std::sqrt(3.0)) / 4;
  EXPECT_LE(static_cast<double>(all.atEdges), share * static_cast<double>(all.rays));
}

std::string nameOfMesh(const ::testing::TestParamInfo<int>& info) {
  return std::array{"sphere", "torusKnot", "soup"}[static_cast<std::size_t>(info.param)];
}
INSTANTIATE_TEST_SUITE_P(Meshes, AgainstEmbree, ::testing::Range(0, 3), nameOfMesh);

}  // namespace
}  // namespace crosslight::oracle

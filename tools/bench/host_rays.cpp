#include "bench/host_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace crosslight::bench {
namespace {

using shared::BvhPrimitive;
using shared::HitRecord;
using shared::RayRecord;

constexpr float kLargest = 3.0e38f;  // as in shaders/math/numeric.glsl
// As in shaders/trace/shadow.comp.
constexpr float kShadowEnd = 1.0f - 1.0f / 8192.0f;

float gammaBound(float n) {
  constexpr float kUnitRoundoff = 0x1p-24f;
  return n * kUnitRoundoff / (1.0f - n * kUnitRoundoff);
}

struct Surface {
  glm::vec3 position, error, normal;
};

// As in shaders/trace/hit_surface.glsl, for triangles.
Surface surfaceOf(const HitRecord& hit, std::span<const BvhPrimitive> primitives) {
  const BvhPrimitive& p = primitives[hit.primitive];
  const float b0 = 1.0f - hit.b1 - hit.b2;
  const glm::vec3 x = b0 * p.v0, y = hit.b1 * p.v1, z = hit.b2 * p.v2;
  return {x + y + z, gammaBound(7.0f) * (glm::abs(x) + glm::abs(y) + glm::abs(z)),
          glm::normalize(glm::cross(p.v1 - p.v0, p.v2 - p.v0))};
}

glm::vec3 leave(const Surface& s, const glm::vec3& direction) {
  const float along = glm::dot(glm::abs(s.normal), s.error + gammaBound(2.0f) * glm::abs(s.position));
  return s.position + (glm::dot(s.normal, direction) < 0.0f ? -along : along) * s.normal;
}

// O'Neill 2014, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms for Random Number
// Generation": the output permutation RXS-M-XS over one step of the generator.
std::uint32_t scrambled(std::uint32_t value) {
  const std::uint32_t state = value * 747796405u + 2891336453u;
  const std::uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

float uniform(std::uint32_t pixel, std::uint32_t dimension, std::uint32_t seed) {
  return static_cast<float>(scrambled(pixel ^ scrambled(dimension ^ scrambled(seed))) >> 8u) * 0x1p-24f;
}

glm::vec3 cosineDirection(const glm::vec3& n, float u, float v) {
  const glm::vec3 side = std::abs(n.x) < 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  const glm::vec3 t = glm::normalize(glm::cross(n, side)), b = glm::cross(n, t);
  const float r = std::sqrt(u), angle = 2.0f * std::numbers::pi_v<float> * v;
  return glm::normalize(r * std::cos(angle) * t + r * std::sin(angle) * b + std::sqrt(1.0f - u) * n);
}

std::uint64_t spread(std::uint32_t value) {
  std::uint64_t bits = value;
  bits = (bits | (bits << 16u)) & 0x0000ffff0000ffffull;
  bits = (bits | (bits << 8u)) & 0x00ff00ff00ff00ffull;
  bits = (bits | (bits << 4u)) & 0x0f0f0f0f0f0f0f0full;
  bits = (bits | (bits << 2u)) & 0x3333333333333333ull;
  return (bits | (bits << 1u)) & 0x5555555555555555ull;
}

// As in shaders/trace/camera.glsl.
std::pair<std::uint32_t, std::uint32_t> pixelInTiles(std::uint32_t ray, std::uint32_t imageWidth) {
  constexpr std::uint32_t size = shared::kTileSize;
  const std::uint32_t across = (imageWidth + size - 1) / size, tile = ray / (size * size), within = ray % (size * size);
  const auto everyOther = [](std::uint32_t bits) { return (bits & 1u) | ((bits >> 1u) & 2u) | ((bits >> 2u) & 4u); };
  return {size * (tile % across) + everyOther(within), size * (tile / across) + everyOther(within >> 1u)};
}

}  // namespace

// A perspective camera's, in the tracer's order and arithmetic.
HostRays cameraRays(const shared::FrameRecord& frame, std::size_t count) {
  HostRays result;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto [x, y] = pixelInTiles(i, frame.resolution.x);
    const glm::vec2 at = glm::vec2(x, y) + frame.sampleOffset;
    const glm::vec2 plane =
        (2.0f * at / glm::vec2(frame.resolution) - 1.0f) * glm::vec2(1.0f, -1.0f) * frame.imagePlaneHalf;
    const glm::vec3 across = plane.x * frame.cameraRight + plane.y * frame.cameraUp;
    result.rays.push_back({glm::vec3(0.0f), frame.zNear, frame.cameraForward + across, frame.zFar});
    result.nodes.push_back(i);
  }
  return result;
}

HostRays shadowRays(const HostRays& camera, std::span<const HitRecord> hits, std::span<const BvhPrimitive> primitives,
                    const glm::vec3& renderPosition) {
  HostRays result;
  for (std::uint32_t i = 0; i < camera.rays.size(); ++i) {
    if (hits[i].primitive == shared::kNoHit) continue;
    const Surface s = surfaceOf(hits[i], primitives);
    const glm::vec3 origin = leave(s, renderPosition - s.position);
    result.rays.push_back({origin, 0.0f, renderPosition - origin, kShadowEnd});
    result.nodes.push_back(i);
  }
  return result;
}

HostRays bounceRays(const HostRays& camera, std::span<const HitRecord> hits, std::span<const BvhPrimitive> primitives,
                    std::uint32_t seed) {
  HostRays result;
  for (std::uint32_t i = 0; i < camera.rays.size(); ++i) {
    if (hits[i].primitive == shared::kNoHit) continue;
    const Surface s = surfaceOf(hits[i], primitives);
    const glm::vec3 n = glm::dot(s.normal, camera.rays[i].direction) > 0.0f ? -s.normal : s.normal;
    const glm::vec3 direction = cosineDirection(n, uniform(i, 0, seed), uniform(i, 1, seed));
    result.rays.push_back({leave(s, direction), 0.0f, direction, kLargest});
    result.nodes.push_back(i);
  }
  return result;
}

std::vector<RayRecord> asRayRecords(const HostRays& rays) {
  std::vector<RayRecord> nodes;
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    RayRecord node{};
    node.origin = rays.rays[i].origin;
    node.direction = rays.rays[i].direction;
    node.tMin = rays.rays[i].tMin;
    node.tMax = rays.rays[i].tMax;
    node.kind = shared::kRayReflection;
    node.medium = shared::kNoRayNode;
    node.from = shared::kNoHit;
    node.depth = 1;
    nodes.push_back(node);
  }
  return nodes;
}

HostRays inMortonOrder(const HostRays& rays, std::uint32_t imageWidth) {
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    const auto [x, y] = pixelInTiles(rays.nodes[i], imageWidth);
    order.emplace_back(spread(x) | (spread(y) << 1u), i);
  }
  std::sort(order.begin(), order.end());
  HostRays result;
  for (const auto& [code, i] : order) {
    result.rays.push_back(rays.rays[i]);
    result.nodes.push_back(rays.nodes[i]);
  }
  return result;
}

}  // namespace crosslight::bench

// Reads the primitives, lets the builder of the wanted quality work and assembles its parts. See README.md for what is
// where.
#include "accel/bvh.h"

#include <algorithm>

#include "accel/bvh_assemble.h"
#include "accel/bvh_binned.h"
#include "accel/bvh_read.h"
#include "base/check.h"
#include "base/time.h"

namespace crosslight {

void Bounds::add(const glm::vec3& p) {
  lower = glm::vec3(std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z));
  upper = glm::vec3(std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z));
}

void Bounds::add(const Bounds& other) {
  if (other.empty()) return;
  add(other.lower);
  add(other.upper);
}

namespace accel {
namespace {

void checkOptions(const BvhOptions& options, std::size_t count) {
  CL_CHECK(options.maxLeafSize >= 1 && options.maxLeafSize <= 15);
  CL_CHECK(options.binCount >= 2);
  CL_CHECK(options.nodeCost >= 0);
  CL_CHECK_LE(count, std::size_t{shared::kBvhFirstMask});
}

template <class Primitives>
Bvh build(const Primitives& primitives, std::size_t count, const BvhOptions& options) {
  checkOptions(options, count);
  const Stopwatch watch;
  Bvh bvh;
  bvh.stats.primitives = static_cast<std::uint32_t>(count);
  Team team(usefulThreads(options.threads, count));
  Buffers buffers{{RawArray<Reference>(count), RawArray<Reference>(count)}};
  const Work root = readReferences(primitives, buffers.sides[0].data(), team);
  if (count < 2) {
    assembleTiny(root, bvh);
  } else {
    const RawArray<shared::BvhNode> nodes(count);
    bvh.order.resize(count);
    Plan plan{options, areaUnit(root.bounds), bvh.order.data()};
    plan.options.binCount = std::min(options.binCount, kMaxBins);
    const Parts parts = buildBinned(plan, buffers, root, nodes.data(), team);
    const std::size_t whileBuilding = 2 * count * sizeof(Reference);
    buffers = {};
    assemble(parts, team, bvh);
    bvh.stats.peakBytes = count * (sizeof(shared::BvhNode) + sizeof(std::uint32_t)) +
                          std::max(whileBuilding, bvh.nodes.size() * sizeof(shared::BvhNode));
  }
  bvh.stats.sizeBytes = bvh.nodes.size() * sizeof(shared::BvhNode) + bvh.order.size() * sizeof(std::uint32_t);
  bvh.stats.buildMs = watch.elapsedMs();
  return bvh;
}

}  // namespace
}  // namespace accel

Bvh buildBvh(std::span<const Bounds> primitives, const BvhOptions& options) {
  return accel::build(primitives, primitives.size(), options);
}

Bvh buildTriangleBvh(const BvhTriangles& triangles, const BvhOptions& options) {
  return accel::build(triangles, triangles.count(), options);
}

}  // namespace crosslight

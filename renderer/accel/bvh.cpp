// Reads the primitives, lets the builder of the wanted quality work and assembles its parts. See README.md for what is
// where.
#include "accel/bvh.h"

#include <algorithm>

#include "accel/bvh_assemble.h"
#include "accel/bvh_binned.h"
#include "accel/bvh_morton.h"
#include "accel/bvh_read.h"
#include "accel/bvh_spatial.h"
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
  CL_CHECK(options.mostDuplicates >= 0);
  CL_CHECK_LE(count, std::size_t{shared::kBvhFirstMask});
}

// What is allocated while building and what remains are both there while the parts are assembled.
void setPeak(std::size_t references, std::size_t parts, Bvh& bvh) {
  const std::size_t result = bvh.nodes.size() * sizeof(shared::BvhNode);
  const std::size_t order = bvh.order.size() * sizeof(std::uint32_t);
  bvh.stats.peakBytes = order + parts + std::max(references, result);
}

// Splits objects only: as many references as primitives.
void buildByObjects(const Plan& plan, Buffers& buffers, const Work& root, Team& team, Bvh& bvh) {
  const RawArray<shared::BvhNode> nodes(root.count);
  const auto builder = plan.options.quality == BvhQuality::fast ? buildMorton : buildBinned;
  const Parts parts = builder(plan, buffers, root, nodes.data(), team);
  buffers = {};
  assemble(parts, team, bvh);
  setPeak(2 * root.count * sizeof(Reference), root.count * sizeof(shared::BvhNode), bvh);
}

void buildInSpace(const Plan& plan, const BvhTriangles& triangles, Buffers& buffers, const Work& root, Team& team,
                  Bvh& bvh) {
  SpatialParts spatial = buildSpatial(plan, triangles, buffers.range(root), root, team);
  buffers = {};
  bvh.order.clear();
  std::size_t room = 0;
  for (const std::uint32_t i : piecesInOrder(spatial.parts)) {
    const SpatialPiece& piece = spatial.pieces[i];
    spatial.parts.pieces[i].firstOfOrder = static_cast<std::uint32_t>(bvh.order.size());
    bvh.order.insert(bvh.order.end(), piece.order.data(), piece.order.data() + piece.orderCount);
    room += piece.room;
  }
  assemble(spatial.parts, team, bvh);
  // Root's references, those of a level and of the next one.
  setPeak(3 * room * sizeof(Reference), room * (sizeof(shared::BvhNode) + sizeof(std::uint32_t)), bvh);
}

Bvh build(std::span<const Bounds> boxes, const BvhTriangles* triangles, const BvhOptions& options) {
  const std::size_t count = triangles != nullptr ? triangles->count() : boxes.size();
  checkOptions(options, count);
  const Stopwatch watch;
  Bvh bvh;
  bvh.stats.primitives = static_cast<std::uint32_t>(count);
  Team team(usefulThreads(options.threads, count));
  Buffers buffers{{RawArray<Reference>(count), {}}};
  Reference* const references = buffers.sides[0].data();
  const Work root =
      triangles != nullptr ? readReferences(*triangles, references, team) : readReferences(boxes, references, team);
  if (count < 2) {
    assembleTiny(root, bvh);
  } else {
    bvh.order.resize(count);
    Plan plan{options, areaUnit(root.bounds), bvh.order.data()};
    plan.options.binCount = std::min(options.binCount, kMaxBins);
    if (options.quality == BvhQuality::high && triangles != nullptr) {
      buildInSpace(plan, *triangles, buffers, root, team, bvh);
    } else {
      buffers.sides[1] = RawArray<Reference>(count);
      buildByObjects(plan, buffers, root, team, bvh);
    }
  }
  bvh.stats.builtSahCost = bvh.stats.sahCost;
  bvh.stats.sizeBytes = bvh.nodes.size() * sizeof(shared::BvhNode) + bvh.order.size() * sizeof(std::uint32_t);
  bvh.stats.buildMs = watch.elapsedMs();
  return bvh;
}

}  // namespace
}  // namespace accel

Bvh buildBvh(std::span<const Bounds> primitives, const BvhOptions& options) {
  return accel::build(primitives, nullptr, options);
}

Bvh buildTriangleBvh(const BvhTriangles& triangles, const BvhOptions& options) {
  return accel::build({}, &triangles, options);
}

}  // namespace crosslight

// The rays of one picture on the host, for peers that trace the same ones: read back or rebuilt as the kernels make
// them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/embree_peer.h"
#include "bindings.h"
#include "structs.h"

namespace crosslight::bench {

// Rays and, for each, the pixel (or ray node) that it belongs to.
struct HostRays {
  std::vector<PeerRay> rays;
  std::vector<std::uint32_t> nodes;
};

HostRays cameraRays(const shared::FrameRecord& frame, std::size_t count);

// From every hit to a light at `renderPosition`, as shadow.comp makes them. `primitives` are the BVH's.
HostRays shadowRays(const HostRays& camera, std::span<const shared::HitRecord> hits,
                    std::span<const shared::BvhPrimitive> primitives, const glm::vec3& renderPosition);

// One ray from every hit into the hemisphere on the viewer's side, its density proportional to the cosine. A function
// of pixel and seed alone.
HostRays bounceRays(const HostRays& camera, std::span<const shared::HitRecord> hits,
                    std::span<const shared::BvhPrimitive> primitives, std::uint32_t seed);
// As records for the kernels: reflected rays, which meet both sides of every surface.
std::vector<shared::RayRecord> asRayRecords(const HostRays& rays);

// The same rays in Morton order of their pixels: neighbors in the picture are neighbors in the list.
HostRays inMortonOrder(const HostRays& rays, std::uint32_t imageWidth);

}  // namespace crosslight::bench

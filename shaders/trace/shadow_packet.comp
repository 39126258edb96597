#version 460
// Which hits of one level a light reaches, 64 shadow rays to a subgroup of 8. For scenes of opaque
// triangles; shadow.comp serves all others.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "trace/tree.glsl"
#include "trace/hit_surface.glsl"
#include "shade/shadow_ray.glsl"
#define CL_RAYS_PER_LANE 8
#include "accel/packet_occluded.glsl"

layout(local_size_x = 8) in;

float lightVisibility(uint lightIndex) { return 1.0; }  // nothing is shaded here

uint placeOf(int k) { return (spreadGroup() * uint(kRaysPerLane) + uint(k)) * kLanes + gl_LocalInvocationID.x; }

void main() {
  LightRecord light = lightOf(pushed.firstLight + pushed.lightInBatch);
  uint traced = 0u;
  [[unroll]] for (int k = 0; k < kRaysPerLane; ++k) {
    uint ray = rayAtPlace(placeOf(k));
    HitRecord hit = hitOf(pushed.firstNode + min(ray, pushed.nodeCount - 1u));
    PrimitiveTexels p = fetchPrimitive(hit.primitive == kNoHit ? 0u : hit.primitive);
    TrianglePoint point = pointOnTriangle(p, barycentricsOf(hit));
    ShadowRay to = shadowRay(point.position, point.error, triangleNormal(p.v0, p.v1, p.v2, false), hit.primitive, light);
    bool counts = to.counts && hit.primitive != kNoHit && ray != kNoRay;
    startShadowRay(k, to.ray, counts);
    traced += counts ? 1u : 0u;
  }
  if (!searchBlockers()) giveUp(spreadGroup());
  [[unroll]] for (int k = 0; k < kRaysPerLane; ++k) {
    uint ray = rayAtPlace(placeOf(k));
    if (ray != kNoRay) visibilities[visibilityPlace(pushed.lightInBatch, ray, pushed.shadowChannel)] = blocked_[k] ? 0.0 : 1.0;
  }
  traced += subgroupShuffleXor(traced, 1u);
  traced += subgroupShuffleXor(traced, 2u);
  traced += subgroupShuffleXor(traced, 4u);
  if (subgroupElect() && traced > 0u) atomicAdd(counters[kCounterShadowRays], traced);
}

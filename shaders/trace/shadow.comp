#version 460
// How much of one light reaches each hit of one level: a ray from the surface to the light, both ends open.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shared/scene_bindings.glsl"
#include "trace/tree.glsl"
#include "trace/shadow_ray.glsl"
#include "trace/camera.glsl"

layout(local_size_x = 64) in;

float lightVisibility(uint lightIndex) { return 1.0; }  // nothing is shaded here

void main() {
  uint ray = rayOfInvocation();
  bool inLevel = ray != kNoRay;
  float visible = 1.0;
  bool traced = false;
  if (inLevel) {
    uint node = pushed.firstNode + ray;
    HitRecord hit = hitOf(node);
    if (hit.primitive != kNoHit) {
      HitSurface s = surfaceOfHit(hit, rayOf(rayOfNode(node, cameraPlace(ray))), false);
      ShadowRay to = shadowRay(s.at.renderPos, s.positionError, s.at.geometricNormal, s.slot,
                               lightOf(pushed.firstLight + pushed.lightInBatch));
      traced = to.counts;
      if (traced) visible = lightPassed(to.ray);
    }
    visibilities[pushed.lightInBatch * pushed.nodeCount + ray] = visible;
  }
  bool counted = (specVariant & kVariantRest) == 0u;  // else by the packet
  uint count = subgroupAdd(traced && counted ? 1u : 0u);
  if (subgroupElect() && count > 0u) atomicAdd(counters[kCounterShadowRays], count);
}

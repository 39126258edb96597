#version 460
// How much of one light reaches each hit of one level: a ray from the surface to the light, both ends open.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shared/scene_bindings.glsl"
#include "trace/tree.glsl"
#define CL_SHADOW_CHANNEL pushed.shadowChannel
#include "trace/hit_surface.glsl"
#include "shade/shadow_ray.glsl"
#include "trace/camera.glsl"
#include "trace/light_passed.glsl"

layout(local_size_x = 64) in;

float lightVisibility(uint lightIndex) { return 1.0; }  // nothing is shaded here

const ShadowRay kNoShadowRay = ShadowRay(Ray(vec3(0.0), vec3(1.0), 0.0, -1.0, kNoHit), false);

ShadowRay shadowRayOf(uint ray) {
  uint node = pushed.firstNode + ray;
  HitRecord hit = hitOf(node);
  if (hit.primitive == kNoHit) return kNoShadowRay;
  HitSurface s = surfaceOfHit(hit, rayOf(rayOfNode(node, cameraPlace(ray))), false);
  return shadowRay(s.at.renderPos, s.positionError, s.at.geometricNormal, s.slot,
                   lightOf(pushed.firstLight + pushed.lightInBatch));
}

void main() {
  uint ray = rayOfInvocation();
  bool inLevel = ray != kNoRay;
  ShadowRay to = kNoShadowRay;
  if (inLevel) to = shadowRayOf(ray);
  uint shapes = kFewShapes && CL_HAS(shapes) ? shapesAhead(to.counts ? to.ray : kNoShadowRay.ray) : 0u;
  float visible = 1.0;
  if (to.counts) visible = lightPassed(to.ray, shapes);
  if (inLevel) visibilities[visibilityPlace(pushed.lightInBatch, ray, pushed.shadowChannel)] = visible;
  bool counted = (specVariant & kVariantRest) == 0u;  // else by the packet
  uint count = subgroupAdd(to.counts && counted && pushed.shadowChannel == 0u ? 1u : 0u);
  if (subgroupElect() && count > 0u) atomicAdd(counters[kCounterShadowRays], count);
}

#version 460
// How much of each light of a batch reaches each hit of one level: a ray from the surface to the light, both ends open.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shared/scene_bindings.glsl"
#include "trace/tree.glsl"
#include "trace/hit_surface.glsl"
#include "shade/shade.glsl"

layout(local_size_x = 64) in;

float lightVisibility(uint lightIndex) { return 1.0; }  // nothing is shaded here

// A blocker within the last 2^-13 of the way counts as the lamp's own housing.
const float kShadowEnd = 1.0 - 1.0 / 8192.0;

// The ray to the light, not normalised for a light at a position: t = 1 is the light itself.
Ray shadowRay(HitSurface s, LightRecord light, vec3 wi) {
  vec3 origin = leaveSurface(s, wi);
  bool directional = light.type == 1u;
  vec3 toLight = directional ? wi : light.renderPosition - origin;
  return Ray(origin, toLight, 0.0, directional ? kLargest : kShadowEnd, s.slot);
}

void main() {
  bool inLevel = gl_GlobalInvocationID.x < pushed.nodeCount;
  uint index = pushed.firstNode + gl_GlobalInvocationID.x;
  uint lightIndex = gl_GlobalInvocationID.y;
  float visible = 1.0;
  bool traced = false;
  if (inLevel) {
    HitRecord hit = hits[index];
    if (hit.primitive != kNoHit) {
      HitSurface s = surfaceOfHit(hit, rayOf(nodes[index]), false);
      LightRecord light = lights[pushed.firstLight + lightIndex];
      LightSample at = sampleLight(light, s.at.renderPos);
      traced = at.falloff > 0.0 && dot(at.wi, at.wi) > 0.0;
      if (traced) visible = lightPassed(shadowRay(s, light, at.wi));
    }
    visibilities[lightIndex * pushed.nodeCount + gl_GlobalInvocationID.x] = visible;
  }
  uint count = subgroupAdd(traced ? 1u : 0u);
  if (subgroupElect() && count > 0u) atomicAdd(counters[kCounterShadowRays], count);
}

// The ray from a surface to a light.
#ifndef CROSSLIGHT_SHADOW_RAY_GLSL
#define CROSSLIGHT_SHADOW_RAY_GLSL
#include "shade/passed_light.glsl"
#include "shade/shade.glsl"
#include "accel/leave_point.glsl"

// A blocker within the last 2^-13 of the way counts as the lamp's own housing.
const float kShadowEnd = 1.0 - 1.0 / 8192.0;

struct ShadowRay {
  Ray ray;
  bool counts;  // the light reaches this far and this way: there is something to find out
};

// Not normalised for a light at a position: t = 1 is the light itself. `slot`: what the ray leaves and cannot meet.
ShadowRay shadowRay(vec3 position, vec3 error, vec3 ng, uint slot, LightRecord light) {
  LightSample at = sampleLight(light, position);
  vec3 origin = leavePoint(position, error, ng, at.wi);
  bool directional = light.type == kLightType_directional;
  vec3 toLight = directional ? at.wi : middleOf(light) - origin;
  return ShadowRay(Ray(origin, toLight, 0.0, directional ? kLargest : kShadowEnd, slot),
                   at.falloff > 0.0 && dot(at.wi, at.wi) > 0.0);
}
#endif

#version 460
// How much of one light with an area reaches each hit of one level: rays to places on it. The answer is a ratio, what
// the samples bring with their blockers over what they bring without (Heitz, Hill, McGuire 2018, "Combining Analytic
// Direct Illumination and Stochastic Shadows"): exactly 1 where nothing is in the way, whatever the samples.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shared/scene_bindings.glsl"
#include "math/random.glsl"
#include "trace/tree.glsl"
#define CL_SHADOW_CHANNEL pushed.shadowChannel
#include "trace/hit_surface.glsl"
#include "shade/shadow_ray.glsl"
#include "shade/area_sample.glsl"
#include "trace/camera.glsl"
#include "trace/light_passed.glsl"
#include "trace/hit_point.glsl"
#include "trace/light_samples.glsl"

layout(local_size_x = 64) in;

float lightVisibility(uint lightIndex) { return 1.0; }  // nothing is shaded here

// Every lane takes every step, those with nothing to find out with rays that have ended: few_shapes.glsl shares loads.
float visibleShare(uint ray, bool inLevel, out uint traced) {
  traced = 0u;
  SampledPoint p = sampledPoint(ray);
  uint index = pushed.firstLight + pushed.lightInBatch;
  LightRecord light = lightOf(index);
  AreaFace f = faceOf(light, p.s.position);
  uint scramble = scrambleOf(p, index);
  bool asks = inLevel && p.hit && f.shines;
  float all = 0.0, passed = 0.0;
  for (uint k = 0u; k < frame.lightSamples; ++k) {
    FaceSample at = sampleFace(f, owenSobol(frame.sampleIndex * frame.lightSamples + k, scramble));
    vec3 wi = safeNormalize(at.to, p.s.n);
    float brings = at.weight * unshadowed(p.s, p.wo, wi, light);
    bool counts = asks && brings > 0.0;
    vec3 origin = leavePoint(p.h.at.renderPos, p.h.positionError, p.h.at.geometricNormal, wi);
    vec3 target = p.h.at.renderPos + reachLight(light, p.s.position, at.to);
    Ray to = Ray(origin, target - origin, 0.0, counts ? kShadowEnd : -1.0, p.h.slot);
    uint shapes = kFewShapes && CL_HAS(shapes) ? shapesAhead(to) : 0u;
    float seen = lightPassed(to, shapes);
    all += counts ? brings : 0.0;
    passed += counts ? brings * seen : 0.0;
    traced += counts ? 1u : 0u;
  }
  return all > 0.0 ? passed / all : 1.0;
}

void main() {
  uint ray = rayOfInvocation();
  bool inLevel = ray != kNoRay;
  uint traced;
  float visible = visibleShare(inLevel ? ray : 0u, inLevel, traced);
  if (inLevel) visibilities[visibilityPlace(pushed.lightInBatch, ray, pushed.shadowChannel)] = visible;
  uint count = subgroupAdd(pushed.shadowChannel == 0u ? traced : 0u);
  if (subgroupElect() && count > 0u) atomicAdd(counters[kCounterShadowRays], count);
}

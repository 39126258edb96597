#version 460
// Smoke on the way of every ray of one level, or the body that it is in where that scatters (effect volumeScatter), after
// its hits are shaded: what comes along the ray is weakened, and what lights scatter into it is added. Without shadows all
// at once; else the first dispatch weakens, and one for each step and light adds, so that no lane walks the tree twice.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "math/random.glsl"
#include "trace/tree.glsl"
#define CL_SHADOW_CHANNEL pushed.shadowChannel
uint body_ = kNoRayNode;  // the material of the body that the light's way begins in
#define CL_BODY_OF_WAY body_
#include "trace/hit_surface.glsl"
#include "shade/shadow_ray.glsl"
#include "shade/smoke.glsl"
#include "trace/camera.glsl"
#include "trace/light_passed.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = kBindRayNodes, scalar) buffer NodeBlock { RayNode nodes[]; };
layout(set = 0, binding = kBindSampleColor, scalar) buffer SampleBlock { vec4 samples[]; };

float lightVisibility(uint lightIndex) { return 1.0; }  // nothing is shaded here

// In TracePush::lightInBatch: everything that needs no shadow rays.
const uint kNoLight = 0xffffffffu;

// Where in its steps, and on lights, a ray is sampled: elsewhere for every ray and seed, so that edges of shadows do not
// line up.
vec3 startOf(RayRecord ray) {
  if (frame.smokeSeed == 0u) return vec3(0.5);
  uint x = hashOf(hashOf(floatBitsToUint(ray.direction) ^ floatBitsToUint(ray.origin)), frame.smokeSeed);
  uvec3 bits = uvec3(x, hashOf(x, 1u), hashOf(x, 2u));
  return (vec3(bits >> 8u) + 0.5) / 16777216.0;
}

// The way to the hit leads through a refracting body, where there is no smoke.
bool isInBody(RayRecord ray, HitRecord hit) {
  if (!CL_HAS(refraction)) return false;
  if (ray.medium != kNoRayNode) return true;
  if (hit.primitive == kNoHit) return false;
  HitSurface h = surfaceOfHit(hit, rayOf(ray), true);
  return !h.at.frontFacing && (materialOf(h.at.materialId).flags & (kMaterialRefracts | kMaterialThin)) == kMaterialRefracts;
}

void addTo(uint node, uint pixel, vec3 light) {
  if (kBranches) nodes[node].value += light;
  else samples[pixel].rgb += light;
}

// What comes along the ray, by way of the rays that follow too.
void weaken(uint node, uint pixel, vec3 clear) {
  if (!kBranches) {
    samples[pixel].rgb *= clear;
    return;
  }
  nodes[node].value *= clear;
  uint reflected = nodes[node].reflected, transmitted = nodes[node].transmitted;
  if (reflected != kNoRayNode) nodes[reflected].weight *= clear;
  if (transmitted == kNoRayNode) return;
  uint count = CL_HAS(dispersion) ? nodes[node].transmittedCount : 1u;
  for (uint k = 0u; k < count; ++k) nodes[transmitted + k].weight *= clear;
}

// The body that the ray is in, if that scatters; else kNoRayNode. A way out of it must have been found.
uint bodyThatScatters(RayRecord ray, HitRecord hit) {
  if (!CL_HAS_TOO(volumeScatter) || ray.medium == kNoRayNode || hit.primitive == kNoHit) return kNoRayNode;
  return mediumScatters(ray.medium) ? ray.medium : kNoRayNode;
}

Scatterer scattererOf(uint body) {
  MaterialRecord m = materialOf(body);
  vec3 extinction = -log(max(m.attenuationColor, vec3(1.0 / kLargest))) / m.attenuationDistance;
  uvec4 s = scatteringOf(body);
  return Scatterer(extinction, extinction * uintBitsToFloat(s.xyz), uintBitsToFloat(s.w), true, true);
}

float amountBefore(Scatterer medium, SmokeWay way, uint step, float where) {
  float before = 0.0;
  for (uint k = 0u; k < step; ++k) {
    SmokeStep s = smokeStep(medium, way, k, where);
    before += smokeDensity(smokePoint(way, s)) * (s.to - s.from);
  }
  return before;
}

// One step of one light; its shadow ray begins in the open. All lanes come along: few_shapes.glsl shares loads.
vec3 lightOfStep(Scatterer medium, SmokeWay way, RayRecord ray, bool asks) {
  vec3 start = startOf(ray);
  SmokeStep s = smokeStep(medium, way, pushed.smokeStep, start.x);
  vec3 p = smokePoint(way, s);
  LightRecord light = lightOf(pushed.lightInBatch);
  LightPlace from = lightPlace(light, p, areaPlace(pushed.smokeStep, start.yz));
  vec3 arrives = scatteredLight(medium, way.direction, light, from, amountTowards(medium, p, from));
  bool counts = asks && any(greaterThan(arrives, vec3(0.0)));
  bool parallel = light.type == kLightType_directional;
  Ray to = Ray(p, parallel ? from.wi : from.distance * from.wi, 0.0, parallel ? kLargest : kShadowEnd, kNoHit);
  if (!counts) to.tMax = -1.0;
  arrives *= lightPassed(to, kFewShapes && CL_HAS(shapes) ? shapesAhead(to) : 0u);
  if (medium.body) arrives *= exp(-medium.extinction * crossedLength());
  if (inColor()) {
    uint c = pushed.shadowChannel;
    arrives *= vec3(c == 0u ? 1.0 : 0.0, c == 1u ? 1.0 : 0.0, c == 2u ? 1.0 : 0.0);
  }
  float before = s.from;
  if (!medium.even) before = amountBefore(medium, way, pushed.smokeStep, start.x);
  return smokeWeight(medium, s, before, densityAt(medium, p)) * arrives;
}

void main() {
  uint at = placeOfInvocation();
  bool counts = at < pushed.nodeCount;
  at = counts ? at : 0u;
  uint node = pushed.firstNode + at;
  CameraPlace place = cameraPlace(at);
  RayRecord ray = rayOfNode(node, place);
  uint pixel = pixelOf(place);
  counts = counts && !(ray.kind == kRayPrimary && pixel == kNoPixel);
  HitRecord hit = hitOf(node);
  body_ = bodyThatScatters(ray, hit);
  bool inBody = CL_HAS_TOO(volumeScatter) && body_ != kNoRayNode;
  counts = counts && (inBody || !isInBody(ray, hit));
  float unit = safeLength(ray.direction);
  SmokeWay way = smokeAlong(ray.origin, ray.direction / unit, hit.primitive == kNoHit ? kLargest : hit.t * unit);
  Scatterer medium = theSmoke();
  if (inBody) {
    way = SmokeWay(ray.origin, ray.direction / unit, 0.0, hit.t * unit);
    medium = scattererOf(body_);
  }
  counts = counts && way.end > way.begin;
  if (pushed.lightInBatch != kNoLight) {
    vec3 light = lightOfStep(medium, way, ray, counts);
    if (counts) addTo(node, pixel, light);
    return;
  }
  if (!counts) return;
  Air air = airOn(medium, way, CL_HAS(shadows) ? 0u : frame.lightCount, startOf(ray));
  weaken(node, pixel, air.clear);
  addTo(node, pixel, air.light);
}

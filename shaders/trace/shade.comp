#version 460
// Local illumination of every hit of one level for a batch of lights; with the first batch also emission, absorption
// on the way, and the rays that follow: Whitted 1980, "An Improved Illumination Model for Shaded Display".
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shared/scene_bindings.glsl"
#define CL_ENVIRONMENT_VISIBILITY(lightCount) environmentVisibility(lightCount)
#include "trace/tree.glsl"
#include "trace/seen_light.glsl"
#include "trace/hit_surface.glsl"
#include "shade/shade.glsl"
#include "trace/camera.glsl"
#include "shade/optics.glsl"
#include "shade/mirror.glsl"
#include "trace/hit_point.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = kBindAovs, scalar) buffer AovBlock { AovRecord aovs[]; };
layout(set = 0, binding = kBindRayNodes, scalar) buffer NodeBlock { RayNode nodes[]; };
layout(set = 0, binding = kBindSampleColor, scalar) buffer SampleBlock { vec4 samples[]; };
#include "trace/results.glsl"
layout(set = 0, binding = kBindMedia, scalar) buffer MediaBlock { uvec4 mediaOfNodes[]; };
#include "trace/fogged.glsl"
#include "trace/media.glsl"
#include "trace/dispersion.glsl"
#include "trace/children.glsl"

const bool kWritesAovs = (specVariant & kVariantAovs) != 0u;

float lightVisibility(uint lightIndex) { return seenVisibility(lightIndex); }

void recordAov(uint pixel, HitSurface h, SurfacePoint s, ShadedParts parts, bool firstBatch) {
  AovRecord aov = aovs[pixel];
  if (firstBatch) {
    aov.depth = dot(s.position, frame.cameraForward);
    aov.position = s.position;
    aov.normal = s.n;
    aov.geometricNormal = s.ng;
    aov.albedo = s.albedo;
    aov.uv = h.at.uv0;
    aov.instanceId = drawOf(h.drawId).instanceId;
    aov.primitiveId = h.primitiveId;
    aov.materialId = h.at.materialId;
    aov.ambient = aov.diffuse = aov.specular = vec3(0.0);
    aov.emission = parts.emission;
  }
  aov.ambient += parts.ambient;
  aov.diffuse += parts.diffuse;
  aov.specular += parts.specular;
  aovs[pixel] = aov;
}

// KHR_materials_volume: attenuationColor is what remains of white after attenuationDistance. Lengths in scene units.
vec3 absorbed(uint medium, float distance) {
  MaterialRecord m = materialOf(medium);
  vec3 remaining = exp(log(max(m.attenuationColor, vec3(1.0 / kLargest))) * (distance / m.attenuationDistance));
  return m.attenuationDistance > 0.0 ? remaining : vec3(1.0);
}

// The way to the hit led through a refracting body: the ray knows, whether or not what it hits refracts, or its own
// surface does.
bool isInsideBody(RayRecord ray, HitSurface h) {
  const uint kBody = kMaterialRefracts | kMaterialThin;
  bool leavesBody = !h.at.frontFacing && (materialOf(h.at.materialId).flags & kBody) == kMaterialRefracts;
  return ray.medium != kNoRayNode || (CL_HAS(refraction) && leavesBody);
}

// Length of the light's way from the camera to the hit.
float pathTo(uint node, RayRecord ray, float t) {
  float before = kBranches && ray.kind != kRayPrimary ? nodes[node].path : 0.0;
  return before + wayOf(ray, t);
}

Shaded shadeHit(RayRecord ray, HitRecord hit, uint pixel) {
  bool firstBatch = !kManyLights || pushed.firstLight == 0u;
  HitSurface h = surfaceOfHit(hit, rayOf(ray), !goesStraight(ray.kind));
  float path = CL_HAS(mipmaps) ? pathTo(pushed.firstNode + shaded_, ray, hit.t) : 0.0;
  SurfacePoint s = pointOfHit(h, ray, path);
  if (CL_HAS(reflection) && ray.depth < pushed.maxDepth) mirrored_ = mirroredLobes(materialOf(h.at.materialId));
  LightSums sums = illuminate(s, towardsViewer(ray, s.position), pushed.firstLight, pushed.lightCount);
  // Inside a refracting body no light arrives but along the rays that the tree follows.
  bool interior = isInterior(h);
  if (interior) sums = LightSums(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
  ShadedParts parts = compose(s, sums, firstBatch && !interior ? frame.ambient : vec3(0.0));
  if (!firstBatch) parts.emission = vec3(0.0);
  if (kWritesAovs && ray.kind == kRayPrimary) recordAov(pixel, h, s, parts, firstBatch);
  float opacity = CL_HAS(transparency) ? s.opacity : 1.0;
  Shaded shaded = Shaded(sumOf(parts) * opacity, opacity, vec3(1.0), Children(kNoRayNode, kNoRayNode, 1u));
  SegmentFog fog = SegmentFog(0.0, Fog(1.0, 0.0));
  if (CL_HAS(fog)) fog = fogAtHit(pushed.firstNode + shaded_, ray, hit.t, isInsideBody(ray, h));
  // What a body scatters is added on the way: smoke.comp takes away what it absorbs, too.
  if (CL_HAS(absorption) && kBranches && ray.medium != kNoRayNode &&
      !(CL_HAS_TOO(volumeScatter) && mediumScatters(ray.medium)))
    shaded.weightScale = absorbed(ray.medium, hit.t * length(ray.direction));
  SurfaceMedia media = kNoMedia;
  if (CL_HAS(nestedMedia)) {
    media = mediaAtHit(pushed.firstNode + shaded_, ray, h, shaded.weightScale);
    if (isHidden(media)) shaded.value = vec3(shaded.alpha = 0.0);
    shaded.value *= media.cameraRayKept;
  }
  vec3 passed = vec3(0.0);
  if (kBranches && firstBatch) {
    shaded.children = spawnChildren(ray, h, s, fog, path, media, passed);
  }
  if (CL_HAS(fog)) {
    if (!firstBatch) fog.fog.fogged = 0.0;
    shaded.value = throughFog(shaded.value, passed, fog.fog);
  }
  return shaded;
}

void main() {
  uint at = rayOfInvocation();
  if (at == kNoRay) return;
  uint index = pushed.firstNode + at;
  CameraPlace place = cameraPlace(at);
  RayRecord ray = rayOfNode(index, place);
  uint pixel = pixelOf(place);
  if (ray.kind == kRayPrimary && pixel == kNoPixel) return;
  HitRecord hit = hitOf(index);
  if ((specVariant & kVariantQueue) == 0u && hit.primitive == kNoHit) {  // queues hold hits alone
    storeMiss(index, pixel, ray.direction);
    return;
  }
  shaded_ = at;
  Shaded shaded = shadeHit(ray, hit, pixel);
  if (kBranches) storeNode(index, ray, shaded);
  else storeSample(pixel, shaded);
}

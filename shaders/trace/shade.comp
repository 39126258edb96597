#version 460
// Local illumination of every hit of one level for a batch of lights; with the first batch also emission, absorption
// on the way, and the rays that follow: Whitted 1980, "An Improved Illumination Model for Shaded Display".
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shared/scene_bindings.glsl"
#include "trace/tree.glsl"
#include "trace/hit_surface.glsl"
#include "shade/shade.glsl"
#include "trace/camera.glsl"
#include "trace/optics.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = kBindAovs, scalar) buffer AovBlock { AovRecord aovs[]; };
layout(set = 0, binding = kBindRayNodes, scalar) buffer NodeBlock { RayNode nodes[]; };
layout(set = 0, binding = kBindSampleColor, scalar) buffer SampleBlock { vec4 samples[]; };
#include "trace/children.glsl"

const bool kManyLights = (specVariant & kVariantManyLights) != 0u;
const bool kWritesAovs = (specVariant & kVariantAovs) != 0u;

float lightVisibility(uint lightIndex) {
  if (!CL_HAS(shadows)) return 1.0;
  return visibilities[lightIndex * pushed.nodeCount + gl_GlobalInvocationID.x];
}

// The viewer of a secondary ray is where it comes from; primary rays share the camera's rule with the rasteriser.
vec3 towardsViewer(RayRecord ray, vec3 renderPos) {
  bool camera = !kBranches || ray.kind == kRayPrimary;
  return camera ? viewDirection(renderPos) : -safeNormalize(ray.direction, vec3(0.0));
}

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

struct Shaded {
  vec3 value;
  float alpha;
  vec3 weightScale;  // what is left after the way through a medium
  Children children;
};

Shaded shadeHit(RayRecord ray, HitRecord hit, uint pixel) {
  bool firstBatch = !kManyLights || pushed.firstLight == 0u;
  HitSurface h = surfaceOfHit(hit, rayOf(ray), !goesStraight(ray.kind));
  SurfacePoint s = surfaceAt(h.at);
  LightSums sums = illuminate(s, towardsViewer(ray, s.position), pushed.firstLight, pushed.lightCount);
  // Inside a refracting body no light arrives but along the rays that the tree follows.
  bool interior = CL_HAS(refraction) && !h.at.frontFacing && (materialOf(h.at.materialId).flags & kMaterialRefracts) != 0u;
  if (interior) sums = LightSums(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
  ShadedParts parts = compose(s, sums, firstBatch && !interior ? frame.ambient : vec3(0.0));
  if (!firstBatch) parts.emission = vec3(0.0);
  if (kWritesAovs && ray.kind == kRayPrimary) recordAov(pixel, h, s, parts, firstBatch);
  float opacity = CL_HAS(transparency) ? s.opacity : 1.0;
  Shaded shaded = Shaded(sumOf(parts) * opacity, opacity, vec3(1.0), Children(kNoRayNode, kNoRayNode));
  if (kBranches && firstBatch) {
    if (CL_HAS(absorption) && ray.medium != kNoRayNode)
      shaded.weightScale = absorbed(ray.medium, hit.t * length(ray.direction));
    shaded.children = spawnChildren(ray, h, s);
  }
  return shaded;
}

// One level, no tree: the sample is complete when the last batch of lights is.
void storeSample(uint pixel, Shaded shaded) {
  vec4 sofar = vec4(0.0);
  if (kManyLights && pushed.firstLight > 0u) sofar = vec4(samples[pixel].rgb, 0.0);
  samples[pixel] = vec4(sofar.rgb + shaded.value, shaded.alpha);
}

void storeNode(uint index, RayRecord ray, Shaded shaded) {
  if (kManyLights && pushed.firstLight > 0u) {
    nodes[index].value += shaded.value;
    return;
  }
  nodes[index].value = shaded.value;
  nodes[index].alpha = shaded.alpha;
  nodes[index].reflected = shaded.children.reflected;
  nodes[index].transmitted = shaded.children.transmitted;
  if (CL_HAS(absorption) && ray.kind != kRayPrimary) nodes[index].weight *= shaded.weightScale;
}

void main() {
  if (gl_GlobalInvocationID.x >= pushed.nodeCount) return;
  uint index = pushed.firstNode + gl_GlobalInvocationID.x;
  CameraPlace place = cameraPlace(gl_GlobalInvocationID.x);
  RayRecord ray = rayOfNode(index, place);
  uint pixel = pixelOf(place);
  if (ray.kind == kRayPrimary && pixel == kNoPixel) return;
  HitRecord hit = hitOf(index);
  bool later = kManyLights && pushed.firstLight > 0u;
  Shaded shaded = Shaded(later ? vec3(0.0) : frame.background, 0.0, vec3(1.0), Children(kNoRayNode, kNoRayNode));
  if (hit.primitive != kNoHit) shaded = shadeHit(ray, hit, pixel);
  if (kBranches) storeNode(index, ray, shaded);
  else if (!later || hit.primitive != kNoHit) storeSample(pixel, shaded);
}

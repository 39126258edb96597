#version 460
// Local illumination of every hit of one level for a batch of lights; with the first batch also emission, absorption
// on the way, and the rays that follow: Whitted 1980, "An Improved Illumination Model for Shaded Display".
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "trace/tree.glsl"
#include "trace/hit_surface.glsl"
#include "shade/shade.glsl"
#include "trace/optics.glsl"
#include "trace/children.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = kBindAovs, scalar) buffer AovBlock { AovRecord aovs[]; };

float lightVisibility(uint lightIndex) {
  if (!CL_HAS(shadows)) return 1.0;
  return visibilities[lightIndex * pushed.nodeCount + gl_GlobalInvocationID.x];
}

// The viewer of a secondary ray is where it comes from; primary rays share the camera's rule with the rasteriser.
vec3 towardsViewer(RayNode node, vec3 renderPos) {
  return node.kind == kRayPrimary ? viewDirection(renderPos) : -safeNormalize(node.direction, vec3(0.0));
}

void recordAov(RayNode node, HitSurface h, SurfacePoint s, ShadedParts parts, bool firstBatch) {
  AovRecord aov = aovs[node.pixel];
  if (firstBatch) {
    aov.depth = dot(s.position, frame.cameraForward);
    aov.position = s.position;
    aov.normal = s.n;
    aov.geometricNormal = s.ng;
    aov.albedo = s.albedo;
    aov.uv = h.at.uv0;
    aov.instanceId = draws[h.drawId].instanceId;
    aov.primitiveId = h.primitiveId;
    aov.materialId = h.at.materialId;
    aov.ambient = aov.diffuse = aov.specular = vec3(0.0);
    aov.emission = parts.emission;
  }
  aov.ambient += parts.ambient;
  aov.diffuse += parts.diffuse;
  aov.specular += parts.specular;
  aovs[node.pixel] = aov;
}

// KHR_materials_volume: attenuationColor is what remains of white after attenuationDistance. Lengths in scene units.
vec3 absorbed(uint medium, float distance) {
  MaterialRecord m = materials[medium];
  vec3 remaining = exp(log(max(m.attenuationColor, vec3(1.0 / kLargest))) * (distance / m.attenuationDistance));
  return m.attenuationDistance > 0.0 ? remaining : vec3(1.0);
}

void main() {
  if (gl_GlobalInvocationID.x >= pushed.nodeCount) return;
  uint index = pushed.firstNode + gl_GlobalInvocationID.x;
  RayNode node = nodes[index];
  HitRecord hit = hits[index];
  bool firstBatch = pushed.firstLight == 0u;
  if (hit.primitive == kNoHit) {
    node.value = frame.background;
    nodes[index] = node;
    return;
  }
  HitSurface h = surfaceOfHit(hit, rayOf(node), !goesStraight(node));
  SurfacePoint s = surfaceAt(h.at);
  LightSums sums = illuminate(s, towardsViewer(node, s.position), pushed.firstLight, pushed.lightCount);
  // Inside a refracting body no light arrives but along the rays that the tree follows.
  bool interior = CL_HAS(refraction) && !h.at.frontFacing && (materials[h.at.materialId].flags & kMaterialRefracts) != 0u;
  if (interior) sums = LightSums(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
  ShadedParts parts = compose(s, sums, firstBatch && !interior ? frame.ambient : vec3(0.0));
  if (!firstBatch) parts.emission = vec3(0.0);
  if (pushed.writeAovs != 0u && node.kind == kRayPrimary) recordAov(node, h, s, parts, firstBatch);
  float opacity = CL_HAS(transparency) ? s.opacity : 1.0;
  node.value += sumOf(parts) * opacity;
  if (firstBatch) {
    node.alpha = opacity;
    if (CL_HAS(absorption) && node.medium != kNoRayNode) node.weight *= absorbed(node.medium, hit.t * length(node.direction));
    spawnChildren(node, h, s);
  }
  nodes[index] = node;
}

#version 460
// The ray trees of one level as the host shows them: rays, hits, and what each light of the batch brings to each hit.
// Runs after the level is shaded, for the few pixels that somebody asked to see the trees of.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "shared/ray_tree_records.h"
#define CL_LIGHTS_ONLY  // the environment is none of the lights that are listed
#include "trace/tree.glsl"
#include "trace/seen_light.glsl"
#include "trace/hit_surface.glsl"
#include "shade/shade.glsl"
#include "trace/camera.glsl"
#include "trace/hit_point.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = kBindNodeTexels) uniform usamplerBuffer nodeTexels;
layout(set = 0, binding = kBindRayTree, scalar) writeonly buffer RayTreeBlock { RayTreeRecord records[]; };
layout(set = 0, binding = kBindRayTreeLights, scalar) writeonly buffer RayTreeLightBlock { RayTreeLightRecord lit[]; };

uint batchLight_;

float lightVisibility(uint lightIndex) { return seenVisibility(batchLight_); }

// Of one number, where shadows have colors: what passes of the color that passes best.
float shownVisibility() {
  if (!seesInColor()) return seenVisibility(batchLight_);
  return max(max(visibilityOf(batchLight_, 0u), visibilityOf(batchLight_, 1u)), visibilityOf(batchLight_, 2u));
}

vec4 nodeTexel(uint node, uint part) { return uintBitsToFloat(texelFetch(nodeTexels, int(3u * node + part))); }

void recordLights(uint node, RayRecord ray, SurfacePoint s, bool interior) {
  vec3 wo = towardsViewer(ray, s.position);
  for (batchLight_ = 0u; batchLight_ < pushed.lightCount; ++batchLight_) {
    uint light = pushed.firstLight + batchLight_;
    ShadedParts parts = compose(s, illuminate(s, wo, light, 1u), vec3(0.0));
    lit[light * pushed.nodeCapacity + node] =
        RayTreeLightRecord(parts.ambient + parts.diffuse + parts.specular, interior ? -1.0 : shownVisibility());
  }
}

void main() {
  uint at = placeOfInvocation();
  if (at >= pushed.nodeCount) return;
  uint node = pushed.firstNode + at;
  CameraPlace place = cameraPlace(at);
  if (pushed.firstNode == 0u && place.outside) return;
  shaded_ = at;
  RayRecord ray = rayOfNode(node, place);
  HitRecord hit = hitOf(node);
  RayTreeRecord r;
  r.origin = ray.origin;
  r.direction = ray.direction;
  r.kind = ray.kind;
  r.depth = ray.depth;
  r.medium = ray.medium;
  r.t = -1.0;
  r.position = r.normal = vec3(0.0);
  r.materialId = r.instanceId = r.primitiveId = kNoId;
  r.own = r.weight = vec3(0.0);
  r.alpha = 0.0;
  r.reflected = r.transmitted = kNoRayNode;
  r.transmittedCount = 1u;
  if (kBranches) {
    vec4 own = nodeTexel(node, 0u);
    uvec4 children = texelFetch(nodeTexels, int(3u * node + 2u));
    r.own = own.rgb;
    r.alpha = own.a;
    r.weight = nodeTexel(node, 1u).rgb;
    r.reflected = children.x;
    r.transmitted = children.y;
    if (CL_HAS(dispersion)) r.transmittedCount = children.w;
  }
  if (hit.primitive != kNoHit) {
    HitSurface h = surfaceOfHit(hit, rayOf(ray), !goesStraight(ray.kind));
    bool sent = CL_HAS(mipmaps) && kBranches && ray.kind != kRayPrimary;
    float before = sent ? nodeTexel(node, 2u).z : 0.0;
    SurfacePoint s = pointOfHit(h, ray, before + wayOf(ray, hit.t));
    r.t = hit.t;
    r.position = s.position;
    r.normal = s.n;
    r.materialId = h.at.materialId;
    r.instanceId = drawOf(h.drawId).instanceId;
    r.primitiveId = h.primitiveId;
    recordLights(node, ray, s, isInterior(h));
  }
  records[node] = r;
}

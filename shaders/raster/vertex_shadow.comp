#version 460
// How much of one light reaches each vertex, by its map or by a ray from the vertex itself. The ray cannot meet the
// triangles that end there, and what lies nearer than rounding may put any triangle counts as touching the vertex, not as
// a blocker.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "shared/raster_bindings.h"
#define CL_IS_LEFT(p, slot, ray) ((p).v0 == (ray).origin || (p).v1 == (ray).origin || (p).v2 == (ray).origin)
#include "shade/shadow_ray.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform PushBlock { VertexShadowPush pushed; };
layout(set = 0, binding = kBindVertexVisibility, scalar) writeonly buffer VertexVisibilityBlock { float vertexVisibilities[]; };

layout(constant_id = kSpecRasterShadows) const uint specRasterShadows = kShadowsByRays;

#include "raster/shadow_lookup.glsl"

vec3 position_, normal_;  // of the vertex

vec4 receiverPlane(ShadowView view) {
  vec3 n = turnedIntoView(view, normal_);
  return vec4(n, dot(n, inView(view, position_)));
}

float lightVisibility(uint light) { return 1.0; }  // nothing is shaded here

// A ray's t is off by gamma_16 of the coordinates of triangle and origin, unless it runs along the triangle.
const float kTouching = 32.0;

float passedFrom(uint vertex) {
  if (specRasterShadows == kShadowsByMaps) {
    position_ = positionOf(vertex);
    normal_ = safeNormalize(attributesOf(vertex).renderNormal, vec3(0.0, 0.0, 1.0));
    return visibleByMap(pushed.light, position_);
  }
  ShadowRay to = shadowRay(positionOf(vertex), vec3(0.0), vec3(0.0), kNoHit, lightOf(pushed.light));
  Ray ray = to.ray;
  ray.origin = positionOf(vertex);
  ray.tMin = gammaBound(kTouching) * pushed.reach / safeLength(ray.direction);
  ray.tMax = to.counts ? ray.tMax : -1.0;
  return lightPassedTriangles(ray);
}

void main() {
  uint vertex = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
  if (vertex < pushed.vertexCount)
    vertexVisibilities[vertex * pushed.lightCount + pushed.light] = passedFrom(vertex);
}

// How much of a light reaches what a raster method lights. Lighting per fragment asks here, by rays or from maps;
// lighting per vertex reads what vertex_shadow.comp found, once per vertex: Gouraud's and flat shading's shadows are as
// coarse as their light.
#ifndef CROSSLIGHT_RASTER_SHADOW_GLSL
#define CROSSLIGHT_RASTER_SHADOW_GLSL
#include "shared/raster_bindings.h"

layout(constant_id = kSpecRasterShadows) const uint specRasterShadows = kShadowsOff;
const uint kShadows = specRasterShadows * uint(CL_HAS(shadows));

#ifdef CL_VERTEX_STAGE
layout(set = 0, binding = kBindVertexVisibility, scalar) readonly buffer VertexVisibilityBlock { float vertexVisibilities[]; };

float lightVisibility(uint light) {
  if (kShadows == kShadowsOff) return 1.0;
  return vertexVisibilities[uint(gl_VertexIndex) * drawnLightCount() + light];
}
#elif defined(CL_LIT_HERE)

// Triangles are named by their place in the flattened list, not by their slot in the tree. Mesa 22.3 ends all loops of
// an invocation together: the walks to all lights share what one may take.
uint walked_ = 0u;
#define CL_IS_LEFT(p, slot, ray) ((p).id == (ray).from)
#define CL_STEPS_BEFORE walked_
#define CL_STEPS_AFTER(steps) walked_ = steps
#include "shade/shadow_ray.glsl"
#include "shade/triangle.glsl"

// What is lit: a point of a triangle, exactly enough for rays to leave it.
struct Receiver {
  vec3 position;
  vec3 error;  // bound of the position's rounding error, per axis
  vec3 ng;     // unit, front side
  uint triangle;
  TriangleCorners corners;
};
Receiver receiver_;

#include "raster/shadow_lookup.glsl"

vec4 receiverPlane(ShadowView view) {
  return planeOf(inView(view, receiver_.corners.v0), inView(view, receiver_.corners.v1), inView(view, receiver_.corners.v2));
}

// The point of the triangle's plane, and of the triangle, that is nearest to an interpolated position: rasterizers
// snap corners to a grid and, with several samples per pixel, light pixels' centers beyond the triangle's edge.
vec3 ontoEdge(vec3 p, vec3 a, vec3 b, vec3 ng) {
  vec3 inward = cross(ng, b - a);
  float outside = min(dot(p - a, inward), 0.0);
  float square = dot(inward, inward);
  return square > 0.0 ? p - inward * (outside / square) : p;
}

Receiver receiverOn(uint triangle, vec3 p, bool flipsWinding) {
  TriangleCorners c = cornersOf(triangle);
  vec3 turned = triangleNormal(c.v0, c.v1, c.v2, false);
  vec3 ng = flipsWinding ? -turned : turned;
  p = ontoEdge(ontoEdge(ontoEdge(p, c.v0, c.v1, turned), c.v1, c.v2, turned), c.v2, c.v0, turned);
  p -= ng * dot(ng, p - c.v0);
  // Sixteen roundings of coordinates as large as the corners': less than two for each difference, product and sum
  // above, and those of the normal.
  vec3 largest = max(max(abs(c.v0), abs(c.v1)), max(abs(c.v2), abs(p)));
  return Receiver(p, gammaBound(16.0) * largest, ng, triangle, c);
}

float visibleByRay(LightRecord light) {
  ShadowRay to = shadowRay(receiver_.position, receiver_.error, receiver_.ng, receiver_.triangle, light);
  Ray ray = to.ray;
  ray.tMax = to.counts ? ray.tMax : -1.0;
  return lightPassedTriangles(ray);
}

float lightVisibility(uint light) {
  if (kShadows == kShadowsOff) return 1.0;
  if (kShadows == kShadowsByMaps) return visibleByMap(light, receiver_.position);
  return visibleByRay(CL_LIGHT(light));
}
#else
float lightVisibility(uint light) { return 1.0; }  // lit by the stage before
#endif
#endif

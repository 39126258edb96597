// Rays against analytic shapes, in object space: one file per kind, dispatched from the list. Each answers with the
// nearest hit in (tMin, tMax], a point that lies on the surface to rounding (never o + t d), and the outward normal.
#ifndef CROSSLIGHT_SHAPE_GLSL
#define CROSSLIGHT_SHAPE_GLSL
#include "math/numeric.glsl"
#include "accel/quadratic.glsl"

struct ShapeHit {
  bool hit;
  float t;
  vec3 p;   // object space
  vec3 n;   // object space, outward, not necessarily unit
  vec2 uv;
};

const ShapeHit kShapeMiss = ShapeHit(false, 0.0, vec3(0.0), vec3(0.0, 1.0, 0.0), vec2(0.0));

// Longitude and latitude as texture coordinates; atan(0, 0) is avoided: it is whatever the device likes. Angles from the
// pole are told by both legs: acos of the cosine has no digits there.
vec2 sphericalUv(vec3 p, float radius) {
  float longitude = (p.x == 0.0 && p.z == 0.0) ? 0.0 : atan(p.z, p.x);
  return vec2(0.5 + longitude / (2.0 * kPi), atan(length(p.xz), p.y) / kPi);
}

bool inRange(float t, float tMin, float tMax) { return t > tMin && t <= tMax; }

// Moves the origin to the point of the ray nearest to the object's center: coefficients formed there stay small, so
// that far rays lose no digits (NUMERICS T15). Returns the distance to add to every root.
float recenter(inout vec3 o, vec3 d) {
  float t0 = -dot(o, d) / dot(d, d);
  o += t0 * d;
  return t0;
}

#include "accel/shape_sphere.glsl"
#include "accel/shape_plane.glsl"
#include "accel/shape_box.glsl"
#include "accel/shape_cylinder.glsl"
#include "accel/shape_cone.glsl"
#include "accel/shape_torus.glsl"

ShapeHit hitShape(uint kind, vec4 params, vec3 o, vec3 d, float tMin, float tMax) {
  ShapeHit hit = kShapeMiss;
#define CL_SHAPE_CASE(value, name, Stem, text) \
  if ((specShapes & (1u << value)) != 0u && kind == value) hit = hit##Stem(params, o, d, tMin, tMax);
  CL_SHAPE_KINDS(CL_SHAPE_CASE)
#undef CL_SHAPE_CASE
  return hit;
}
#endif

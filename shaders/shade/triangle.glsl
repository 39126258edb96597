// A triangle of the flattened scene by its index: what vertices and hits cannot carry.
#ifndef CROSSLIGHT_TRIANGLE_GLSL
#define CROSSLIGHT_TRIANGLE_GLSL
#include "math/numeric.glsl"

// Unit normal of the front side. The better conditioned pair of edges decides: the two shortest ones.
vec3 triangleNormal(vec3 v0, vec3 v1, vec3 v2, bool flipsWinding) {
  vec3 e0 = v1 - v0;
  vec3 e1 = v2 - v1;
  vec3 e2 = v0 - v2;
  float l0 = dot(e0, e0);
  float l1 = dot(e1, e1);
  float l2 = dot(e2, e2);
  vec3 a = l0 >= l1 && l0 >= l2 ? e1 : (l1 >= l2 ? e2 : e0);
  vec3 b = l0 >= l1 && l0 >= l2 ? e2 : (l1 >= l2 ? e0 : e1);
  // Lengths first, so that the product neither overflows nor vanishes.
  vec3 n = cross(safeNormalize(a, vec3(0.0)), safeNormalize(b, vec3(0.0)));
  n = safeNormalize(n, vec3(0.0, 0.0, 1.0));
  return flipsWinding ? -n : n;
}

struct TriangleCorners {
  uint i0, i1, i2;
  vec3 v0, v1, v2;
};

TriangleCorners cornersOf(uint triangle) {
  uvec3 i = cornerIndices(triangle);
  return TriangleCorners(i.x, i.y, i.z, positionOf(i.x), positionOf(i.y), positionOf(i.z));
}
#endif

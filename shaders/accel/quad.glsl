// Walk of the tree of quantised nodes with four children, one ray per lane, for rays that go their own ways. Half the
// steps of the binary tree at the same four texels a step. Hits are those of bvh.glsl, bit for bit: a node's planes lie
// outside of the exact ones, and the triangle's test is the same.
#ifndef CROSSLIGHT_QUAD_GLSL
#define CROSSLIGHT_QUAD_GLSL
#include "accel/bvh.glsl"

const uint kNotMet = 0xffffffffu;

vec3 planesOf(vec3 origin, vec3 scale, uvec3 bytes, uint child) {
  return origin + scale * vec3(ivec3((bytes >> (8u * child)) & 255u));
}

// NaN (a ray within a face) loses every comparison. Distance bits of a child that the ray meets, its number in the lowest two; kNotMet else.
uint keyOf(uint child, uint number, vec3 nearPlanes, vec3 farPlanes, WalkRay w) {
  const float kWiden = 1.00000036;  // 1 + 2 gamma_3
  vec3 near = (nearPlanes - w.ray.origin) * w.inverse;
  vec3 far = (farPlanes - w.ray.origin) * w.inverse;
  float t0 = greater(near.z, greater(near.y, greater(near.x, w.ray.tMin)));
  float t1 = smaller(far.z, smaller(far.y, smaller(far.x, kLargest))) * kWiden;
  return t0 <= smaller(t1, w.ray.tMax) && child != kEmptyChild ? (floatBitsToUint(greater(t0, 0.0)) & ~3u) | number : kNotMet;
}

void sortPair(inout uint a, inout uint b) {
  uint least = min(a, b);
  b = max(a, b);
  a = least;
}

uint childOf(uvec4 children, uint key) {
  uint number = key & 3u;
  return number == 0u ? children.x : (number == 1u ? children.y : (number == 2u ? children.z : children.w));
}

void pushIfMet(uint key, uvec4 children, inout Walk walk) {
  if (key == kNotMet) return;
  stack_[min(walk.depth, int(kBvhStackSize) - 1)] = childOf(children, key);
  ++walk.depth;
}

void descendQuad(WalkRay w, inout Walk walk) {
  int at = int(4u * walk.next);
  uvec4 a = texelFetch(quadNodes, at);
  uvec4 b = texelFetch(quadNodes, at + 1);
  uvec4 c = texelFetch(quadNodes, at + 2);
  uvec4 children = texelFetch(quadNodes, at + 3);
  vec3 origin = uintBitsToFloat(a.xyz);
  vec3 scale = uintBitsToFloat((uvec3(a.w, a.w >> 8u, a.w >> 16u) & 255u) << 23u);
  uvec3 lower = b.xyz;
  uvec3 upper = uvec3(b.w, c.xy);
  uvec3 nearBytes = mix(lower, upper, w.negative);
  uvec3 farBytes = mix(upper, lower, w.negative);
  uint k0 = keyOf(children.x, 0u, planesOf(origin, scale, nearBytes, 0u), planesOf(origin, scale, farBytes, 0u), w);
  uint k1 = keyOf(children.y, 1u, planesOf(origin, scale, nearBytes, 1u), planesOf(origin, scale, farBytes, 1u), w);
  uint k2 = keyOf(children.z, 2u, planesOf(origin, scale, nearBytes, 2u), planesOf(origin, scale, farBytes, 2u), w);
  uint k3 = keyOf(children.w, 3u, planesOf(origin, scale, nearBytes, 3u), planesOf(origin, scale, farBytes, 3u), w);
  sortPair(k0, k1);
  sortPair(k2, k3);
  sortPair(k0, k2);
  sortPair(k1, k3);
  sortPair(k1, k2);
  pushIfMet(k3, children, walk);
  pushIfMet(k2, children, walk);
  pushIfMet(k1, children, walk);
  uint nearest = childOf(children, k0);
  if (k0 != kNotMet) walk.next = nearest;
  else popNext(walk);
}

HitRecord closestTriangleByQuads(Ray ray, bool cutBackFaces) {
  Closest best = Closest(kMiss, kNoId);
  if (!isValid(ray)) return kMiss;
  WalkRay w = walkRayOf(ray);
  RayShear shear = shearOf(ray.direction);
  Walk walk = Walk(0u, 0, 0u);
  do {
    w.ray.tMax = searchedTo(boundOf(best, ray));
    do {
      if (atInnerNode(walk)) descendQuad(w, walk);
      ++walk.steps;
    } while (atInnerNode(walk));
    considerLeaf(ray, shear, cutBackFaces, best, walk);
  } while (goesOn(walk));
  countCapped(walk);
  return best.hit;
}
#endif

// Walk of the BVH, one ray per lane: closest hit, and how much light passes between two points. Boxes widened by
// 2 gamma_3 (Ize 2013, "Robust BVH Ray Traversal", JCGT 2(2)), so that no triangle is lost to the boxes' rounding.
#ifndef CROSSLIGHT_BVH_GLSL
#define CROSSLIGHT_BVH_GLSL
#include "math/numeric.glsl"
#include "accel/triangle.glsl"
#include "accel/shape.glsl"

layout(set = 0, binding = kBindCounters, scalar) buffer CounterBlock { uint counters[]; };

struct Ray {
  vec3 origin;
  vec3 direction;
  float tMin;
  float tMax;
};

const HitRecord kMiss = HitRecord(0.0, kNoHit, 0.0, 0.0);
const uint kEmptyChild = kBvhLeaf;   // a leaf of no primitives
const uint kWalkDone = 0xfffffffeu;  // not a child: index bits beyond any list
const uint kLargestWalk = 60000u;    // Mesa 22.3 ends loops silently at 65,535 iterations: stop before, and count it

Ray rayOf(RayNode node) { return Ray(node.origin, node.direction, node.tMin, node.tMax); }

struct BoxTest {
  bool hit;
  float tNear;
};

// Sign-selected slabs with comparisons that NaN (0 * inf, a ray inside a face) leaves without effect.
BoxTest hitSlabs(vec3 lower, vec3 upper, Ray ray, vec3 inverse, bvec3 negative) {
  const float kWiden = 1.00000036;  // 1 + 2 gamma_3
  vec3 near = (mix(lower, upper, negative) - ray.origin) * inverse;
  vec3 far = (mix(upper, lower, negative) - ray.origin) * inverse * kWiden;
  float t0 = ray.tMin;
  float t1 = ray.tMax;
  t0 = near.x > t0 ? near.x : t0;
  t0 = near.y > t0 ? near.y : t0;
  t0 = near.z > t0 ? near.z : t0;
  t1 = far.x < t1 ? far.x : t1;
  t1 = far.y < t1 ? far.y : t1;
  t1 = far.z < t1 ? far.z : t1;
  return BoxTest(t0 <= t1, t0);
}

struct PrimitiveTexels {
  vec3 v0, v1, v2;
  uint id, drawId, flags;
};

PrimitiveTexels fetchPrimitive(uint slot) {
  uvec4 a = texelFetch(bvhPrimitives, int(3u * slot));
  uvec4 b = texelFetch(bvhPrimitives, int(3u * slot + 1u));
  uvec4 c = texelFetch(bvhPrimitives, int(3u * slot + 2u));
  return PrimitiveTexels(uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz), uintBitsToFloat(c.xyz), a.w, b.w, c.w);
}

ShapeHit hitShapeInstance(uint index, Ray ray) {
  ShapeRecord s = shapes[index];
  return hitShape(s.kind, s.params, s.objectFromRender * (ray.origin - s.renderCenter),
                  s.objectFromRender * ray.direction, ray.tMin, ray.tMax);
}

// What materials say of a surface that may be cut away or transparent; defined above this room (trace/passed_light.glsl).
// Share of light that passes: 0 blocks, 1 is not there.
float passedByTriangle(uint triangle, uint drawId, float b1, float b2);
float passedByShape(uint drawId, vec2 uv);
bool maskCutsTriangle(uint triangle, uint drawId, float b1, float b2);
bool isOneSided(uint drawId);

// Ties (coplanar duplicates) go to the lowest id, so the image does not depend on the tree.
bool isCloser(float t, uint id, float bestT, uint bestId) { return t < bestT || (t == bestT && id < bestId); }

struct Closest {
  HitRecord hit;
  uint id;
};

void considerPrimitive(uint slot, Ray ray, RayShear shear, bool cutBackFaces, inout Closest best) {
  PrimitiveTexels p = fetchPrimitive(slot);
  float tMax = best.hit.primitive == kNoHit ? ray.tMax : best.hit.t;
  if (CL_HAS(shapes) && (p.id & kPrimitiveIsShape) != 0u) {
    ShapeHit s = hitShapeInstance(p.id & ~kPrimitiveIsShape, Ray(ray.origin, ray.direction, ray.tMin, tMax));
    bool back = dot(s.n, shapes[p.id & ~kPrimitiveIsShape].objectFromRender * ray.direction) > 0.0;
    bool cut = cutBackFaces && back && (p.flags & kPrimitiveCutsBackFaces) != 0u;
    if (s.hit && !cut && isCloser(s.t, p.id, tMax, best.id))
      best = Closest(HitRecord(s.t, kHitShape | (p.id & ~kPrimitiveIsShape), 0.0, 0.0), p.id);
  } else {
    TriangleHit h = hitTriangle(ray.origin, shear, p.v0, p.v1, p.v2, ray.tMin, tMax);
    bool back = h.back != ((p.flags & kPrimitiveFlipsWinding) != 0u);
    bool cut = cutBackFaces && back && (p.flags & kPrimitiveCutsBackFaces) != 0u;
    if (h.hit && !cut && isCloser(h.t, p.id, tMax, best.id)) {
      bool masked = CL_HAS(alphaMask) && (p.flags & kPrimitiveMayPass) != 0u && maskCutsTriangle(p.id, p.drawId, h.b1, h.b2);
      if (!masked) best = Closest(HitRecord(h.t, slot, h.b1, h.b2), p.id);
    }
  }
}

void considerUnboundedShapes(Ray ray, bool cutBackFaces, inout Closest best) {
  for (uint i = 0u; i < frame.unboundedShapeCount; ++i) {
    float tMax = best.hit.primitive == kNoHit ? ray.tMax : best.hit.t;
    ShapeHit s = hitShapeInstance(i, Ray(ray.origin, ray.direction, ray.tMin, tMax));
    uint id = kPrimitiveIsShape | i;
    bool cut = cutBackFaces && isOneSided(shapes[i].drawId) && dot(s.n, shapes[i].objectFromRender * ray.direction) > 0.0;
    if (s.hit && !cut && isCloser(s.t, id, tMax, best.id)) best = Closest(HitRecord(s.t, kHitShape | i, 0.0, 0.0), id);
  }
}

// The state of a walk: which child is next, and what waits.
struct Walk {
  uint next;
  int depth;
  uint steps;
};

uint stack_[kBvhStackSize];

void popNext(inout Walk walk) {
  bool empty = walk.depth == 0;
  walk.depth = max(walk.depth - 1, 0);
  walk.next = empty ? kWalkDone : stack_[walk.depth];
}

// Tests both children of an inner node and goes to the nearer one; the other waits.
void descend(Ray ray, vec3 inverse, bvec3 negative, inout Walk walk) {
  int at = int(4u * walk.next);
  uvec4 a = texelFetch(bvhNodes, at);
  uvec4 b = texelFetch(bvhNodes, at + 1);
  uvec4 c = texelFetch(bvhNodes, at + 2);
  uvec4 d = texelFetch(bvhNodes, at + 3);
  BoxTest first = hitSlabs(uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz), ray, inverse, negative);
  BoxTest second = hitSlabs(uintBitsToFloat(c.xyz), uintBitsToFloat(d.xyz), ray, inverse, negative);
  bool hit0 = first.hit && a.w != kEmptyChild;
  bool hit1 = second.hit && b.w != kEmptyChild;
  bool swap = hit1 && (!hit0 || second.tNear < first.tNear);
  uint nearer = swap ? b.w : a.w;
  uint farther = swap ? a.w : b.w;
  if (hit0 && hit1) {
    stack_[min(walk.depth, int(kBvhStackSize) - 1)] = farther;
    ++walk.depth;
  }
  if (hit0 || hit1) walk.next = nearer;
  else popNext(walk);
}

HitRecord closestHit(Ray ray, bool cutBackFaces) {
  Closest best = Closest(kMiss, kNoId);
  bool valid = isFinite3(ray.origin) && isFinite3(ray.direction) && dot(abs(ray.direction), vec3(1.0)) > 0.0;
  if (!valid) return kMiss;
  if (CL_HAS(shapes)) considerUnboundedShapes(ray, cutBackFaces, best);
  RayShear shear = shearOf(ray.direction);
  vec3 inverse = 1.0 / ray.direction;
  bvec3 negative = lessThan(inverse, vec3(0.0));
  Walk walk = Walk(0u, 0, 0u);
  Ray clipped = ray;
  while (walk.next != kWalkDone && walk.steps < kLargestWalk) {
    while ((walk.next & kBvhLeaf) == 0u && walk.steps < kLargestWalk) {
      clipped.tMax = best.hit.primitive == kNoHit ? ray.tMax : best.hit.t;
      descend(clipped, inverse, negative, walk);
      ++walk.steps;
    }
    uint count = walk.next == kWalkDone ? 0u : (walk.next >> kBvhCountShift) & 15u;
    uint firstSlot = walk.next & kBvhFirstMask;
    for (uint i = 0u; i < count; ++i) considerPrimitive(firstSlot + i, ray, shear, cutBackFaces, best);
    walk.steps += count;
    if (walk.next != kWalkDone) popNext(walk);
  }
  if (walk.steps >= kLargestWalk) atomicAdd(counters[kCounterCapped], 1u);
  return best.hit;
}

float passedByPrimitive(uint slot, Ray ray, RayShear shear) {
  PrimitiveTexels p = fetchPrimitive(slot);
  bool mayPass = (p.flags & kPrimitiveMayPass) != 0u;
  if (CL_HAS(shapes) && (p.id & kPrimitiveIsShape) != 0u) {
    ShapeHit s = hitShapeInstance(p.id & ~kPrimitiveIsShape, ray);
    float passed = mayPass ? passedByShape(p.drawId, s.uv) : 0.0;
    return s.hit ? passed : 1.0;
  }
  TriangleHit h = hitTriangle(ray.origin, shear, p.v0, p.v1, p.v2, ray.tMin, ray.tMax);
  float passed = 0.0;
  if ((CL_HAS(alphaMask) || CL_HAS(transparency)) && mayPass && h.hit) passed = passedByTriangle(p.id, p.drawId, h.b1, h.b2);
  return h.hit ? passed : 1.0;
}

// Share of light that travels the whole ray: the product over all surfaces in between. Transparent shadows have no
// color and no refraction: what passes goes straight on.
float lightPassed(Ray ray) {
  float passed = 1.0;
  if (CL_HAS(shapes)) {
    for (uint i = 0u; i < frame.unboundedShapeCount; ++i) {
      ShapeHit s = hitShapeInstance(i, ray);
      if (s.hit) passed *= passedByShape(shapes[i].drawId, s.uv);
    }
  }
  RayShear shear = shearOf(ray.direction);
  vec3 inverse = 1.0 / ray.direction;
  bvec3 negative = lessThan(inverse, vec3(0.0));
  Walk walk = Walk(0u, 0, 0u);
  while (walk.next != kWalkDone && walk.steps < kLargestWalk) {
    while ((walk.next & kBvhLeaf) == 0u && walk.steps < kLargestWalk) {
      descend(ray, inverse, negative, walk);
      ++walk.steps;
    }
    uint count = walk.next == kWalkDone ? 0u : (walk.next >> kBvhCountShift) & 15u;
    uint firstSlot = walk.next & kBvhFirstMask;
    for (uint i = 0u; i < count; ++i) passed *= passedByPrimitive(firstSlot + i, ray, shear);
    walk.steps += count;
    if (walk.next != kWalkDone) popNext(walk);
    if (passed == 0.0) walk.next = kWalkDone;
  }
  if (walk.steps >= kLargestWalk) atomicAdd(counters[kCounterCapped], 1u);
  return passed;
}
#endif

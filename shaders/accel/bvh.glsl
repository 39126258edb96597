// Walk of the BVH, one ray per lane: closest hit, and how much light passes between two points. Boxes widened by
// 2 gamma_3 (Ize 2013, "Robust BVH Ray Traversal", JCGT 2(2)), so that no triangle is lost to the boxes' rounding.
#ifndef CROSSLIGHT_BVH_GLSL
#define CROSSLIGHT_BVH_GLSL
#include "math/numeric.glsl"
#include "accel/ray.glsl"
#include "accel/triangle.glsl"
#include "accel/shape.glsl"

layout(set = 0, binding = kBindCounters, scalar) buffer CounterBlock { uint counters[]; };

const HitRecord kMiss = HitRecord(0.0, kNoHit, 0.0, 0.0);
const uint kEmptyChild = kBvhLeaf;   // a leaf of no primitives
const uint kWalkDone = 0xfffffffeu;  // not a child: index bits beyond any list
const uint kLargestWalk = 60000u;    // Mesa 22.3 ends loops silently at 65,535 iterations: stop before, and count it

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

// A shape's own coordinates and the scene's; where no shape is turned or scaled they differ by its center alone. The
// zero makes -0 into 0, as the product with a matrix does.
vec3 objectVector(ShapeRecord s, vec3 v) { return CL_HAS(turnedShapes) ? s.objectFromRender * v : v + 0.0; }
vec3 renderVector(ShapeRecord s, vec3 v) { return CL_HAS(turnedShapes) ? s.renderFromObject * v : v + 0.0; }
// Normals go by the transpose of the inverse; cofactors are that up to a positive factor and the determinant's sign.
vec3 renderNormal(ShapeRecord s, vec3 n) { return CL_HAS(turnedShapes) ? n * s.objectFromRender : n + 0.0; }

ShapeHit hitShapeInstance(ShapeRecord s, Ray ray) {
  return hitShape(s.kind, s.params, objectVector(s, ray.origin - s.renderCenter), objectVector(s, ray.direction),
                  ray.tMin, ray.tMax);
}

// What materials say of a surface that may be cut away or transparent; defined above this room (trace/passed_light.glsl).
// Share of light that passes: 0 blocks, 1 is not there.
float passedByTriangle(uint triangle, uint drawId, float b1, float b2);
float passedByShape(uint drawId, vec2 uv);
bool maskCutsTriangle(uint triangle, uint drawId, float b1, float b2);
bool isOneSided(uint drawId);

// Shapes without bounds stand outside of the tree, first in the list. Planes are the only ones (the host checks), so the
// other kinds' code is not inlined once more here.
ShapeHit hitUnboundedShape(ShapeRecord s, Ray ray) {
  return hitPlane(s.params, objectVector(s, ray.origin - s.renderCenter), objectVector(s, ray.direction), ray.tMin,
                  ray.tMax);
}

// Ties (coplanar duplicates) go to the lowest id, so the image does not depend on the tree.
bool isCloser(float t, uint id, float bestT, uint bestId) { return t < bestT || (t == bestT && id < bestId); }

uint shapeInSlot(uint slot) { return texelFetch(bvhPrimitives, int(3u * slot)).w & ~kPrimitiveIsShape; }

struct Closest {
  HitRecord hit;
  uint id;
};

float boundOf(Closest best, Ray ray) { return best.hit.primitive == kNoHit ? ray.tMax : best.hit.t; }

void considerFetched(PrimitiveTexels p, uint slot, Ray ray, RayShear shear, bool cutBackFaces, inout Closest best) {
  float tMax = boundOf(best, ray);
  TriangleHit h = hitTriangle(ray.origin, shear, p.v0, p.v1, p.v2, ray.tMin, tMax);
  bool back = h.back != ((p.flags & kPrimitiveFlipsWinding) != 0u);
  bool cut = cutBackFaces && back && (p.flags & kPrimitiveCutsBackFaces) != 0u;
  bool closer = h.hit && slot != ray.from && !cut && isCloser(h.t, p.id, tMax, best.id);
  if (CL_HAS(alphaMask) && closer && (p.flags & kPrimitiveMayPass) != 0u)
    closer = !maskCutsTriangle(p.id, p.drawId, h.b1, h.b2);
  if (closer) best = Closest(HitRecord(h.t, slot, h.b1, h.b2), p.id);
}

void considerTriangle(uint slot, Ray ray, RayShear shear, bool cutBackFaces, inout Closest best) {
  considerFetched(fetchPrimitive(slot), slot, ray, shear, cutBackFaces, best);
}

void considerShapeHit(ShapeRecord s, ShapeHit h, uint shape, Ray ray, bool cutBackFaces, inout Closest best) {
  uint id = kPrimitiveIsShape | shape;
  bool cuts = cutBackFaces && frame.twoSided == 0u && (s.flags & kPrimitiveCutsBackFaces) != 0u;
  bool cut = cuts && dot(h.n, objectVector(s, ray.direction)) > 0.0;
  bool closer = h.hit && !cut && isCloser(h.t, id, boundOf(best, ray), best.id);
  if (closer) best = Closest(HitRecord(h.t, kHitShape | shape, 0.0, 0.0), id);
}

Ray endingAt(Ray ray, float tMax) { return Ray(ray.origin, ray.direction, ray.tMin, tMax, ray.from); }

void considerShape(uint shape, Ray ray, bool cutBackFaces, inout Closest best) {
  ShapeRecord s = shapeOf(shape);
  considerShapeHit(s, hitShapeInstance(s, endingAt(ray, boundOf(best, ray))), shape, ray, cutBackFaces, best);
}

void considerUnboundedShapes(Ray ray, bool cutBackFaces, inout Closest best) {
  for (uint i = 0u; i < frame.unboundedShapeCount; ++i) {
    ShapeRecord s = shapeOf(i);
    considerShapeHit(s, hitUnboundedShape(s, endingAt(ray, boundOf(best, ray))), i, ray, cutBackFaces, best);
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

// A ray with what every box test needs of it.
struct WalkRay {
  Ray ray;
  vec3 inverse;
  bvec3 negative;
};

WalkRay walkRayOf(Ray ray) {
  vec3 inverse = 1.0 / ray.direction;
  return WalkRay(ray, inverse, lessThan(inverse, vec3(0.0)));
}

bool atInnerNode(Walk walk) { return (walk.next & kBvhLeaf) == 0u && walk.steps < kLargestWalk; }

// Goes down from walk.next until a leaf, or the walk's end, is next. Loops test at their end: llvmpipe runs a body once
// more before it notices that a loop is over.
void walkToLeaf(WalkRay w, float tMax, inout Walk walk) {
  w.ray.tMax = tMax;
  do {
    if (atInnerNode(walk)) descend(w.ray, w.inverse, w.negative, walk);
    ++walk.steps;
  } while (atInnerNode(walk));
}

uint leafCount(Walk walk) { return walk.next == kWalkDone ? 0u : (walk.next >> kBvhCountShift) & 15u; }

void leaveLeaf(uint count, inout Walk walk) {
  walk.steps += count;
  if (walk.next != kWalkDone) popNext(walk);
}

bool goesOn(Walk walk) { return walk.next != kWalkDone && walk.steps < kLargestWalk; }

void countCapped(Walk walk) {
  if (walk.steps >= kLargestWalk) atomicAdd(counters[kCounterCapped], 1u);
}

// Boxes are searched to a little behind the nearest hit: of triangles that meet in an edge or lie in one plane, one may
// be nearer than another, or of a lower id, while the box's distance rounds to beyond the other's. A box's is off by
// gamma_3, a triangle's by gamma_16 unless it is seen along its edge. Without it the tree decides who is seen.
float searchedTo(float bound) { return bound * 1.0000012; }  // 1 + 20 * 2^-24

bool isValid(Ray ray) {
  return isFinite3(ray.origin) && isFinite3(ray.direction) && dot(abs(ray.direction), vec3(1.0)) > 0.0;
}

// Tests the triangles of the leaf that is next, none at the walk's end, and takes what waits.
void considerLeaf(Ray ray, RayShear shear, bool cutBackFaces, inout Closest best, inout Walk walk) {
  uint count = leafCount(walk);
  uint slot = walk.next & kBvhFirstMask;
  uint end = slot + count;
  do {
    if (slot < end) considerTriangle(slot, ray, shear, cutBackFaces, best);
    ++slot;
  } while (slot < end);
  leaveLeaf(count, walk);
}

float lightPassedFetched(PrimitiveTexels p, uint slot, Ray ray, RayShear shear) {
  TriangleHit h = hitTriangle(ray.origin, shear, p.v0, p.v1, p.v2, ray.tMin, ray.tMax);
  float passed = 0.0;
  if ((CL_HAS(alphaMask) || CL_HAS(transparency)) && (p.flags & kPrimitiveMayPass) != 0u && h.hit)
    passed = passedByTriangle(p.id, p.drawId, h.b1, h.b2);
  return h.hit && slot != ray.from ? passed : 1.0;
}

#include "accel/instances.glsl"

// Triangles and shapes have a tree each: devices that run both sides of every branch would else pay for all shapes'
// equations at every triangle.
HitRecord closestTriangle(Ray ray, bool cutBackFaces) {
  Closest best = Closest(kMiss, kNoId);
  if (!isValid(ray)) return kMiss;
  if (kInstances) return closestOfInstances(ray, cutBackFaces);
  WalkRay w = walkRayOf(ray);
  RayShear shear = shearOf(ray.direction);
  Walk walk = Walk(0u, 0, 0u);
  do {
    walkToLeaf(w, searchedTo(boundOf(best, ray)), walk);
    considerLeaf(ray, shear, cutBackFaces, best, walk);
  } while (goesOn(walk));
  countCapped(walk);
  return best.hit;
}

// Nearest shape, or the triangle met so far where no shape is nearer; of a triangle and a shape that are equally near,
// the triangle counts (ids of shapes are greater).
HitRecord closestShape(Ray ray, bool cutBackFaces, HitRecord sofar) {
  Closest best = Closest(sofar, sofar.primitive == kNoHit ? kNoId : 0u);
  if (!isValid(ray)) return sofar;
  considerUnboundedShapes(ray, cutBackFaces, best);
  WalkRay w = walkRayOf(ray);
  Walk walk = Walk(frame.shapeRoot, 0, 0u);
  do {
    walkToLeaf(w, boundOf(best, ray), walk);
    uint count = leafCount(walk);
    uint slot = walk.next & kBvhFirstMask;
    uint end = slot + count;
    do {
      if (slot < end) considerShape(shapeInSlot(slot), ray, cutBackFaces, best);
      ++slot;
    } while (slot < end);
    leaveLeaf(count, walk);
  } while (goesOn(walk));
  countCapped(walk);
  return best.hit;
}

float lightPassedTriangle(uint slot, Ray ray, RayShear shear) {
  return lightPassedFetched(fetchPrimitive(slot), slot, ray, shear);
}

bool mayPass(ShapeRecord s) {
  return (CL_HAS(alphaMask) || CL_HAS(transparency)) && (s.flags & kPrimitiveMayPass) != 0u;
}

float lightPassedShape(uint shape, Ray ray) {
  ShapeRecord s = shapeOf(shape);
  ShapeHit h = hitShapeInstance(s, ray);
  float passed = 0.0;
  if (mayPass(s)) passed = passedByShape(s.drawId, h.uv);
  return h.hit ? passed : 1.0;
}

float lightPassedUnbounded(Ray ray) {
  float passed = 1.0;
  for (uint i = 0u; i < frame.unboundedShapeCount; ++i) {
    ShapeRecord shape = shapeOf(i);
    ShapeHit h = hitUnboundedShape(shape, ray);
    float through = 0.0;
    if (mayPass(shape)) through = passedByShape(shape.drawId, h.uv);
    if (h.hit) passed *= through;
  }
  return passed;
}

// Share of light that travels the whole ray: the product over all surfaces in between. Transparent shadows have no
// color and no refraction: what passes goes straight on.
float lightPassedTriangles(Ray ray) {
  float passed = 1.0;
  WalkRay w = walkRayOf(ray);
  RayShear shear = shearOf(ray.direction);
  if (kInstances) return lightPassedInstances(ray);
  Walk walk = Walk(0u, 0, 0u);
  do {
    walkToLeaf(w, ray.tMax, walk);
    uint count = leafCount(walk);
    uint slot = walk.next & kBvhFirstMask;
    uint end = slot + count;
    do {
      if (slot < end) passed *= lightPassedTriangle(slot, ray, shear);
      ++slot;
    } while (slot < end);
    leaveLeaf(count, walk);
    if (passed == 0.0) walk.next = kWalkDone;
  } while (goesOn(walk));
  countCapped(walk);
  return passed;
}

// `passed`: what triangles leave.
float lightPassedShapesByTree(Ray ray, float passed) {
  passed *= lightPassedUnbounded(ray);
  WalkRay w = walkRayOf(ray);
  Walk walk = Walk(passed == 0.0 ? kWalkDone : frame.shapeRoot, 0, 0u);
  do {
    walkToLeaf(w, ray.tMax, walk);
    uint count = leafCount(walk);
    uint slot = walk.next & kBvhFirstMask;
    uint end = slot + count;
    do {
      if (slot < end) passed *= lightPassedShape(shapeInSlot(slot), ray);
      ++slot;
    } while (slot < end);
    leaveLeaf(count, walk);
    if (passed == 0.0) walk.next = kWalkDone;
  } while (goesOn(walk));
  countCapped(walk);
  return passed;
}
#endif

// Walk of the BVH, one ray per lane: closest hit, and how much light passes between two points. Boxes widened by
// 2 gamma_3 (Ize 2013, "Robust BVH Ray Traversal", JCGT 2(2)), so that no triangle is lost to the boxes' rounding.
#ifndef CROSSLIGHT_BVH_GLSL
#define CROSSLIGHT_BVH_GLSL
#include "math/numeric.glsl"
#include "accel/ray.glsl"
#include "accel/triangle.glsl"

layout(set = 0, binding = kBindCounters, scalar) buffer CounterBlock { uint counters[]; };

// What a ray leaves and cannot meet: a slot of the tree, unless the includer knows its surface by another name.
#ifndef CL_IS_LEFT
#define CL_IS_LEFT(p, slot, ray) ((slot) == (ray).from)
#endif
// Loop passes that the invocation has spent on walks before this one: drivers' limits are of all together.
#ifndef CL_STEPS_BEFORE
#define CL_STEPS_BEFORE 0u
#define CL_STEPS_AFTER(steps)
#endif

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

// What materials say of a surface that may be cut away or transparent; defined above this room (shade/passed_light.glsl).
// Share of light that passes: 0 blocks, 1 is not there.
float passedByTriangle(uint triangle, uint drawId, float b1, float b2);
float passedByShape(uint drawId, vec2 uv);
// Shadows in color: every crossing of a surface that lets light pass counts; `leaves`: the ray meets its back.
bool countsCrossings();
void noteCrossing(uint drawId, bool leaves, Ray ray, float t);
bool maskCutsTriangle(uint triangle, uint drawId, float b1, float b2);

// Ties (coplanar duplicates) go to the lowest id, so the image does not depend on the tree.
bool isCloser(float t, uint id, float bestT, uint bestId) { return t < bestT || (t == bestT && id < bestId); }

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
  bool closer = h.hit && !CL_IS_LEFT(p, slot, ray) && !cut && isCloser(h.t, p.id, tMax, best.id);
  if (CL_HAS(alphaMask) && closer && (p.flags & kPrimitiveMayPass) != 0u)
    closer = !maskCutsTriangle(p.id, p.drawId, h.b1, h.b2);
  if (closer) best = Closest(HitRecord(h.t, slot, h.b1, h.b2), p.id);
}

void considerTriangle(uint slot, Ray ray, RayShear shear, bool cutBackFaces, inout Closest best) {
  considerFetched(fetchPrimitive(slot), slot, ray, shear, cutBackFaces, best);
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
  if ((CL_HAS(alphaMask) || CL_HAS(transparency)) && (p.flags & kPrimitiveMayPass) != 0u && h.hit) {
    passed = passedByTriangle(p.id, p.drawId, h.b1, h.b2);
    if (countsCrossings() && !CL_IS_LEFT(p, slot, ray))
      noteCrossing(p.drawId, h.back != ((p.flags & kPrimitiveFlipsWinding) != 0u), ray, h.t);
  }
  return h.hit && !CL_IS_LEFT(p, slot, ray) ? passed : 1.0;
}

#include "accel/instances.glsl"
#ifdef CL_RAY_QUERY
#include "accel/ray_query.glsl"
#endif

// Triangles and shapes have a tree each: devices that run both sides of every branch would else pay for all shapes'
// equations at every triangle.
HitRecord closestTriangle(Ray ray, bool cutBackFaces) {
  Closest best = Closest(kMiss, kNoId);
  if (!isValid(ray)) return kMiss;
#ifdef CL_RAY_QUERY
  return closestByQuery(ray, cutBackFaces);
#endif
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

float lightPassedTriangle(uint slot, Ray ray, RayShear shear) {
  return lightPassedFetched(fetchPrimitive(slot), slot, ray, shear);
}

// Share of light that travels the whole ray: the product over all surfaces in between. Transparent shadows have no
// color and no refraction: what passes goes straight on.
float lightPassedTriangles(Ray ray) {
#ifdef CL_RAY_QUERY
  return lightPassedByQuery(ray);
#endif
  float passed = 1.0;
  WalkRay w = walkRayOf(ray);
  RayShear shear = shearOf(ray.direction);
  if (kInstances) return lightPassedInstances(ray);
  Walk walk = Walk(0u, 0, CL_STEPS_BEFORE);
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
  CL_STEPS_AFTER(walk.steps);
  return passed;
}

#include "accel/bvh_shapes.glsl"
#endif

// Walk of the BVH by an interval packet: one subgroup carries its rays as one interval of origins and reciprocal
// directions; a lane tests one child of an eight-wide node against it, so that a node costs the same whatever the
// number of rays (Wald, Boulos, Shirley 2007, "Ray Tracing Deformable Scenes Using Dynamic Bounding Volume Hierarchies",
// ACM TOG 26(1), 3.3). Rays are touched at leaves only. Hits are those of bvh.glsl, bit for bit: rounding is monotone,
// so the interval's distances enclose those of each ray, and the triangle's test is the same.
#ifndef CROSSLIGHT_INTERVAL_GLSL
#define CROSSLIGHT_INTERVAL_GLSL
#include "accel/packet.glsl"

const uint kNothing = 0xffffffffu;
CL_LANE_STACK(nodes, kWideDepth / kLanes)

// Per ray of this lane.
vec3 origins_[kRaysPerLane];
vec3 shears_[kRaysPerLane];
vec3 inverses_[kRaysPerLane];
uint classes_[kRaysPerLane];  // kNoClass: not a ray
float starts_[kRaysPerLane];
float bounds_[kRaysPerLane];  // nearest t so far, or how far the ray goes
bool active_[kRaysPerLane];
Closest bests_[kRaysPerLane];

// What the walk knows of the rays that go together. All share the origin zero when `CL_ORIGIN_ZERO` holds.
struct Interval {
  vec3 nearOrigin, farOrigin;    // those by which a near plane is nearest and a far plane farthest
  vec3 lowInverse, highInverse;  // ends of the interval of reciprocal directions
  bvec3 negative;
  float tMin;
  uint axis;
};

struct WideWalk {
  uint node;     // whose children `key` and `child` speak of
  uint key;      // of this lane's child: the bits of its distance, the lane in the lowest three; kNothing: not to visit
  uint child;    // of this lane
  uint next;     // child to go on with
  uint pending;  // lanes whose children count when `node` is tested next
  uint depth;
  uint steps;
};

void testChildren(Interval packet, float bound, inout WideWalk walk) {
  const float kWiden = 1.00000036;  // 1 + 2 gamma_3
  int at = int(16u * walk.node + 2u * lane());
  uvec4 a = texelFetch(wideNodes, at);
  uvec4 b = texelFetch(wideNodes, at + 1);
  vec3 lower = planesBeyond(uintBitsToFloat(a.xyz), -1.0), upper = planesBeyond(uintBitsToFloat(b.xyz), 1.0);
  vec3 nearBy = mix(lower, upper, packet.negative) - packet.nearOrigin;
  vec3 farBy = mix(upper, lower, packet.negative) - packet.farOrigin;
  vec3 near = smaller(nearBy * packet.lowInverse, nearBy * packet.highInverse);
  vec3 far = greater(farBy * packet.lowInverse, farBy * packet.highInverse);
  float t0 = greater(greater(near.x, near.y), greater(near.z, packet.tMin));
  float t1 = smaller(smaller(far.x, far.y), far.z) * kWiden;
  bool meets = t0 <= smaller(t1, bound) && a.w != kEmptyChild && ((walk.pending >> lane()) & 1u) != 0u;
  walk.key = meets ? (floatBitsToUint(greater(t0, 0.0)) & ~7u) | lane() : kNothing;
  walk.child = a.w;
}

// Takes the nearest child that is left. An inner one becomes the node to test, and what is left waits on the stack; when
// none is left, the node on top of the stack is tested once more, against what was found in the meantime.
void takeNearest(inout WideWalk walk) {
  uint nearest = minOverLanes(walk.key);
  bool none = nearest == kNothing;
  uint child = fromLane(walk.child, nearest & 7u);
  walk.key = walk.key == nearest ? kNothing : walk.key;
  bool inner = !none && (child & kBvhLeaf) == 0u;
  uint left = orOverLanes(walk.key != kNothing ? 1u << lane() : 0u);
  uint top = nodesTop(walk.depth);
  bool pops = none && walk.depth > 0u;
  walk.depth -= pops ? 1u : 0u;
  nodesPush((walk.node << 8u) | left, inner && left != 0u, walk.depth);
  walk.next = none ? (pops ? top >> 8u : kWalkDone) : child;
  walk.node = inner ? child : (pops ? top >> 8u : walk.node);
  walk.pending = inner ? 0xffu : top & 0xffu;
}

void considerForInterval(uint slot, bool there, bool cutBackFaces, uint axis) {
  PrimitiveTexels p = sharedPrimitive(slot);
  vec3 v0 = rotateToLast(p.v0, axis), v1 = rotateToLast(p.v1, axis), v2 = rotateToLast(p.v2, axis);
  bool flips = (p.flags & kPrimitiveFlipsWinding) != 0u;
  bool cuts = cutBackFaces && (p.flags & kPrimitiveCutsBackFaces) != 0u;
  [[unroll]] for (int k = 0; k < kRaysPerLane; ++k) {
    vec3 o = CL_ORIGIN_ZERO ? vec3(0.0) : rotateToLast(origins_[k], axis);
    TriangleHit h = hitRotated(v0 - o, v1 - o, v2 - o, shears_[k], starts_[k], bounds_[k]);
    bool cut = cuts && h.back != flips;
    bool closer = there && active_[k] && h.hit && !cut && isCloser(h.t, p.id, bounds_[k], bests_[k].id);
    if (CL_HAS(alphaMask) && closer && (p.flags & kPrimitiveMayPass) != 0u)
      closer = !maskCutsTriangle(p.id, p.drawId, h.b1, h.b2);
    bounds_[k] = closer ? h.t : bounds_[k];
    bests_[k].hit.primitive = closer ? slot : bests_[k].hit.primitive;
    bests_[k].hit.b1 = closer ? h.b1 : bests_[k].hit.b1;
    bests_[k].hit.b2 = closer ? h.b2 : bests_[k].hit.b2;
    bests_[k].id = closer ? p.id : bests_[k].id;
  }
}

float farthestBound() {
  float bound = -kLargest;
  [[unroll]] for (int k = 0; k < kRaysPerLane; ++k) bound = greater(bound, active_[k] ? bounds_[k] : -kLargest);
  return searchedTo(maxOverLanes(bound));
}

// Activates the rays of one class.
Interval intervalOfClass(uint which) {
  vec3 lowOrigin = vec3(kLargest), highOrigin = vec3(-kLargest), low = vec3(kLargest), high = vec3(-kLargest);
  float tMin = kLargest;
  [[unroll]] for (int k = 0; k < kRaysPerLane; ++k) {
    active_[k] = classes_[k] == which;
    lowOrigin = active_[k] ? smaller(lowOrigin, origins_[k]) : lowOrigin;
    highOrigin = active_[k] ? greater(highOrigin, origins_[k]) : highOrigin;
    low = active_[k] ? smaller(low, inverses_[k]) : low;
    high = active_[k] ? greater(high, inverses_[k]) : high;
    tMin = active_[k] ? smaller(tMin, starts_[k]) : tMin;
  }
  lowOrigin = CL_ORIGIN_ZERO ? vec3(0.0) : minOverLanes(lowOrigin);
  highOrigin = CL_ORIGIN_ZERO ? vec3(0.0) : maxOverLanes(highOrigin);
  bvec3 negative = negativeBy(which & 7u);
  return Interval(mix(highOrigin, lowOrigin, negative), mix(lowOrigin, highOrigin, negative), minOverLanes(low),
                  maxOverLanes(high), negative, minOverLanes(tMin), which >> 3u);
}

uint lowestClassFrom(uint first) {
  uint lowest = kNoClass;
  [[unroll]] for (int k = 0; k < kRaysPerLane; ++k) lowest = classes_[k] >= first ? min(lowest, classes_[k]) : lowest;
  return minOverLanes(lowest);
}

void startRay(int k, Ray ray) {
  RayShear shear = shearOf(ray.direction);
  origins_[k] = ray.origin;
  shears_[k] = shear.shear;
  inverses_[k] = finiteInverse(ray.direction);
  classes_[k] = ray.tMax >= ray.tMin ? rayClass(shear, inverses_[k]) : kNoClass;
  starts_[k] = ray.tMin;
  bounds_[k] = ray.tMax;
  bests_[k] = Closest(kMiss, kNoId);
}

// Of this lane's first ray; the others move up, so that the loop that writes them out stands in the code once: a store
// is four loops of llvmpipe, and eight stores were a sixth of the time that the kernel took to compile.
HitRecord takeFound() {
  HitRecord hit = bests_[0].hit;
  hit.t = hit.primitive == kNoHit ? 0.0 : bounds_[0];
  [[unroll]] for (int k = 0; k + 1 < kRaysPerLane; ++k) {
    bests_[k].hit = bests_[k + 1].hit;
    bounds_[k] = bounds_[k + 1];
  }
  return hit;
}

// Tests the primitives of the leaf that is next, then takes the next child.
void walkLeaf(bool cutBackFaces, uint axis, inout float bound, inout WideWalk walk) {
  bool leaf = walk.next != kWalkDone;
  uint slot = leaf ? walk.next & kBvhFirstMask : 0u;
  uint count = leaf ? (walk.next >> kBvhCountShift) & 15u : 0u;
  do {
    considerForInterval(slot, count != 0u, cutBackFaces, axis);
    slot += 1u;
    count -= min(count, 1u);
    ++walk.steps;
  } while (count != 0u);
  bound = farthestBound();
  walk.key = walk.key != kNothing && uintBitsToFloat(walk.key & ~7u) > bound ? kNothing : walk.key;
  if (leaf) takeNearest(walk);
}

// Closest triangles of the rays that were started, class by class: a packet of one class, as nearly all are, goes once.
// False: it gave up.
bool closestForInterval(bool cutBackFaces) {
  nodesClear();
  uint which = lowestClassFrom(0u);
  uint steps = 0u;
  do {
    Interval packet = intervalOfClass(which);
    WideWalk walk = WideWalk(0u, kNothing, 0u, 0u, 0xffu, 0u, steps);
    float bound = farthestBound();
    do {
      do {
        testChildren(packet, bound, walk);
        takeNearest(walk);
        ++walk.steps;
      } while ((walk.next & kBvhLeaf) == 0u && walk.steps < kPacketSteps);
      do {
        walkLeaf(cutBackFaces, packet.axis, bound, walk);
      } while (isLeafChild(walk.next) && walk.steps < kPacketSteps);
    } while (walk.next != kWalkDone && walk.steps < kPacketSteps);
    steps = walk.steps;
    which = lowestClassFrom(which + 1u);
  } while (which != kNoClass && steps < kPacketSteps);
  return steps < kPacketSteps;
}
#endif

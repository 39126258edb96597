// Is anything in the way? A packet of shadow rays walks the binary tree together; who has met something leaves it. For
// scenes in which nothing lets light pass: there the first hit is the answer. The answers are those of bvh.glsl.
#ifndef CROSSLIGHT_PACKET_OCCLUDED_GLSL
#define CROSSLIGHT_PACKET_OCCLUDED_GLSL
#include "accel/packet.glsl"

CL_LANE_STACK(waiting, kBvhStackSize / kLanes)

// Per ray of this lane. All begin at t = 0.
Ray rays_[kRaysPerLane];
vec3 inverses_[kRaysPerLane];
vec3 shears_[kRaysPerLane];
uint classes_[kRaysPerLane];  // kNoClass: not a ray
float ends_[kRaysPerLane];    // of what is left to search, while its class walks: below zero when there is nothing
bool blocked_[kRaysPerLane];

struct PacketWalk {
  uint next;
  uint depth;
  uint steps;
};

bool entersBox(vec3 nearPlanes, vec3 farPlanes, int k) {
  const float kWiden = 1.00000036;  // 1 + 2 gamma_3
  vec3 near = (nearPlanes - rays_[k].origin) * inverses_[k];
  vec3 far = (farPlanes - rays_[k].origin) * inverses_[k];
  float t0 = greater(greater(near.x, near.y), greater(near.z, 0.0));
  float t1 = smaller(smaller(far.x, far.y), far.z) * kWiden;
  return t0 <= smaller(t1, ends_[k]);
}

// Both children of an inner node. Lanes 0 and 1 hold the first child's corners, 2 and 3 the second's.
void descendPacket(uint signs, inout PacketWalk walk) {
  uvec4 texel = texelFetch(bvhNodes, int(4u * walk.next + (lane() & 3u)));
  texel.xyz = floatBitsToUint(planesBeyond(uintBitsToFloat(texel.xyz), (lane() & 1u) != 0u ? 1.0 : -1.0));
  bvec3 negative = negativeBy(signs);
  vec3 lower0 = vectorFromLane(texel, 0u), upper0 = vectorFromLane(texel, 1u);
  vec3 lower1 = vectorFromLane(texel, 2u), upper1 = vectorFromLane(texel, 3u);
  vec3 near0 = mix(lower0, upper0, negative), far0 = mix(upper0, lower0, negative);
  vec3 near1 = mix(lower1, upper1, negative), far1 = mix(upper1, lower1, negative);
  uint meets = 0u;
  [[unroll]] for (int k = 0; k < kRaysPerLane; ++k) {
    meets |= entersBox(near0, far0, k) ? 1u : 0u;
    meets |= entersBox(near1, far1, k) ? 2u : 0u;
  }
  meets = orOverLanes(meets);
  uint child0 = fromLane(texel.w, 0u), child1 = fromLane(texel.w, 1u), axis = fromLane(texel.w, 2u);
  meets &= (child0 != kEmptyChild ? 1u : 0u) | (child1 != kEmptyChild ? 2u : 0u);
  bool swap = ((signs >> axis) & 1u) != 0u;
  bool both = meets == 3u;
  bool pops = meets == 0u && walk.depth > 0u;
  uint top = waitingTop(walk.depth);
  uint nearer = both ? (swap ? child1 : child0) : (meets == 1u ? child0 : child1);
  walk.next = meets != 0u ? nearer : (pops ? top : kWalkDone);
  walk.depth -= pops ? 1u : 0u;
  waitingPush(swap ? child0 : child1, both, walk.depth);
}

void testBlocker(uint slot, bool there, uint axis) {
  PrimitiveTexels p = sharedPrimitive(slot);
  vec3 v0 = rotateToLast(p.v0, axis), v1 = rotateToLast(p.v1, axis), v2 = rotateToLast(p.v2, axis);
  [[unroll]] for (int k = 0; k < kRaysPerLane; ++k) {
    vec3 o = rotateToLast(rays_[k].origin, axis);
    TriangleHit h = hitRotated(v0 - o, v1 - o, v2 - o, shears_[k], 0.0, ends_[k]);
    bool blocks = there && h.hit && slot != rays_[k].from;
    blocked_[k] = blocked_[k] || blocks;
    ends_[k] = blocks ? -1.0 : ends_[k];
  }
}

bool allDone() {
  uint searching = 0u;
  [[unroll]] for (int k = 0; k < kRaysPerLane; ++k) searching |= ends_[k] >= 0.0 ? 1u : 0u;
  return orOverLanes(searching) == 0u;
}

// Goes through the leaf that is next, then takes what waits; leaves that wait right behind it follow.
void walkLeafForPacket(uint axis, inout PacketWalk walk) {
  do {
    bool leaf = walk.next != kWalkDone;
    uint slot = leaf ? walk.next & kBvhFirstMask : 0u;
    uint count = leaf ? (walk.next >> kBvhCountShift) & 15u : 0u;
    do {
      testBlocker(slot, count != 0u, axis);
      slot += 1u;
      count -= min(count, 1u);
      ++walk.steps;
    } while (count != 0u);
    uint top = waitingTop(walk.depth);
    bool more = walk.depth > 0u && !allDone();
    walk.next = more ? top : kWalkDone;
    walk.depth -= more ? 1u : 0u;
  } while (isLeafChild(walk.next) && walk.steps < kPacketSteps);
}

void startShadowRay(int k, Ray ray, bool counts) {
  RayShear shear = shearOf(ray.direction);
  rays_[k] = ray;
  shears_[k] = shear.shear;
  inverses_[k] = finiteInverse(ray.direction);
  classes_[k] = counts ? rayClass(shear, inverses_[k]) : kNoClass;
  blocked_[k] = false;
}

uint lowestClassFrom(uint first) {
  uint lowest = kNoClass;
  [[unroll]] for (int k = 0; k < kRaysPerLane; ++k) lowest = classes_[k] >= first ? min(lowest, classes_[k]) : lowest;
  return minOverLanes(lowest);
}

void activateClass(uint which) {
  [[unroll]] for (int k = 0; k < kRaysPerLane; ++k) ends_[k] = classes_[k] == which ? rays_[k].tMax : -1.0;
}

// Fills blocked_ for the rays that were started, class by class. False: it gave up.
bool searchBlockers() {
  waitingClear();
  uint which = lowestClassFrom(0u);
  PacketWalk walk = PacketWalk(0u, 0u, 0u);
  do {
    activateClass(which);
    walk.next = 0u;
    walk.depth = 0u;
    do {
      do {
        descendPacket(which & 7u, walk);
        ++walk.steps;
      } while ((walk.next & kBvhLeaf) == 0u && walk.steps < kPacketSteps);
      walkLeafForPacket(which >> 3u, walk);
    } while (walk.next != kWalkDone && walk.steps < kPacketSteps);
    which = lowestClassFrom(which + 1u);
  } while (which != kNoClass && walk.steps < kPacketSteps);
  return walk.steps < kPacketSteps;
}
#endif

// What packets of rays share: one subgroup of kLanes lanes carries kLanes * kRaysPerLane rays down one path. Control flow
// is the same for all lanes, so a driver that runs both sides of every branch loses nothing; what a node or a triangle
// says is loaded once, spread over the lanes, and passed on by shuffles. Loops test at their end: llvmpipe runs a
// body once more before it notices a break. Whoever includes this defines CL_RAYS_PER_LANE.
#ifndef CROSSLIGHT_PACKET_GLSL
#define CROSSLIGHT_PACKET_GLSL
#extension GL_EXT_control_flow_attributes : require
#include "accel/bvh.glsl"
#include "accel/lanes.glsl"

const uint kLanes = 8u;
const int kRaysPerLane = CL_RAYS_PER_LANE;

uint lane() { return gl_SubgroupInvocationID; }

// Over the lanes, by exchanges in pairs: the subgroup's own reductions are loops through memory on llvmpipe.
uint orOverLanes(uint v) {
  v |= subgroupShuffleXor(v, 1u);
  v |= subgroupShuffleXor(v, 2u);
  return v | subgroupShuffleXor(v, 4u);
}
uint minOverLanes(uint v) {
  v = min(v, subgroupShuffleXor(v, 1u));
  v = min(v, subgroupShuffleXor(v, 2u));
  return min(v, subgroupShuffleXor(v, 4u));
}
float fromXor(float v, uint mask) { return uintBitsToFloat(subgroupShuffleXor(floatBitsToUint(v), mask)); }
float minOverLanes(float v) {
  v = smaller(v, fromXor(v, 1u));
  v = smaller(v, fromXor(v, 2u));
  return smaller(v, fromXor(v, 4u));
}
float maxOverLanes(float v) {
  v = greater(v, fromXor(v, 1u));
  v = greater(v, fromXor(v, 2u));
  return greater(v, fromXor(v, 4u));
}
vec3 minOverLanes(vec3 v) { return vec3(minOverLanes(v.x), minOverLanes(v.y), minOverLanes(v.z)); }
vec3 maxOverLanes(vec3 v) { return vec3(maxOverLanes(v.x), maxOverLanes(v.y), maxOverLanes(v.z)); }

// A stack that all lanes agree on: entry s lies in register s / kLanes of lane s % kLanes.
#define CL_LANE_STACK(name, registers)                                                            \
  uint name##Entries_[registers];                                                                 \
  void name##Clear() {                                                                            \
    [[unroll]] for (uint r = 0u; r < registers; ++r) name##Entries_[r] = 0u;                      \
  }                                                                                               \
  void name##Push(uint value, bool really, inout uint depth) {                                    \
    [[unroll]] for (uint r = 0u; r < registers; ++r)                                              \
      name##Entries_[r] = really && depth == r * kLanes + lane() ? value : name##Entries_[r];     \
    depth += really ? 1u : 0u;                                                                    \
  }                                                                                               \
  uint name##Top(uint depth) {                                                                    \
    uint at = depth - min(depth, 1u);                                                             \
    uint value = name##Entries_[0];                                                               \
    [[unroll]] for (uint r = 1u; r < registers; ++r) value = at / kLanes == r ? name##Entries_[r] : value; \
    return subgroupShuffle(value, at % kLanes);                                                   \
  }

// A triangle that every lane needs.
PrimitiveTexels sharedPrimitive(uint slot) {
  uvec4 texel = texelFetch(bvhPrimitives, int(3u * slot + min(lane(), 2u)));
  return PrimitiveTexels(vectorFromLane(texel, 0u), vectorFromLane(texel, 1u), vectorFromLane(texel, 2u),
                         fromLane(texel.w, 0u), fromLane(texel.w, 1u), fromLane(texel.w, 2u));
}

// Signs of a direction as bits; directions that share them enter every box by the same three faces.
uint signsOf(vec3 d) { return (d.x < 0.0 ? 1u : 0u) | (d.y < 0.0 ? 2u : 0u) | (d.z < 0.0 ? 4u : 0u); }
bvec3 negativeBy(uint signs) { return notEqual(uvec3(signs) & uvec3(1u, 2u, 4u), uvec3(0u)); }

// 1 / d without infinities: 0 * inf would be NaN where a ray runs within a face. A direction this small moves nowhere.
vec3 finiteInverse(vec3 d) { return clamp(1.0 / d, vec3(-kLargest), vec3(kLargest)); }

// Planes an ulp or more farther out. A ray that runs within a plane has the distance 0 to it, and 0 times the inverse
// above is 0: it would leave the box before it enters. `outwards`: 1 for upper planes, -1 for lower ones.
vec3 planesBeyond(vec3 planes, float outwards) {
  const float kUlp = 1.1920929e-7, kLeast = 5.4e-20;  // 2^-23, 2^-64: times kLargest beyond all scenes
  return planes + outwards * (abs(planes) * kUlp + kLeast);
}

// Axis of the shear and signs: rays of one class share the order of everything.
uint rayClass(RayShear shear, vec3 inverse) { return shear.axis << 3u | signsOf(inverse); }
const uint kNoClass = 0xffffffffu;

// A packet that takes more steps than this meets far more triangles than it has rays: one by one they are done sooner.
// A step is at most three passes through loops, which some drivers end after 65,535.
const uint kPacketSteps = 16384u;

// Puts this group on the list of those that a kernel with one ray per lane does again.
void giveUp(uint group) {
  if (!subgroupElect()) return;
  rest[kRestGroups + atomicAdd(rest[0], 1u)] = group;
  atomicAdd(counters[kCounterGaveUp], 1u);
}

bool isLeafChild(uint child) { return (child & kBvhLeaf) != 0u && child != kWalkDone; }
#endif

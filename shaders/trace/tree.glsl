// The ray tree's storage: shared by the kernels of the Whitted tracer.
#ifndef CROSSLIGHT_TREE_GLSL
#define CROSSLIGHT_TREE_GLSL
#include "accel/ray.glsl"
#include "trace/groups.glsl"

layout(push_constant, scalar) uniform PushBlock { TracePush pushed; };
layout(set = 0, binding = kBindRays, scalar) writeonly buffer RayBlock { RayRecord rays[]; };
layout(set = 0, binding = kBindRayTexels) uniform usamplerBuffer rayTexels;
layout(set = 0, binding = kBindHits, scalar) writeonly buffer HitBlock { HitRecord hits[]; };
layout(set = 0, binding = kBindHitTexels) uniform usamplerBuffer hitTexels;
layout(set = 0, binding = kBindVisibility, scalar) buffer VisibilityBlock { float visibilities[]; };

// Of a light of the batch, or behind them the environment, and a ray of the level; with shadows in color, of a channel.
uint visibilityPlace(uint light, uint ray, uint channel) {
  uint planes = pushed.lightCount + (frame.environmentSize.x != 0u ? 1u : 0u);
  uint plane = CL_HAS(coloredShadows) ? channel * planes + light : light;
  return plane * pushed.nodeCount + ray;
}

layout(set = 0, binding = kBindRest, scalar) buffer RestBlock { uint rest[]; };
layout(set = 0, binding = kBindQueues, scalar) buffer QueueBlock { uint queues[]; };

// Do surfaces send rays on at all? Else there is one level, and no tree is kept.
const bool kBranches = (specVariant & kVariantTree) != 0u;

// What earlier dispatches have left.
HitRecord hitOf(uint node) {
  uvec4 hit = texelFetch(hitTexels, int(node));
  return HitRecord(uintBitsToFloat(hit.x), hit.y, uintBitsToFloat(hit.z), uintBitsToFloat(hit.w));
}

RayRecord rayRecordOf(uint node) {
  uvec4 a = texelFetch(rayTexels, int(3u * node));
  uvec4 b = texelFetch(rayTexels, int(3u * node + 1u));
  uvec4 c = texelFetch(rayTexels, int(3u * node + 2u));
  return RayRecord(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz), uintBitsToFloat(b.w), c.x, c.y,
                   c.z, c.w);
}

// By the camera, or through surfaces that do not bend light.
bool isSeenDirectly(uint kind) { return !kBranches || kind == kRayPrimary || kind == kRayPassThrough; }

// What the camera sees directly: single-sided surfaces have no back there, as in the rasteriser. Mirrored and refracted
// rays meet bodies from inside too, and so does a camera within one.
bool goesStraight(uint kind) {
  bool camera = !CL_HAS(nestedMedia) || frame.cameraMedium == kNoRayNode;
  return (kind == kRayPrimary && camera) || kind == kRayPassThrough;
}

const uint kNoRay = 0xffffffffu;

// Ray of the level at a place of what the kernel works on: the level itself, or a queue of it.
uint rayAtPlace(uint place) {
  if ((specVariant & kVariantQueue) == 0u) return place < pushed.nodeCount ? place : kNoRay;
  bool there = place < queues[kQueueWords * pushed.hitClass + 3u];
  uint ray = queues[kQueueWords * kHitClasses + pushed.hitClass * pushed.nodeCapacity + (there ? place : 0u)];
  return there ? ray : kNoRay;
}

// Of the kernels whose groups have 64 lanes.
uint placeOfInvocation() { return spreadGroup() * 64u + gl_LocalInvocationID.x; }

// Ray of this invocation within its level, or kNoRay: all are walked through, or only the groups of 64 that packets
// gave up.
uint rayOfInvocation() {
  uint place = placeOfInvocation();
  if ((specVariant & kVariantRest) != 0u) place = rest[kRestGroups + gl_WorkGroupID.x] * 64u + gl_LocalInvocationID.x;
  return rayAtPlace(place);
}
#endif

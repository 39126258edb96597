#version 460
// Queues the hits of one level by the class of their surface, so that each class is shaded by a kernel made for it, and
// gives the background to the rays that meet nothing. Neighbors stay neighbors within a queue; where a group's part of
// it lies depends on who comes first, and nothing depends on that.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/scene_bindings.glsl"
#include "trace/tree.glsl"
#include "shade/passed_light.glsl"
#include "trace/camera.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = kBindRayNodes, scalar) buffer NodeBlock { RayNode nodes[]; };
layout(set = 0, binding = kBindSampleColor, scalar) buffer SampleBlock { vec4 samples[]; };
layout(set = 0, binding = kBindHitClasses) uniform usamplerBuffer hitClassTexels;

float lightVisibility(uint lightIndex) { return 1.0; }  // nothing is shaded here

#include "trace/results.glsl"

const uint kRaysPerLane = kClassifiedPerLane;  // atomics are dear: one per class for all of a subgroup's rays

uint classOf(HitRecord hit) {
  bool shape = isShapeHit(hit);
  uint draw;
  if (shape) draw = shapeOf(hit.primitive & ~kHitShape).drawId;
  else draw = fetchTriangle(hit.primitive).drawId;
  uvec4 classes = texelFetch(hitClassTexels, int(drawOf(draw).materialId));
  return shape ? classes.y : classes.x;
}

// Counts per class, sixteen bits each.
uvec2 countFor(uint hitClass) {
  uint one = 1u << (16u * (hitClass & 1u));
  return uvec2(hitClass < 2u ? one : 0u, hitClass >= 2u && hitClass < kHitClasses ? one : 0u);
}
uint countOf(uvec2 counts, uint hitClass) { return ((hitClass < 2u ? counts.x : counts.y) >> (16u * (hitClass & 1u))) & 0xffffu; }

uint reserve(uint hitClass, uint count) {
  uint first = atomicAdd(queues[kQueueWords * hitClass + 3u], count);
  atomicMax(queues[kQueueWords * hitClass], (first + count + kRaysPerGroup - 1u) / kRaysPerGroup);
  return first;
}

void main() {
  uint first = kRaysPerLane * placeOfInvocation();
  uint classes[kRaysPerLane];
  uvec2 wanted = uvec2(0u);
  [[unroll]] for (uint k = 0u; k < kRaysPerLane; ++k) {
    uint ray = first + k;
    bool there = ray < pushed.nodeCount;
    uint node = pushed.firstNode + min(ray, pushed.nodeCount - 1u);
    HitRecord hit = hitOf(node);
    uint pixel = pushed.firstNode == 0u ? pixelOf(cameraPlace(ray)) : 0u;
    bool missed = hit.primitive == kNoHit;
    if (there && missed && pixel != kNoPixel) storeMiss(node, pixel, rayOfNode(node, cameraPlace(ray)).direction);
    classes[k] = there && !missed ? classOf(hit) : kHitClasses;
    wanted += countFor(classes[k]);
  }
  uvec2 before = subgroupExclusiveAdd(wanted), all = subgroupAdd(wanted);
  uvec4 begin = uvec4(0u);
  if (subgroupElect()) {
    [[unroll]] for (uint c = 0u; c < kHitClasses; ++c)
      if (countOf(all, c) > 0u) begin[c] = reserve(c, countOf(all, c));
  }
  begin = subgroupBroadcastFirst(begin);
  [[unroll]] for (uint k = 0u; k < kRaysPerLane; ++k) {
    uint c = classes[k];
    if (c < kHitClasses) queues[kQueueWords * kHitClasses + c * pushed.nodeCapacity + begin[c] + countOf(before, c)] = first + k;
    before += countFor(c);
  }
}

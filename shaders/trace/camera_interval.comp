#version 460
// Closest triangle of every camera ray of a chunk, 64 rays to a subgroup of 8: a tile of the picture.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "trace/tree.glsl"
#include "shade/passed_light.glsl"
#include "trace/camera.glsl"
#define CL_RAYS_PER_LANE 8
#define CL_ORIGIN_ZERO ((specVariant & kVariantOrthographic) == 0u)
#include "accel/interval.glsl"

layout(local_size_x = 8) in;

float lightVisibility(uint lightIndex) { return 1.0; }  // nothing is shaded here

uint rayIndex(int k) { return (spreadGroup() * uint(kRaysPerLane) + uint(k)) * kLanes + gl_LocalInvocationID.x; }

void main() {
  [[unroll]] for (int k = 0; k < kRaysPerLane; ++k) startRay(k, cameraRay(cameraPlace(rayIndex(k))));
  if (!closestForInterval(goesStraight(kRayPrimary))) giveUp(spreadGroup());
  int taken = 0;
  [[dont_unroll]] do {
    HitRecord found = takeFound();
    if (rayIndex(taken) < pushed.nodeCount) hits[rayIndex(taken)] = found;
    ++taken;
  } while (taken < kRaysPerLane);
}

#version 460
// Closest triangle of camera rays, one ray per lane.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "trace/tree.glsl"
#include "shade/passed_light.glsl"
#include "trace/camera.glsl"

layout(local_size_x = 64) in;

float lightVisibility(uint lightIndex) { return 1.0; }  // nothing is shaded here

void main() {
  uint ray = rayOfInvocation();
  if (ray != kNoRay) hits[ray] = closestTriangle(cameraRay(cameraPlace(ray)), goesStraight(kRayPrimary));
}

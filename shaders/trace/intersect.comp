#version 460
// Closest hit of every ray of one level.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "trace/tree.glsl"
#include "trace/passed_light.glsl"

layout(local_size_x = 64) in;

float lightVisibility(uint lightIndex) { return 1.0; }  // nothing is shaded here

void main() {
  if (gl_GlobalInvocationID.x >= pushed.nodeCount) return;
  uint index = pushed.firstNode + gl_GlobalInvocationID.x;
  RayNode node = nodes[index];
  hits[index] = closestHit(rayOf(node), goesStraight(node));
}

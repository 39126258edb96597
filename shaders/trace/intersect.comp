#version 460
// Closest triangle of every stored ray of one level, one ray per lane.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "trace/tree.glsl"
#include "shade/passed_light.glsl"

layout(local_size_x = 64) in;

float lightVisibility(uint lightIndex) { return 1.0; }  // nothing is shaded here

void main() {
  uint ray = rayOfInvocation();
  if (ray == kNoRay) return;
  uint node = pushed.firstNode + ray;
  RayRecord stored = rayRecordOf(node);
  hits[node] = closestTriangle(rayOf(stored), goesStraight(stored.kind));
}

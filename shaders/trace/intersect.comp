#version 460
// Closest triangle of every stored ray of one level, one ray per lane; with CL_QUADS through nodes with four children.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "trace/tree.glsl"
#include "shade/passed_light.glsl"
#ifdef CL_QUADS
#include "accel/quad.glsl"
#define CL_CLOSEST closestTriangleByQuads
#else
#define CL_CLOSEST closestTriangle
#endif

layout(local_size_x = 64) in;

float lightVisibility(uint lightIndex) { return 1.0; }  // nothing is shaded here

void main() {
  uint ray = rayOfInvocation();
  if (ray == kNoRay) return;
  uint node = pushed.firstNode + ray;
  RayRecord stored = rayRecordOf(node);
  hits[node] = CL_CLOSEST(rayOf(stored), goesStraight(stored.kind));
}

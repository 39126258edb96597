#version 460
// Analytic shapes nearer than what the rays of one level have met so far, one ray per lane. A kernel of its own: the
// shapes' equations are long, and what is compiled into a kernel is paid for by every ray on llvmpipe.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "trace/tree.glsl"
#include "trace/passed_light.glsl"
#include "trace/camera.glsl"

layout(local_size_x = 64) in;

float lightVisibility(uint lightIndex) { return 1.0; }  // nothing is shaded here

void main() {
  if (gl_GlobalInvocationID.x >= pushed.nodeCount) return;
  uint node = pushed.firstNode + gl_GlobalInvocationID.x;
  RayRecord ray = rayOfNode(node, cameraPlace(gl_GlobalInvocationID.x));
  HitRecord sofar = kMiss;
  if (CL_HAS(triangles)) sofar = hitOf(node);
  hits[node] = closestShape(rayOf(ray), goesStraight(ray.kind), sofar);
}

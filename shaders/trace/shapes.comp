#version 460
// Analytic shapes nearer than what the rays of one level have met so far, one ray per lane. A kernel of its own: the
// shapes' equations are long, and what is compiled into a kernel is paid for by every ray on llvmpipe.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "trace/tree.glsl"
#include "shade/passed_light.glsl"
#include "trace/camera.glsl"
#include "accel/few_shapes.glsl"

layout(local_size_x = 64) in;

float lightVisibility(uint lightIndex) { return 1.0; }  // nothing is shaded here

void main() {
  bool inLevel = placeOfInvocation() < pushed.nodeCount;
  uint at = min(placeOfInvocation(), pushed.nodeCount - 1u);
  uint node = pushed.firstNode + at;
  RayRecord ray = rayOfNode(node, cameraPlace(at));
  HitRecord sofar = kMiss;
  if (CL_HAS(triangles)) sofar = hitOf(node);
  HitRecord hit;
  if (kFewShapes) {
    float end = sofar.primitive == kNoHit ? ray.tMax : sofar.t;
    uint ahead = shapesAhead(endingAt(rayOf(ray), end));
    hit = closestOfShapes(rayOf(ray), goesStraight(ray.kind), sofar, ahead);
  } else {
    hit = closestShape(rayOf(ray), goesStraight(ray.kind), sofar);
  }
  if (inLevel) hits[node] = hit;
}

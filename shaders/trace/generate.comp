#version 460
// Camera rays of a chunk of pixels: the first level of their ray trees.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "trace/tree.glsl"

layout(local_size_x = 64) in;

void main() {
  uint index = gl_GlobalInvocationID.x;
  if (index >= pushed.nodeCount) return;
  uint pixel = pushed.pixelOffset + index;
  uint imagePixel = pushed.firstPixel + pixel;
  vec2 at = vec2(imagePixel % frame.resolution.x, imagePixel / frame.resolution.x) + frame.sampleOffset;
  vec2 plane = (2.0 * at / vec2(frame.resolution) - 1.0) * vec2(1.0, -1.0) * frame.imagePlaneHalf;
  vec3 across = plane.x * frame.cameraRight + plane.y * frame.cameraUp;
  bool orthographic = frame.orthographic != 0u;
  RayNode node;
  node.origin = orthographic ? across : vec3(0.0);
  node.direction = orthographic ? frame.cameraForward : frame.cameraForward + across;
  node.tMin = frame.zNear;
  node.tMax = frame.zFar;
  node.weight = vec3(1.0);
  node.pixel = pixel;
  node.value = vec3(0.0);
  node.kind = kRayPrimary;
  node.reflected = kNoRayNode;
  node.transmitted = kNoRayNode;
  node.medium = kNoRayNode;
  node.depth = 0u;
  node.alpha = 0.0;
  node.from = kNoHit;
  nodes[index] = node;
}

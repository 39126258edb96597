#version 460
// Adds the children of every node of one level into their parent; run from the deepest level up. At the first level
// the pixel is complete. Fixed order of addition: the image does not depend on the order in which rays were stored.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "trace/tree.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = kBindSampleColor, scalar) writeonly buffer SampleBlock { vec4 samples[]; };

void main() {
  if (gl_GlobalInvocationID.x >= pushed.nodeCount) return;
  uint index = pushed.firstNode + gl_GlobalInvocationID.x;
  RayNode node = nodes[index];
  if (node.reflected != kNoRayNode) node.value += nodes[node.reflected].weight * nodes[node.reflected].value;
  if (node.transmitted != kNoRayNode) {
    node.value += nodes[node.transmitted].weight * nodes[node.transmitted].value;
    node.alpha += (1.0 - node.alpha) * nodes[node.transmitted].alpha;
  }
  nodes[index] = node;
  if (node.kind == kRayPrimary) samples[node.pixel] = vec4(node.value, node.alpha);
}

#version 460
// Adds the children of every node of one level into their parent; run from the deepest level up. At the first level
// the pixel is complete. Fixed order of addition: the image does not depend on the order in which rays were stored.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "trace/tree.glsl"
#include "trace/camera.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = kBindSampleColor, scalar) writeonly buffer SampleBlock { vec4 samples[]; };
layout(set = 0, binding = kBindRayNodes, scalar) writeonly buffer NodeBlock { RayNode nodes[]; };
layout(set = 0, binding = kBindNodeTexels) uniform usamplerBuffer nodeTexels;

vec4 texelOf(uint node, uint part) { return uintBitsToFloat(texelFetch(nodeTexels, int(3u * node + part))); }

void main() {
  uint at = placeOfInvocation();
  if (at >= pushed.nodeCount) return;
  uint index = pushed.firstNode + at;
  vec4 own = texelOf(index, 0u);
  uvec2 children = texelFetch(nodeTexels, int(3u * index + 2u)).xy;
  vec4 reflected = texelOf(children.x == kNoRayNode ? index : children.x, 0u);
  vec4 transmitted = texelOf(children.y == kNoRayNode ? index : children.y, 0u);
  if (children.x != kNoRayNode) own.rgb += reflected.rgb;
  if (children.y != kNoRayNode) {
    own.rgb += transmitted.rgb;
    if (CL_HAS(dispersion)) {
      uint count = texelFetch(nodeTexels, int(3u * index + 2u)).w;
      for (uint k = 1u; k < count; ++k) own.rgb += texelOf(children.y + k, 0u).rgb;
    }
    own.a += (1.0 - own.a) * transmitted.a;
  }
  if (pushed.firstNode > 0u) {
    nodes[index].value = own.rgb * texelOf(index, 1u).rgb;
    nodes[index].alpha = own.a;
    return;
  }
  uint pixel = pixelOf(cameraPlace(at));
  if (pixel != kNoPixel) samples[pixel] = own;
}

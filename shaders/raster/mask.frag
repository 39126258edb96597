#version 460
// Depth-only passes over alpha-masked surfaces: nothing but the cut.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "material/surface.glsl"
#define CL_STAGE in
#include "raster/varyings.glsl"

void main() {
  MaterialRecord m = materials[draws[drawId].materialId];
  if (CL_HAS(alphaMask) && cutByMask(m, baseAlphaAt(m, uvs.xy, uvs.zw, vertexColor.a))) discard;
}

#version 460
// Depth-only passes over alpha-masked surfaces: nothing but the cut.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "shade/shade.glsl"
#define CL_STAGE in
#include "raster/varyings.glsl"

float lightVisibility(uint lightIndex) { return 1.0; }  // nothing is shaded here

void main() {
  MaterialRecord m = materials[draws[drawId].materialId];
  if (CL_HAS(alphaMask) && cutByMask(m, baseAlphaAt(m, uvs.xy, uvs.zw, (draws[drawId].flags & kDrawHasColors) != 0u ? vertexColor.a : 1.0))) discard;
}

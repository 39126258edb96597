#version 460
// Depth-only passes over alpha-masked surfaces: nothing but the cut.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "raster/draw.glsl"
#include "shade/shade.glsl"
#include "raster/fragment_in.glsl"

void main() {
  SurfaceInput at = interpolatedInput();
  if (CL_HAS(alphaMask) && cutByMask(drawMaterial, baseAlphaAt(drawMaterial, at.uv0, at.uv1, at.colored ? at.color.a : 1.0)))
    discard;
}

#version 460
// Edges in the surface's own color, unlit; through fog.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "raster/draw.glsl"
#include "shade/shade.glsl"
#include "shade/fog.glsl"
#include "raster/fragment_in.glsl"

layout(location = 0) out vec4 outColor;

void main() {
  SurfaceInput at = interpolatedInput();
  vec3 color = surfaceAt(at).albedo;
  if (CL_HAS(fog)) color = throughFog(color, vec3(0.0), fogOver(fogDistance(at.renderPos)));
  outColor = vec4(color, 1.0);
}

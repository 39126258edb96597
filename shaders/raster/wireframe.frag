#version 460
// Edges in the surface's own color, unlit.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "raster/draw.glsl"
#include "shade/shade.glsl"
#include "raster/fragment_in.glsl"

layout(location = 0) out vec4 outColor;

void main() { outColor = vec4(surfaceAt(interpolatedInput()).albedo, 1.0); }

#version 460
// What is seen where nothing is.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "raster/draw.glsl"
#include "shade/shade.glsl"
#include "raster/air.glsl"

layout(location = 0) out vec4 outColor;

void main() { outColor = vec4(backgroundThroughAir(), 0.0); }

#version 460
// What is seen where nothing is, as a display's codes.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "raster/draw.glsl"
#include "shade/shade.glsl"
#include "raster/air.glsl"
#include "raster/display.glsl"

layout(location = 0) out uint outCodes;

void main() { outCodes = shownCodes(backgroundThroughAir()); }

#version 460
// Lighting per vertex, interpolated.
#extension GL_GOOGLE_include_directive : require
#define CL_SUMS_MODE smooth
#include "raster/fragment.glsl"

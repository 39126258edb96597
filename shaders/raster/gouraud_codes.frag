#version 460
// Lighting per vertex, interpolated, as a display's codes.
#extension GL_GOOGLE_include_directive : require
#define CL_SUMS_MODE smooth
#define CL_CODES
#include "raster/fragment.glsl"

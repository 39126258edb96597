#version 460
// Lighting per vertex, interpolated; records AOVs.
#extension GL_GOOGLE_include_directive : require
#define CL_SUMS_MODE smooth
#define CL_AOV
#include "raster/fragment.glsl"

#version 460
// Lighting of the provoking vertex; records AOVs.
#extension GL_GOOGLE_include_directive : require
#define CL_SUMS_MODE flat
#define CL_AOV
#include "raster/fragment.glsl"

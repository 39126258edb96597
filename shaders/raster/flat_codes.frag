#version 460
// Lighting of the provoking vertex, as a display's codes.
#extension GL_GOOGLE_include_directive : require
#define CL_SUMS_MODE flat
#define CL_FLAT_CODES
#define CL_CODES
#include "raster/fragment.glsl"

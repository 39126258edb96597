#version 460
// Lighting of the provoking vertex.
#extension GL_GOOGLE_include_directive : require
#define CL_SUMS_MODE flat
#include "raster/fragment.glsl"

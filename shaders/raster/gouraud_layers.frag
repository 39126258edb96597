#version 460
// Lighting per vertex, interpolated; keeps a list of what is transparent.
#extension GL_GOOGLE_include_directive : require
#define CL_SUMS_MODE smooth
#define CL_LAYERS
#include "raster/fragment.glsl"

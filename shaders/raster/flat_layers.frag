#version 460
// Lighting of the provoking vertex; keeps a list of what is transparent.
#extension GL_GOOGLE_include_directive : require
#define CL_SUMS_MODE flat
#define CL_LAYERS
#include "raster/fragment.glsl"

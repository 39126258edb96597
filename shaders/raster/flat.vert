#version 460
// Vertex stage for lighting per vertex, taken from the provoking one.
#extension GL_GOOGLE_include_directive : require
#define CL_SUMS_MODE flat
#include "raster/vertex.glsl"

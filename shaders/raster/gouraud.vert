#version 460
// Vertex stage for lighting per vertex, interpolated.
#extension GL_GOOGLE_include_directive : require
#define CL_SUMS_MODE smooth
#include "raster/vertex.glsl"

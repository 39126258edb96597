#version 460
// As flat.vert; the provoking vertex makes the codes where it can.
#extension GL_GOOGLE_include_directive : require
#define CL_SUMS_MODE flat
#define CL_FLAT_CODES
#include "raster/vertex.glsl"

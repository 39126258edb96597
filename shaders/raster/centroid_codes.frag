#version 460
// Flat shading at the triangle's centroid, with the triangle's own normal.
#extension GL_GOOGLE_include_directive : require
#define CL_CENTROID
#define CL_CODES
#include "raster/fragment.glsl"

#version 460
// Flat shading at the triangle's centroid, with the triangle's own normal; records AOVs.
#extension GL_GOOGLE_include_directive : require
#define CL_CENTROID
#define CL_AOV
#include "raster/fragment.glsl"

#version 460
// Flat shading at the triangle's centroid, with the triangle's own normal; keeps a list of what is transparent.
#extension GL_GOOGLE_include_directive : require
#define CL_CENTROID
#define CL_LAYERS
#include "raster/fragment.glsl"

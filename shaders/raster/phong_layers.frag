#version 460
// Lighting per fragment; keeps a list of what is transparent.
#extension GL_GOOGLE_include_directive : require
#define CL_LAYERS
#include "raster/fragment.glsl"

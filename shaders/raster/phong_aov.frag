#version 460
// Lighting per fragment; records AOVs.
#extension GL_GOOGLE_include_directive : require
#define CL_AOV
#include "raster/fragment.glsl"

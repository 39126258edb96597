#version 460
// Lighting per fragment, as a display's codes.
#extension GL_GOOGLE_include_directive : require
#define CL_CODES
#include "raster/fragment.glsl"

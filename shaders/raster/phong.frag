#version 460
// Lighting per fragment.
#extension GL_GOOGLE_include_directive : require
#include "raster/fragment.glsl"

#version 460
// Vertex stage for lighting per fragment.
#extension GL_GOOGLE_include_directive : require
#include "raster/vertex.glsl"

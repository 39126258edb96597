#version 460
// Share of light that a transparent surface lets pass; blending multiplies all that lie on a texel, in any order.
#extension GL_GOOGLE_include_directive : require
#include "raster/shadow_fragment.glsl"

layout(location = 0) out vec4 outColor;

void main() { outColor = vec4(0.0, 0.0, 0.0, 1.0 - passedLight(materialOf(pushed.materialId), alphaHere(), 1.0)); }

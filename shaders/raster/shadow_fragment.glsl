// What a texel of a shadow map keeps of a triangle.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "shared/raster_bindings.h"
float lightVisibility(uint light) { return 1.0; }  // nothing is shaded here
#include "shade/passed_light.glsl"
#include "raster/shadow_map.glsl"

layout(push_constant, scalar) uniform PushBlock { ShadowPush pushed; };
layout(location = 0) flat in vec4 inPlane;
layout(location = 1) flat in vec2 inNearAndFar;
layout(location = 2) in vec4 inTexCoords;
layout(location = 3) in float inAlpha;

float alphaHere() {
  bool colored = (pushed.drawFlags & kDrawHasColors) != 0u;
  return baseAlphaAt(materialOf(pushed.materialId), inTexCoords.xy, inTexCoords.zw, colored ? inAlpha : 1.0);
}

// Rasterizers snap corners to a grid: beyond the exact triangle's edge a steep plane runs away, the corners do not.
float distanceHere() {
  float z = distanceAt(shadowViews[pushed.view], inPlane, gl_FragCoord.xy);
  return clamp(z, inNearAndFar.x, inNearAndFar.y);
}

// Fog between the viewer and a surface, by the laws of OpenGL 1.x, 3.10. Raster and rays call the same functions; they
// differ in how they find the distance.
#ifndef CROSSLIGHT_FOG_GLSL
#define CROSSLIGHT_FOG_GLSL
#include "math/numeric.glsl"

// e^-104 is less than half of the smallest float: beyond, nothing is left, however far it goes on.
const float kThickest = 104.0;

struct Fog {
  float clear;   // share of the light that comes through
  float fogged;  // the rest, which the fog's color replaces: not 1 - clear where fog is thin
};

Fog fogOver(float distance) {
  if (frame.fogMode == kFogNone) return Fog(1.0, 0.0);
  float x = frame.fogScale * distance;
  float depth = smaller(frame.fogMode == kFogExp ? x : x * x, kThickest);
  float linear = clamp((frame.fogEnd - distance) * frame.fogScale, 0.0, 1.0);
  bool isLinear = frame.fogMode == kFogLinear;
  return Fog(isLinear ? linear : exp(-depth), isLinear ? 1.0 - linear : oneMinusExp(depth));
}

// `color`: light that leaves a surface; `behind`: share of what lies behind it that shows. That is seen through fog of
// its own, from the viewer on, so the surface is owed the rest of the fog's color alone.
vec3 throughFog(vec3 color, vec3 behind, Fog fog) {
  return color * fog.clear + frame.fogColor * fog.fogged * (1.0 - behind);
}

// Of a point that the camera sees directly. Orthographic rays run side by side.
float fogDistance(vec3 renderPos) {
  bool byDepth = (frame.fogByDepth | frame.orthographic) != 0u;
  return byDepth ? dot(renderPos, frame.cameraForward) : safeLength(renderPos);
}
#endif

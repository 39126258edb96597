// What lies between the viewer and a fragment, or the background.
#ifndef CROSSLIGHT_RASTER_AIR_GLSL
#define CROSSLIGHT_RASTER_AIR_GLSL
#include "shade/fog.glsl"
#include "shade/smoke.glsl"
#include "raster/behind.glsl"

vec3 throughSmokeFrom(vec3 color, vec3 behind, vec3 origin, vec3 d, float distance) {
  return throughSmoke(color, behind, airOn(theSmoke(), smokeAlong(origin, d, distance), drawnLightCount(), vec3(0.5)));
}

// `behind`: share of what lies behind that shows.
vec3 seenThroughSmoke(vec3 color, vec3 behind, vec3 renderPos) {
  if (!CL_HAS(smoke)) return color;
  float depth = dot(renderPos, frame.cameraForward);
  bool side = frame.orthographic != 0u;  // rays run side by side
  vec3 origin = side ? renderPos - depth * frame.cameraForward : vec3(0.0);
  vec3 d = side ? frame.cameraForward : safeNormalize(renderPos, frame.cameraForward);
  return throughSmokeFrom(color, behind, origin, d, side ? depth : safeLength(renderPos));
}
vec3 seenThroughAir(vec3 color, vec3 behind, vec3 renderPos) {
  if (CL_HAS(fog)) color = throughFog(color, behind, fogOver(fogDistance(renderPos)));
  return seenThroughSmoke(color, behind, renderPos);
}

// Fog covers what lies behind already.
vec3 backgroundThroughAir() {
  vec3 towards = directionOfPixel();
  vec3 behind = radianceBehind(towards);
  if (!CL_HAS(smoke)) return behind;
  vec3 origin = frame.orthographic != 0u ? acrossImagePlane() : vec3(0.0);
  return throughSmokeFrom(behind, vec3(0.0), origin, safeNormalize(towards, frame.cameraForward), kLargest);
}
#endif

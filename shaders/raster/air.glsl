// What lies between the viewer and a fragment.
#ifndef CROSSLIGHT_RASTER_AIR_GLSL
#define CROSSLIGHT_RASTER_AIR_GLSL
#include "shade/fog.glsl"

// `behind`: share of what lies behind that shows.
vec3 seenThroughAir(vec3 color, vec3 behind, vec3 renderPos) {
  if (CL_HAS(fog)) return throughFog(color, behind, fogOver(fogDistance(renderPos)));
  return color;
}
#endif

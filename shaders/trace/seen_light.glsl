// Lights as the hits of a level see them: with shadows in color what passes tints the light itself, and the one number
// that illumination asks for is 1. Included before shade.glsl.
#ifndef CROSSLIGHT_SEEN_LIGHT_GLSL
#define CROSSLIGHT_SEEN_LIGHT_GLSL

uint shaded_;  // ray of the level whose hit is lit

bool seesInColor() { return CL_HAS(shadows) && CL_HAS(coloredShadows) && (frame.optics & kOpticsColoredShadows) != 0u; }

// Of a light of the batch.
float visibilityOf(uint light, uint channel) { return visibilities[visibilityPlace(light, shaded_, channel)]; }
vec3 visibilityInColor(uint light) { return vec3(visibilityOf(light, 0u), visibilityOf(light, 1u), visibilityOf(light, 2u)); }

LightRecord seenLight(uint index) {
  LightRecord light = lightOf(index);
  if (!seesInColor()) return light;
  vec3 passed = visibilityInColor(index - pushed.firstLight);
  light.diffuse *= passed;
  light.specular *= passed;
  return light;
}
#define CL_LIGHT(index) seenLight(index)

float seenVisibility(uint light) { return CL_HAS(shadows) && !seesInColor() ? visibilityOf(light, 0u) : 1.0; }

// It stands behind those of the lights.
vec3 environmentVisibility(uint lightCount) {
  if (!CL_HAS(shadows) || frame.lightSamples == 0u) return vec3(1.0);
  return seesInColor() ? visibilityInColor(lightCount) : vec3(visibilityOf(lightCount, 0u));
}
#endif

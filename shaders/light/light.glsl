// Lights: direction, distance and falloff of each type at a point; one file per type, dispatched from the list.
#ifndef CROSSLIGHT_LIGHT_GLSL
#define CROSSLIGHT_LIGHT_GLSL
#include "math/numeric.glsl"

struct LightSample {
  vec3 wi;         // unit, from the surface to the light; zero when the light is at the point itself
  float distance;  // scene units; infinite for directional lights
  float falloff;   // multiplies the light's ambient, diffuse and specular intensities
};

#include "light/falloff.glsl"
#include "light/point.glsl"
#include "light/directional.glsl"
#include "light/spot.glsl"
#include "light/area.glsl"

LightSample sampleLight(LightRecord light, vec3 renderPos) {
  LightSample s = LightSample(vec3(0.0), 0.0, 0.0);
#define CL_LIGHT_CASE(value, name, Stem, text) \
  if ((specLights & (1u << value)) != 0u && light.type == value) s = sample##Stem(light, renderPos);
  CL_LIGHT_TYPES(CL_LIGHT_CASE)
#undef CL_LIGHT_CASE
  return s;
}
#endif

// Lights with an area. As a sample they are their middle, which is what a hard shadow asks for: falloff is 1 where the
// point is on a side that emits. What they bring is shade/area_lobe.glsl's: their radiance times an integral.
#include "light/area_face.glsl"

const bool kHasRoundLights = (specLights & (1u << kLightType_areaDisk | 1u << kLightType_areaSphere)) != 0u;
const bool kHasStraightLights = (specLights & (1u << kLightType_areaRectangle | 1u << kLightType_areaTriangle)) != 0u;

bool isAreaLight(LightRecord light) { return kHasAreaLights && ((1u << light.type) & kAreaLightTypes) != 0u; }

// Scaled so that the largest coordinate is 1: squares of squares stay within range whatever the unit.
float faceScale(LightRecord light, vec3 to) {
  vec3 edges = greater(abs(light.areaU), abs(light.areaV));
  return maxComponent(greater(greater(abs(to), edges), vec3(light.areaRadius)));
}

// A point of the light's own plane lies off it by rounding: its position was interpolated between corners (raster) or
// found along a ray, and the corners were placed in the world; sixteen roundings of coordinates as large as any of these.
float planeError(LightRecord light, vec3 renderPos) {
  vec3 largest = greater(abs(renderPos), abs(light.renderPosition) + 2.0 * greater(abs(light.areaU), abs(light.areaV)));
  return gammaBound(16.0) * maxComponent(largest);
}

AreaFace faceOf(LightRecord light, vec3 renderPos) {
  vec3 to = light.renderPosition - renderPos;
  float scale = faceScale(light, to);
  to /= scale;
  vec3 u = light.areaU / scale;
  vec3 v = light.areaV / scale;
  float radius = light.areaRadius / scale;
  bool twoSided = (light.flags & kLightTwoSided) != 0u;
  bool triangle = light.type == kLightType_areaTriangle;
  AreaFace f = polygonFace(triangle ? to : to - u - v, triangle ? u : 2.0 * u, triangle ? v : 2.0 * v, triangle, twoSided,
                           planeError(light, renderPos) / scale);
  float side = dot(light.direction, to);
  if (light.type == kLightType_areaDisk)
    f = circleFace(to, light.direction, radius, side < 0.0 || (twoSided && side > 0.0));
  if (light.type == kLightType_areaSphere) f = sphereFace(to, radius);
  return f;
}

// Where a light is that has a place; a triangle's record has its first corner.
vec3 middleOf(LightRecord light) {
  vec3 middle = light.renderPosition;
  if (kHasAreaLights && light.type == kLightType_areaTriangle) middle += (light.areaU + light.areaV) / 3.0;
  return middle;
}

LightSample sampleArea(LightRecord light, vec3 renderPos) {
  vec3 toLight = middleOf(light) - renderPos;
  return LightSample(safeNormalize(toLight, vec3(0.0)), safeLength(toLight), faceOf(light, renderPos).shines ? 1.0 : 0.0);
}
LightSample sampleAreaRectangle(LightRecord light, vec3 renderPos) { return sampleArea(light, renderPos); }
LightSample sampleAreaDisk(LightRecord light, vec3 renderPos) { return sampleArea(light, renderPos); }
LightSample sampleAreaSphere(LightRecord light, vec3 renderPos) { return sampleArea(light, renderPos); }
LightSample sampleAreaTriangle(LightRecord light, vec3 renderPos) { return sampleArea(light, renderPos); }

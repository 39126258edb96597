// Places on a light with an area, for rays that ask what of it is seen.
#ifndef CROSSLIGHT_AREA_SAMPLE_GLSL
#define CROSSLIGHT_AREA_SAMPLE_GLSL
#include "light/light.glsl"

struct FaceSample {
  vec3 to;       // from the point, in the face's units
  float weight;  // in proportion to the solid angle that the sample stands for
};

// Uniform over the face's area; u in [0,1)^2.
FaceSample sampleFace(AreaFace f, vec2 u) {
  float root = sqrt(u.x);
  vec3 to = f.corner + u.x * f.edgeU + u.y * f.edgeV;
  if (f.triangle) to = f.corner + (1.0 - root) * f.edgeU + u.y * root * f.edgeV;
  if (f.circle) to = onCircle(AreaFace(f.shines, true, false, f.corner, f.edgeU, f.edgeV, f.axis, f.radius * root), 2.0 * kPi * u.y);
  float d2 = dot(to, to);
  return FaceSample(to, greater(dot(f.axis, to), 0.0) / (d2 * sqrt(d2)));
}

// Where the light is met in that direction, from the point, in scene units. A sphere's circle lies within it.
vec3 reachLight(LightRecord light, vec3 renderPos, vec3 to) {
  vec3 scaled = to * faceScale(light, light.renderPosition - renderPos);
  vec3 towards = safeNormalize(to, vec3(0.0));
  vec3 center = light.renderPosition - renderPos;
  float middle = dot(center, towards);
  vec3 beside = center - middle * towards;
  float depth = sqrt(greater(light.areaRadius * light.areaRadius - dot(beside, beside), 0.0));
  return light.type == kLightType_areaSphere ? towards * (middle - depth) : scaled;
}
#endif

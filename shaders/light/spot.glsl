// Spot light: a point light times a cone. Versines, 1 - cos, are compared, never angles or cosines: acos loses digits
// where cones are narrow, and the cosine of 0.01 degrees is 1.

// KHR_lights_punctual, "Inner and Outer Cone Angles": squared ramp between the cosines; a step where they are equal.
float punctualCone(float versine, float inner, float outer) {
  float width = outer - inner;
  float ramp = clamp((outer - versine) / width, 0.0, 1.0);
  float stepped = versine <= outer ? 1.0 : 0.0;
  return width > 0.0 ? ramp * ramp : stepped;
}

// OpenGL 1.x, 2.13.1: a hard edge at the cutoff, the cosine's power inside.
float classicCone(vec3 direction, vec3 wi, float versine, float cutoff, float exponent) {
  return versine <= cutoff ? powerOfCosine(direction, -wi, exponent) : 0.0;
}

LightSample sampleSpot(LightRecord light, vec3 renderPos) {
  LightSample s = samplePoint(light, renderPos);
  vec3 apart = light.direction + s.wi;
  float versine = 0.5 * dot(apart, apart);
  float punctual = punctualCone(versine, light.innerVersine, light.outerVersine);
  float classic = classicCone(light.direction, s.wi, versine, light.outerVersine, light.spotExponent);
  s.falloff *= (light.flags & kLightClassic) != 0u ? classic : punctual;
  return s;
}

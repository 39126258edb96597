// Spot light: a point light times a cone. Cosines are compared, never angles: acos loses digits where cones are narrow.

// KHR_lights_punctual, "Inner and Outer Cone Angles": squared ramp between the cosines; a step where they are equal.
float punctualCone(float cosAngle, float cosInner, float cosOuter) {
  float width = cosInner - cosOuter;
  float ramp = clamp((cosAngle - cosOuter) / width, 0.0, 1.0);
  float stepped = cosAngle >= cosOuter ? 1.0 : 0.0;
  return width > 0.0 ? ramp * ramp : stepped;
}

// OpenGL 1.x, 2.13.1: a hard edge at the cutoff, the cosine's power inside.
float classicCone(vec3 direction, vec3 wi, float cosCutoff, float exponent) {
  float cosAngle = -dot(direction, wi);
  return cosAngle >= cosCutoff ? powerOfCosine(direction, -wi, exponent) : 0.0;
}

LightSample sampleSpot(LightRecord light, vec3 renderPos) {
  LightSample s = samplePoint(light, renderPos);
  float punctual = punctualCone(-dot(light.direction, s.wi), light.cosInner, light.cosOuter);
  float classic = classicCone(light.direction, s.wi, light.cosOuter, light.spotExponent);
  s.falloff *= (light.flags & kLightClassic) != 0u ? classic : punctual;
  return s;
}

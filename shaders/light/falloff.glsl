// How light fades with distance.
#ifndef CROSSLIGHT_FALLOFF_GLSL
#define CROSSLIGHT_FALLOFF_GLSL

// OpenGL 1.x, 2.13.1: 1 / (kc + kl d + kq d^2).
float classicAttenuation(vec3 k, float d) { return 1.0 / (k.x + d * (k.y + d * k.z)); }

// KHR_lights_punctual, "Range Property": inverse square, windowed to reach zero at the range.
float punctualAttenuation(float range, float d) {
  float x = d / range;
  float x2 = x * x;
  float window = range > 0.0 ? clamp(1.0 - x2 * x2, 0.0, 1.0) : 1.0;
  return window / (d * d);
}

float distanceFalloff(LightRecord light, float d) {
  float classic = classicAttenuation(light.attenuation, d);
  float punctual = punctualAttenuation(light.range, d);
  float falloff = (light.flags & kLightClassic) != 0u ? classic : punctual;
  return d > 0.0 ? falloff : 0.0;
}
#endif

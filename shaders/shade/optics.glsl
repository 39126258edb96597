// Where light goes at a smooth boundary: Snell's law and Fresnel's equations.
#ifndef CROSSLIGHT_OPTICS_GLSL
#define CROSSLIGHT_OPTICS_GLSL
#include "math/numeric.glsl"

// Refracted direction of the unit direction d (the way the ray travels) at a surface with unit normal n against d;
// eta is the index on the ray's side over the one beyond. False: total internal reflection.
bool refractRay(vec3 d, vec3 n, float eta, out vec3 refracted) {
  float cosI = -dot(d, n);
  float k = 1.0 - eta * eta * (1.0 - cosI * cosI);
  refracted = safeNormalize(eta * d + (eta * cosI - sqrt(max(k, 0.0))) * n, d);
  return k >= 0.0;
}

// Unpolarised reflectance of a dielectric (Born, Wolf 1999, "Principles of Optics", 1.5.2 Eq. 21), 1 under total
// internal reflection. Equal indices reflect nothing, at every angle.
float fresnelDielectric(float cosI, float eta) {
  if (eta == 1.0) return 0.0;
  float sin2T = eta * eta * max(0.0, 1.0 - cosI * cosI);
  if (sin2T >= 1.0) return 1.0;
  float cosT = sqrt(1.0 - sin2T);
  float s = (eta * cosI - cosT) / (eta * cosI + cosT);
  float p = (cosI - eta * cosT) / (cosI + eta * cosT);
  return 0.5 * (s * s + p * p);
}
#endif

// Reflectance against angle: Schlick's fit and Fresnel's equations. What grazing angles add is a weight of white, so
// that reflected light stays linear in the color at normal incidence.
#ifndef CROSSLIGHT_FRESNEL_GLSL
#define CROSSLIGHT_FRESNEL_GLSL

// Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering", Eq. 15: the weight of 1 against F0.
float schlickWeight(float cosine) {
  float m = clamp(1.0 - cosine, 0.0, 1.0);
  float m2 = m * m;
  return m2 * m2 * m;
}

// Cook, Torrance 1982, "A Reflectance Model for Computer Graphics", p. 13: unpolarised light on a dielectric of index
// n >= 1 in air, c the cosine of the angle of incidence. g >= c, and 0 only where n = 1: nothing is reflected there.
float reflectanceOfIndex(float c, float n) {
  float g = sqrt(max((n - 1.0) * (n + 1.0) + c * c, 0.0));
  float a = (g - c) / (g + c);
  float b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
  return n > 1.0 ? 0.5 * a * a * (1.0 + b * b) : 0.0;
}

// Born, Wolf 1999, "Principles of Optics", 14.4.1: unpolarised light on a medium of index n + ik in air.
float reflectanceOfMetal(float c, float n, float k) {
  float c2 = c * c;
  float s2 = max(1.0 - c2, 0.0);
  float t = n * n - k * k - s2;
  float ab = sqrt(t * t + 4.0 * n * n * k * k);
  float a = sqrt(max(0.5 * (ab + t), 0.0));
  float perpendicular = (ab + c2 - 2.0 * a * c) / (ab + c2 + 2.0 * a * c);
  float ratio = (c2 * ab + s2 * s2 - 2.0 * a * c * s2) / (c2 * ab + s2 * s2 + 2.0 * a * c * s2);
  return 0.5 * perpendicular * (1.0 + ratio);
}

// Cook, Torrance 1982, p. 14: the index whose reflectance at normal incidence is F0, and the color between those at 0
// and 90 degrees in proportion to the reflectance of that index.
float exactWeight(float cosine, float F0) {
  float root = sqrt(clamp(F0, 0.0, 1.0));
  float n = (1.0 + root) / (1.0 - root);
  float F = reflectanceOfIndex(clamp(cosine, 0.0, 1.0), n);
  return F0 > 0.0 && F0 < 1.0 ? clamp((F - F0) / (1.0 - F0), 0.0, 1.0) : 0.0;
}

// `exact`: what the model has where the settings leave it the choice.
float grazingWeight(float cosine, float F0, bool exact) {
  float weight = schlickWeight(cosine);
  if (CL_HAS_TOO(exactFresnel)) {
    bool wanted = frame.fresnel == kFresnelOfModel ? exact : frame.fresnel == kFresnelExact;
    if (wanted) weight = exactWeight(cosine, F0);
  }
  return weight;
}

float meanOf(vec3 color) { return (color.r + color.g + color.b) / 3.0; }
#endif

// glTF 2.0 Appendix B: Lambert plus a GGX microfacet lobe, height-correlated Smith shadowing, Schlick's Fresnel term.

// Trowbridge, Reitz 1975; Walter et al. 2007, "Microfacet Models for Refraction", Eq. 33; rearranged: sin^2 from the
// cross product instead of 1 - NoH^2, which cancels at the peak of narrow lobes. [1/sr]
float D_GGX(vec3 n, vec3 h, float alpha) {
  float NdotH = dot(n, h);
  vec3 sine = cross(n, h);
  float a2 = alpha * alpha;
  float q = a2 * NdotH * NdotH + dot(sine, sine);
  return NdotH > 0.0 ? a2 / (kPi * q * q) : 0.0;
}

// Heitz 2014, "Understanding the Masking-Shadowing Function", Eq. 99, divided by 4 NoL NoV. [dimensionless]
float V_SmithGGXCorrelated(float NoV, float NoL, float alpha) {
  float a2 = alpha * alpha;
  float lambdaV = NoL * sqrt(NoV * NoV * (1.0 - a2) + a2);
  float lambdaL = NoV * sqrt(NoL * NoL * (1.0 - a2) + a2);
  return 0.5 / (lambdaV + lambdaL);
}

// Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering", Eq. 15: the weight of 1 against F0.
float schlickWeight(float cosine) {
  float m = clamp(1.0 - cosine, 0.0, 1.0);
  float m2 = m * m;
  return m2 * m2 * m;
}

Lobe evaluateCookTorrance(SurfacePoint s, vec3 wo, vec3 wi) {
  float NoL = dot(s.n, wi);
  float NoV = dot(s.n, wo);
  vec3 h = safeNormalize(wo + wi, s.n);
  float weight = schlickWeight(dot(wo, h));
  float dielectricF = s.dielectricF0 + (1.0 - s.dielectricF0) * weight;
  bool lit = NoL > 0.0;
  // Where the interpolated normal looks away from the viewer the surface is still seen: the masking term uses |NoV|.
  float microfacets = D_GGX(s.n, h, s.alpha) * V_SmithGGXCorrelated(max(abs(NoV), kUnitRoundoff), NoL, s.alpha) * NoL;
  float diffuse = (1.0 - dielectricF) * NoL / kPi;
  return Lobe(lit ? diffuse : 0.0, lit ? microfacets * (1.0 - weight) : 0.0, lit ? microfacets * weight : 0.0);
}

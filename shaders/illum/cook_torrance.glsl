// glTF 2.0 Appendix B: Lambert plus a GGX microfacet lobe, height-correlated Smith shadowing, Schlick's Fresnel term.
// What extensions change or lay over it is in layers.glsl.

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

#include "illum/layers.glsl"

Lobe evaluateCookTorrance(SurfacePoint s, vec3 wo, vec3 wi) {
  float NoL = dot(s.n, wi);
  float NoV = dot(s.n, wo);
  vec3 h = safeNormalize(wo + wi, s.n);
  float VoH = dot(wo, h);
  float weight = grazingWeight(VoH, s.dielectricF0, false);
  float dielectricF = s.dielectricF0 + (s.dielectricF90 - s.dielectricF0) * weight;
  bool lit = NoL > 0.0;
  bool counts = lit && (s.lobes & kLobeBase) != 0u;
  // Where the interpolated normal looks away from the viewer the surface is still seen: the masking term uses |NoV|.
  float NoVSeen = max(abs(NoV), kUnitRoundoff);
  float microfacets = D_GGX(s.n, h, s.alpha) * V_SmithGGXCorrelated(NoVSeen, NoL, s.alpha) * NoL;
  if (CL_HAS(anisotropy) && s.alphaAlong > 0.0) microfacets = anisotropicFacets(s, h, wo, wi, NoVSeen, NoL) * NoL;
  microfacets = counts ? microfacets : 0.0;
  if (CL_HAS_TOO(exactFresnel)) weight = grazingWeight(VoH, meanOf(s.specularColor), false);
  Lobe lobe = Lobe(vec3(0.0), microfacets * (1.0 - weight), vec3(microfacets * weight * s.F90), vec3(0.0));
  if (CL_HAS(iridescence) && s.iridescence > 0.0) dielectricF = addFilm(s, VoH, microfacets, dielectricF, lobe);
  float diffuse = (1.0 - dielectricF) * NoL / kPi;
  lobe.diffuse = vec3(lit ? diffuse : 0.0);
  if (CL_HAS_TOO(diffuseRoughness) && s.diffuseRoughness > 0.0) lobe.diffuse *= roughDiffuse(s, wo, wi, NoVSeen, NoL);
  if (CL_HAS_TOO(energyCompensation) && frame.energyCompensation != 0u) compensate(s, lobe);
  if (CL_HAS(diffuseTransmission) && s.diffuseTransmission > 0.0) addTransmitted(s, wo, wi, NoL, lobe);
  if (CL_HAS(sheen) && s.sheenAlpha > 0.0) addSheen(s, h, NoVSeen, NoL, lobe);
  if (CL_HAS(clearcoat) && s.coatWeight > 0.0) addCoat(s, h, wo, wi, lobe);
  return lobe;
}

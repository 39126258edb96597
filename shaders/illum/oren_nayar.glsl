// Oren, Nayar 1994, "Generalization of Lambert's Reflectance Model", Eq. 30: the qualitative model, kd (N.L) (A + B
// max(0, cos phi) sin alpha tan beta). Rearranged: cos phi sin(theta_i) sin(theta_o) = wi.wo - (n.wi)(n.wo), divided by
// the larger cosine; no angle is formed, so that grazing and normal incidence lose nothing. sigma = 0 is Lambert's bits.
// Negative where interpolated normals look away from the viewer: gated by the cosine.
Lobe evaluateOrenNayar(SurfacePoint s, vec3 wo, vec3 wi) {
  float NdotL = dot(s.n, wi);
  float NdotV = dot(s.n, wo);
  float sigma2 = s.roughnessAngle * s.roughnessAngle;
  float a = 1.0 - 0.5 * sigma2 / (sigma2 + 0.33);
  float b = 0.45 * sigma2 / (sigma2 + 0.09);
  float sines = max(dot(wi, wo) - NdotL * NdotV, 0.0);
  float larger = max(max(NdotL, NdotV), kUnitRoundoff);
  return lobeOf(NdotL > 0.0 ? NdotL * (a + b * (sines / larger)) : 0.0, 0.0);
}

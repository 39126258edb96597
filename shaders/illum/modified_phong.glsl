// Lafortune, Willems 1994, "Using the Modified Phong Reflectance Model for Physically Based Rendering", Eq. 6 and 8:
// fr = kd / pi + ks (n+2)/(2 pi) (R.V)^n, times N.L. Classic lights have no 1/pi (a white matte surface facing one shows
// its intensity), so all of it is times pi. Reciprocal; reflects no more than it receives while kd + ks <= 1.
Lobe evaluateModifiedPhong(SurfacePoint s, vec3 wo, vec3 wi) {
  float NdotL = dot(s.n, wi);
  vec3 r = 2.0 * NdotL * s.n - wi;
  float fCos = 0.5 * (s.shininess + 2.0) * powerOfCosine(r, wo, s.shininess) * NdotL;
  return classicLobe(s, max(NdotL, 0.0), NdotL > 0.0 ? fCos : 0.0, NdotL);
}

// Phong 1975, "Illumination for Computer Generated Pictures", Eq. 3: kd (N.L) + ks (R.V)^n, R the mirror image of L.
// The specular term is gated by N.L > 0 (the lecture's "light source behind the surface") and has no N.L factor.
Lobe evaluatePhong(SurfacePoint s, vec3 wo, vec3 wi) {
  float NdotL = dot(s.n, wi);
  vec3 r = 2.0 * NdotL * s.n - wi;
  float specular = powerOfCosine(r, wo, s.shininess);
  return classicLobe(s, max(NdotL, 0.0), NdotL > 0.0 ? specular : 0.0, NdotL);
}

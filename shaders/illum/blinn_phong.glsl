// Blinn 1977, "Models of Light Reflection for Computer Synthesized Pictures", p. 193: (N.H)^n, H halfway between L and V.
// The model of OpenGL's fixed function. L = -V has no H; both cosines cannot be positive there, so the gate covers it.
Lobe evaluateBlinnPhong(SurfacePoint s, vec3 wo, vec3 wi) {
  float NdotL = dot(s.n, wi);
  vec3 h = safeNormalize(wo + wi, s.n);
  float specular = powerOfCosine(s.n, h, s.shininess);
  return classicLobe(s, max(NdotL, 0.0), NdotL > 0.0 ? specular : 0.0, NdotL);
}

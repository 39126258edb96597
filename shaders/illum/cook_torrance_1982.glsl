// Cook, Torrance 1982, "A Reflectance Model for Computer Graphics": Rs = F/pi D G / ((N.L)(N.V)), as printed: with 1/pi,
// without the 1/4 that later derivations have. Classic lights have no 1/pi (see modified_phong.glsl): times pi N.L this is
// F D G / (N.V). No promise about energy.

// p. 12, Beckmann's distribution for the root mean square slope m. Rearranged: tangent from the cross product.
float D_Beckmann1982(vec3 n, vec3 h, float m) {
  float NdotH = dot(n, h);
  vec3 sine = cross(n, h);
  float c2 = NdotH * NdotH;
  float m2 = m * m;
  return NdotH > 0.0 ? exp(-dot(sine, sine) / (c2 * m2)) / (m2 * c2 * c2) : 0.0;
}

// p. 11, V-shaped grooves (Torrance, Sparrow 1967).
float G_Grooves(float NdotH, float NdotV, float NdotL, float VdotH) {
  float k = 2.0 * NdotH / VdotH;
  return min(1.0, min(k * NdotV, k * NdotL));
}

vec3 reflectanceOfSurface(SurfacePoint s, float c) {
  return vec3(reflectanceOfMetal(c, s.refractiveIndex.r, s.extinction.r),
              reflectanceOfMetal(c, s.refractiveIndex.g, s.extinction.g),
              reflectanceOfMetal(c, s.refractiveIndex.b, s.extinction.b));
}

// Where n + ik is known F is exact per channel, ks its share; else ks is F at normal incidence.
Lobe evaluateCookTorrance1982(SurfacePoint s, vec3 wo, vec3 wi) {
  float NdotL = dot(s.n, wi);
  float NdotV = max(abs(dot(s.n, wo)), kUnitRoundoff);
  vec3 h = safeNormalize(wo + wi, s.n);
  float VdotH = clamp(dot(wo, h), kUnitRoundoff, 1.0);
  float facets = D_Beckmann1982(s.n, h, s.roughnessAngle) * G_Grooves(dot(s.n, h), NdotV, NdotL, VdotH) / NdotV;
  facets = NdotL > 0.0 ? facets : 0.0;
  float weight = grazingWeight(VdotH, meanOf(s.specularColor), true);
  Lobe lobe = Lobe(vec3(max(NdotL, 0.0)), facets * (1.0 - weight), vec3(facets * weight), vec3(0.0));
  if (s.indexed) {
    vec3 normal = reflectanceOfSurface(s, 1.0);
    vec3 F = frame.fresnel == kFresnelSchlick ? normal + (1.0 - normal) * schlickWeight(VdotH) : reflectanceOfSurface(s, VdotH);
    lobe.specular = 0.0;
    lobe.fresnel = s.specularColor * F * facets;
  }
  return lobe;
}

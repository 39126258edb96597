// What glTF's material extensions change in the metallic-roughness model or lay over it: one function per term. What
// hangs on the viewer alone is worked out once per point, by seenFrom().

// KHR_materials_anisotropy, "Implementation": D times V; Burley 2012, "Physically-Based Shading at Disney", Eq. 13, and
// Heitz 2014, Eq. 86 and 99.
float anisotropicFacets(SurfacePoint s, vec3 h, vec3 wo, vec3 wi, float NoV, float NoL) {
  vec3 across = cross(s.n, s.along);
  float a2 = s.alphaAlong * s.alpha;
  vec3 f = vec3(s.alpha * dot(s.along, h), s.alphaAlong * dot(across, h), a2 * dot(s.n, h));
  float w2 = a2 / dot(f, f);
  float D = dot(s.n, h) > 0.0 ? a2 * w2 * w2 / kPi : 0.0;
  float lambdaV = NoL * length(vec3(s.alphaAlong * dot(s.along, wo), s.alpha * dot(across, wo), NoV));
  float lambdaL = NoV * length(vec3(s.alphaAlong * dot(s.along, wi), s.alpha * dot(across, wi), NoL));
  return D * 0.5 / (lambdaV + lambdaL);
}

// Portsmouth, Kutz, Hill 2024, "EON: A Practical Energy-Preserving Rough Diffuse BRDF": albedo of one bounce at white,
// the fit of section 3.
float albedoFON(float mu, float r) {
  float m = 1.0 - mu;
  float g = m * (0.0571085289 + m * (0.491881867 + m * (-0.332181442 + m * 0.0714429953)));
  return (1.0 + r * g) / (1.0 + (0.5 - 2.0 / (3.0 * kPi)) * r);
}

// The same, over Lambert's rho / pi: one bounce (Eq. 2), and those after it (Eq. 20), which color the more the more of
// them there are.
vec3 roughDiffuse(SurfacePoint s, vec3 wo, vec3 wi, float NoV, float NoL) {
  float r = s.diffuseRoughness;
  float sines = dot(wi, wo) - NoL * NoV;
  float overT = sines > 0.0 ? sines / max(NoL, NoV) : sines;
  float share = 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * kPi)) * r);
  float once = share * (1.0 + r * overT);
  float mean = share * (1.0 + r * (2.0 / 3.0 - 28.0 / (15.0 * kPi)));
  // r > 0 only: 1 - mean is not zero.
  float lost = max(1.0 - albedoFON(NoV, r), 0.0) * max(1.0 - albedoFON(max(NoL, 0.0), r), 0.0) / (1.0 - mean);
  vec3 rho = s.albedo;
  return vec3(once) + rho * mean / (1.0 - rho * (1.0 - mean)) * lost;
}

// KHR_materials_iridescence, after Belcour, Barla 2017, "A Practical Extension to Microfacet Theory for the Modeling of
// Varying Iridescence", section 4: spectral sensitivities in Fourier space, to linear Rec.709. Lengths in nanometers.
vec3 sensitivity(float path, vec3 shift) {
  float phase = 2.0 * kPi * path * 1.0e-9;
  vec3 variance = vec3(4.3278e+09, 9.3046e+09, 6.6121e+09);
  vec3 xyz = vec3(5.4856e-13, 4.4201e-13, 5.2481e-13) * sqrt(2.0 * kPi * variance) *
             cos(vec3(1.6810e+06, 1.7953e+06, 2.2084e+06) * phase + shift) * exp(-phase * phase * variance);
  xyz.x += 9.7470e-14 * sqrt(2.0 * kPi * 4.5282e+09) * cos(2.2399e+06 * phase + shift.x) * exp(-4.5282e+09 * phase * phase);
  xyz /= 1.0685e-7;
  return vec3(3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
              -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
              0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z);
}

float normalReflectance(float n1, float n2) {
  float r = (n1 - n2) / (n1 + n2);
  return r * r;
}

// Reflectance of a film on a base of reflectance F0 in air; the numbers 1e-4, 1e-5 and 0.9999 are the extension's.
vec3 filmReflectance(vec3 F0, float film, float thickness, float c) {
  float s2 = (1.0 - c * c) / (film * film);
  if (s2 > 1.0) return vec3(1.0);
  float c2 = sqrt(1.0 - s2);
  vec3 root = sqrt(clamp(F0 + 1e-4, 0.0, 0.9999));
  vec3 base = (1.0 + root) / (1.0 - root);
  float R0 = normalReflectance(film, 1.0);
  float R12 = R0 + (1.0 - R0) * schlickWeight(c);
  vec3 R1 = vec3(normalReflectance(base.r, film), normalReflectance(base.g, film), normalReflectance(base.b, film));
  vec3 R23 = R1 + (1.0 - R1) * schlickWeight(c2);
  float T121 = 1.0 - R12;
  float path = 2.0 * film * thickness * c2;
  vec3 phi = vec3(film < 1.0 ? 0.0 : kPi) + vec3(base.r < film ? kPi : 0.0, base.g < film ? kPi : 0.0, base.b < film ? kPi : 0.0);
  vec3 R123 = clamp(R12 * R23, 1e-5, 0.9999);
  vec3 r123 = sqrt(R123);
  vec3 Rs = T121 * T121 * R23 / (1.0 - R123);
  vec3 I = R12 + Rs;
  vec3 Cm = Rs - T121;
  Cm *= r123;
  I += Cm * 2.0 * sensitivity(path, phi);
  Cm *= r123;
  I += Cm * 2.0 * sensitivity(2.0 * path, 2.0 * phi);
  return max(I, vec3(0.0));
}

struct FilmReflectance {
  vec3 mixed;     // of dielectric and metal below it
  float refused;  // by the dielectric: does not reach the diffuse base
};
FilmReflectance filmOf(SurfacePoint s, float cosine) {
  float c = clamp(cosine, 0.0, 1.0);
  vec3 dielectric = filmReflectance(s.dielectricColor, s.filmIndex, s.filmThickness, c);
  vec3 metal = filmReflectance(s.albedo, s.filmIndex, s.filmThickness, c);
  return FilmReflectance(interpolate(dielectric, metal, s.metallic), maxComponent(dielectric));
}

// The film's reflectance stands in for Fresnel's term, in the share that the factor says. Returns what no longer
// reaches the diffuse base.
float addFilm(SurfacePoint s, float VoH, float microfacets, float dielectricF, inout Lobe lobe) {
  FilmReflectance film = filmOf(s, VoH);
  float bare = 1.0 - s.iridescence;
  lobe.specular *= bare;
  lobe.fresnel = lobe.fresnel * bare + film.mixed * (microfacets * s.iridescence);
  return min(dielectricF * bare + film.refused * s.iridescence, 1.0);
}

// Turquin 2019, "Practical multiple scattering compensation for microfacet models", Eq. 16: f (1 + F0 (1 - E) / E).
// With F0 = 1 the albedo becomes 1 at every angle.
void compensate(SurfacePoint s, inout Lobe lobe) {
  vec3 more = s.specularColor * s.lostByOneBounce;
  lobe.fresnel += lobe.fresnel * more + s.specularColor * lobe.specular * more;
}

// KHR_materials_diffuse_transmission: Lambert on the other side. Light from behind meets the facets as its mirror image
// in the surface would.
void addTransmitted(SurfacePoint s, vec3 wo, vec3 wi, float NoL, inout Lobe lobe) {
  vec3 mirrored = wi - 2.0 * NoL * s.n;
  float weight = grazingWeight(dot(wo, safeNormalize(wo + mirrored, s.n)), s.dielectricF0, false);
  float F = s.dielectricF0 + (s.dielectricF90 - s.dielectricF0) * weight;
  float through = (1.0 - F) * max(-NoL, 0.0) / kPi;
  lobe.diffuse *= 1.0 - s.diffuseTransmission;
  lobe.transmitted = s.diffuseTransmissionColor * (s.diffuseTransmission * through);
}

// Estevez, Kulla 2017, "Production Friendly Microfacet Sheen BRDF", Eq. 2; rearranged: sin^2 from the cross product.
float D_Charlie(vec3 n, vec3 h, float alpha) {
  vec3 sine = cross(n, h);
  float inverse = 1.0 / alpha;
  return (2.0 + inverse) * pow(max(dot(sine, sine), 1e-30), 0.5 * inverse) / (2.0 * kPi);  // 0^n is not defined in GLSL
}

// The same, Eq. 3 with Table 1: a fit of log lambda.
float sheenCurve(float x, float alpha) {
  float t = (1.0 - alpha) * (1.0 - alpha);
  float a = 25.3245 * t + 21.5473 * (1.0 - t);
  float b = 3.32435 * t + 3.82987 * (1.0 - t);
  float c = 0.16801 * t + 0.19823 * (1.0 - t);
  float d = -1.27393 * t - 1.97760 * (1.0 - t);
  float e = -4.85967 * t - 4.32054 * (1.0 - t);
  return a / (1.0 + b * pow(max(x, 1e-30), c)) + d * x + e;
}

float lambdaSheen(float c, float alpha) {
  float low = sheenCurve(c, alpha);
  float high = 2.0 * sheenCurve(0.5, alpha) - sheenCurve(1.0 - c, alpha);
  return exp(c < 0.5 ? low : high);
}

// KHR_materials_sheen: the base is scaled by what the sheen leaves, seen from either side.
void addSheen(SurfacePoint s, vec3 h, float NoV, float NoL, inout Lobe lobe) {
  float strongest = maxComponent(s.sheenColor);
  float left = min(s.leftBySheen, 1.0 - strongest * albedosAt(abs(NoL), s.sheenRoughness).g);
  lobe.diffuse *= left;
  lobe.specular *= left;
  lobe.fresnel *= left;
  lobe.transmitted *= left;
  if (NoL > 0.0 && (s.lobes & kLobeSheen) != 0u) {
    float masking = 1.0 + lambdaSheen(NoV, s.sheenAlpha) + lambdaSheen(min(NoL, 1.0), s.sheenAlpha);
    lobe.fresnel += s.sheenColor * (D_Charlie(s.n, h, s.sheenAlpha) / (4.0 * NoV * masking));
  }
}

// KHR_materials_clearcoat, "Layering": index 1.5, its own normal and roughness; Fresnel's term against the viewer.
void addCoat(SurfacePoint s, vec3 h, vec3 wo, vec3 wi, inout Lobe lobe) {
  float NoL = dot(s.coatNormal, wi);
  float NoV = max(abs(dot(s.coatNormal, wo)), kUnitRoundoff);
  float coat = D_GGX(s.coatNormal, h, s.coatAlpha) * V_SmithGGXCorrelated(NoV, NoL, s.coatAlpha) * NoL;
  float left = 1.0 - s.coatWeight;
  lobe.diffuse *= left;
  lobe.specular *= left;
  lobe.transmitted *= left;
  bool counts = NoL > 0.0 && (s.lobes & kLobeCoat) != 0u;
  lobe.fresnel = lobe.fresnel * left + vec3(counts ? coat * s.coatWeight : 0.0);
}

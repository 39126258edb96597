// What the environment brings to the layers of a metallic-roughness surface. Lobes are GGX's convolved maps at the mirrored
// view; Fresnel's and the film's terms are those of the mirrored light. Exact for a constant environment but for iridescence.
#ifndef CROSSLIGHT_ENVIRONMENT_LAYERS_GLSL
#define CROSSLIGHT_ENVIRONMENT_LAYERS_GLSL

// Glossy light of the base: its mean radiance and the table's shares.
struct EnvironmentLobe {
  float NoV;
  vec3 glossy;
  vec3 table;
};

// One bounce by its albedo, those after it by what they leave: illum/layers.glsl, roughDiffuse().
vec3 roughAlbedo(SurfacePoint s, float NoV) {
  float r = s.diffuseRoughness;
  float once = albedoFON(NoV, r);
  float mean = (1.0 + r * (2.0 / 3.0 - 28.0 / (15.0 * kPi))) / (1.0 + (0.5 - 2.0 / (3.0 * kPi)) * r);
  return once + s.albedo * mean / (1.0 - s.albedo * (1.0 - mean)) * max(1.0 - once, 0.0);
}

// Returns what no longer reaches the diffuse base.
float environmentFilm(SurfacePoint s, EnvironmentLobe e, float refused, inout LightSums sums) {
  FilmReflectance film = filmOf(s, e.NoV);
  float bare = 1.0 - s.iridescence;
  sums.specular *= bare;
  sums.fresnel = sums.fresnel * bare + e.glossy * film.mixed * ((e.table.x + e.table.y) * s.iridescence);
  return min(refused * bare + film.refused * s.iridescence, 1.0);
}

void environmentCoat(SurfacePoint s, vec3 wo, inout LightSums sums) {
  float NoV = dot(s.coatNormal, wo);
  float roughness = sqrt(s.coatAlpha);
  vec3 table = environmentTable(abs(NoV), roughness);
  vec3 r = safeNormalize(2.0 * NoV * s.coatNormal - wo, s.coatNormal);
  float seen = (mirrored_ & kLobeCoat) != 0u ? 0.0 : s.coatWeight * (table.x + table.y);
  float left = 1.0 - s.coatWeight;
  sums.diffuse *= left;
  sums.specular *= left;
  sums.fresnel = sums.fresnel * left + seen * environmentGlossy(r, roughness);
}

void environmentSheen(SurfacePoint s, float NoV, inout LightSums sums) {
  sums.diffuse *= s.leftBySheen;
  sums.specular *= s.leftBySheen;
  // The lobe is as wide as the hemisphere: its mean radiance is about the diffuse one.
  vec3 mean = environmentIrradiance(s.n) / kPi;
  sums.fresnel = sums.fresnel * s.leftBySheen + s.sheenColor * mean * albedosAt(NoV, s.sheenRoughness).g;
}

void addEnvironmentLayers(SurfacePoint s, vec3 wo, EnvironmentLobe e, float refused, inout LightSums sums) {
  float lost = refused;
  if (CL_HAS(iridescence) && s.iridescence > 0.0) lost = environmentFilm(s, e, refused, sums);
  if (CL_HAS(iridescence) && s.iridescence > 0.0) sums.diffuse = environmentIrradiance(s.n) * ((1.0 - lost) / kPi);
  if (CL_HAS_TOO(diffuseRoughness) && s.diffuseRoughness > 0.0) sums.diffuse *= roughAlbedo(s, e.NoV);
  if (CL_HAS_TOO(energyCompensation) && frame.energyCompensation != 0u)
    sums.fresnel += (sums.fresnel + s.specularColor * sums.specular) * (s.specularColor * s.lostByOneBounce);
  if (CL_HAS(diffuseTransmission) && s.diffuseTransmission > 0.0) {
    vec3 through = environmentIrradiance(-s.n) * ((1.0 - refused) / kPi);
    sums.diffuse *= 1.0 - s.diffuseTransmission;
    sums.fresnel += s.diffuseTransmissionColor * (s.diffuseTransmission * through);
  }
  if (CL_HAS(sheen) && s.sheenAlpha > 0.0) environmentSheen(s, e.NoV, sums);
  if (CL_HAS(clearcoat) && s.coatWeight > 0.0) environmentCoat(s, wo, sums);
}
#endif

// Illumination models: one file per model, dispatched from the list. A model answers with numbers that multiply the
// light's intensities and the surface's colors, so that a lit value is linear in the colors: per-vertex lighting can be
// textured later without being computed again. (Energy compensation, iridescence and rough diffuse reflection are not
// linear; per-vertex lighting takes them at the color without textures.)
#ifndef CROSSLIGHT_ILLUMINATION_GLSL
#define CROSSLIGHT_ILLUMINATION_GLSL
#include "math/numeric.glsl"
#include "illum/fresnel.glsl"
#include "illum/albedo.glsl"

// Each term contains the cosine of the incident light where its model has one (fCos).
struct Lobe {
  vec3 diffuse;      // times light.diffuse times diffuseColor
  float specular;    // times light.specular times specularColor
  vec3 fresnel;      // times light.specular alone: what grazing angles and layers add whatever the color
  vec3 transmitted;  // times light.diffuse alone: from the other side; only with diffuseTransmission
};

Lobe lobeOf(float diffuse, float specular) { return Lobe(vec3(diffuse), specular, vec3(0.0), vec3(0.0)); }

// The lecture's W(theta): the highlight's coefficient follows the angle of incidence, from ks to 1.
Lobe classicLobe(SurfacePoint s, float diffuse, float highlight, float NdotL) {
  Lobe lobe = lobeOf(diffuse, highlight);
  if (CL_HAS_TOO(angularSpecular) && s.angularSpecular) {
    float weight = grazingWeight(NdotL, meanOf(s.specularColor), true);
    lobe.specular = highlight * (1.0 - weight);
    lobe.fresnel = vec3(highlight * weight);
  }
  return lobe;
}

#include "illum/lambert.glsl"
#include "illum/phong.glsl"
#include "illum/blinn_phong.glsl"
#include "illum/modified_phong.glsl"
#include "illum/oren_nayar.glsl"
#include "illum/cook_torrance_1982.glsl"
#include "illum/cook_torrance.glsl"

Lobe evaluateUnlit(SurfacePoint s, vec3 wo, vec3 wi) { return lobeOf(0.0, 0.0); }

Lobe evaluateModel(SurfacePoint s, vec3 wo, vec3 wi) {
  Lobe lobe = lobeOf(0.0, 0.0);
#define CL_MODEL_CASE(value, name, Stem, text) \
  if ((specModels & (1u << value)) != 0u && s.model == value) lobe = evaluate##Stem(s, wo, wi);
  CL_ILLUMINATION_MODELS(CL_MODEL_CASE)
#undef CL_MODEL_CASE
  return lobe;
}
#endif

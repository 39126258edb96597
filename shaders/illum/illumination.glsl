// Illumination models: one file per model, dispatched from the list. A model answers with numbers that multiply the
// light's intensities and the surface's colors, so that a lit value is linear in the colors: per-vertex lighting can be
// textured later without being computed again.
#ifndef CROSSLIGHT_ILLUMINATION_GLSL
#define CROSSLIGHT_ILLUMINATION_GLSL
#include "math/numeric.glsl"

// Each term contains the cosine of the incident light where its model has one (fCos).
struct Lobe {
  float diffuse;   // times light.diffuse times diffuseColor
  float specular;  // times light.specular times specularColor
  float fresnel;   // times light.specular alone: what grazing angles add whatever the color
};

#include "illum/lambert.glsl"
#include "illum/phong.glsl"
#include "illum/blinn_phong.glsl"
#include "illum/cook_torrance.glsl"

Lobe evaluateUnlit(SurfacePoint s, vec3 wo, vec3 wi) { return Lobe(0.0, 0.0, 0.0); }

Lobe evaluateModel(SurfacePoint s, vec3 wo, vec3 wi) {
  Lobe lobe = Lobe(0.0, 0.0, 0.0);
#define CL_MODEL_CASE(value, name, Stem, text) \
  if ((specModels & (1u << value)) != 0u && s.model == value) lobe = evaluate##Stem(s, wo, wi);
  CL_ILLUMINATION_MODELS(CL_MODEL_CASE)
#undef CL_MODEL_CASE
  return lobe;
}
#endif

// What a point's layers do to everything that comes from below them, for one viewer: worked out once per point, not
// once per light.
#ifndef CROSSLIGHT_SEEN_GLSL
#define CROSSLIGHT_SEEN_GLSL
#include "material/surface.glsl"
#include "illum/illumination.glsl"

// Else there is nothing to do.
const bool kHasLayers = ((specEffects & (kEffect_sheen | kEffect_clearcoat)) | (specMoreEffects & kEffect_energyCompensation)) != 0u;

SurfacePoint seenFrom(SurfacePoint s, vec3 wo) {
  if ((specModels & (1u << kModel_cookTorrance)) == 0u || s.model != kModel_cookTorrance) return s;
  float NoV = abs(dot(s.n, wo));
  float left = 1.0;
  if (CL_HAS_TOO(energyCompensation) && frame.energyCompensation != 0u) {
    float E = albedosAt(NoV, s.perceptualRoughness).r;
    s.lostByOneBounce = (1.0 - E) / E;
  }
  if (CL_HAS(sheen) && s.sheenAlpha > 0.0) {
    s.leftBySheen = 1.0 - maxComponent(s.sheenColor) * albedosAt(NoV, s.sheenRoughness).g;
    left = s.leftBySheen;
  }
  if (CL_HAS(clearcoat)) {  // KHR_materials_clearcoat: index 1.5; emission lies below the coat
    s.coatWeight = s.clearcoat * (0.04 + 0.96 * schlickWeight(abs(dot(s.coatNormal, wo))));
    left *= 1.0 - s.coatWeight;
    s.emission *= 1.0 - s.coatWeight;
  }
  if (CL_HAS(sheen) || CL_HAS(clearcoat)) {
    s.ambientColor *= left;
    s.transmissionColor *= left;
  }
  return s;
}
#endif

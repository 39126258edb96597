// Mirrors: where they send what they see, and how much of it.
#ifndef CROSSLIGHT_MIRROR_GLSL
#define CROSSLIGHT_MIRROR_GLSL
#include "material/surface.glsl"
#include "illum/illumination.glsl"

// A mirrored ray about a shading normal may point below the surface: it is then mirrored about the surface itself.
vec3 mirrorRay(vec3 d, vec3 n, vec3 ng) {
  vec3 r = safeNormalize(reflect(d, n), ng);
  return dot(r, ng) > 0.0 ? r : safeNormalize(reflect(d, ng), ng);
}

// Of a surface that has kMaterialMirror and bends nothing.
vec3 mirrorShare(MaterialRecord m, SurfacePoint s, float cosI) {
  float schlick = schlickWeight(cosI);
  return s.model == kModel_cookTorrance ? s.specularColor + (1.0 - s.specularColor) * schlick : m.mirror;
}
#endif

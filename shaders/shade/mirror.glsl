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

// What a clear coat adds to and takes from the ray mirrored by its base; the one ray follows the base's normal.
vec3 mirroredWithCoat(MaterialRecord m, SurfacePoint s, vec3 base) {
  uint mirrored = mirroredLobes(m);
  vec3 below = (mirrored & kLobeBase) != 0u ? base * (1.0 - s.coatWeight) : vec3(0.0);
  return below + ((mirrored & kLobeCoat) != 0u ? s.coatWeight : 0.0);
}

// Of a surface that has kMaterialMirror and bends nothing.
vec3 mirrorShare(MaterialRecord m, SurfacePoint s, float cosI) {
  if (s.model != kModel_cookTorrance) return m.mirror;
  vec3 base = s.specularColor + (s.F90 - s.specularColor) * schlickWeight(cosI);
  if (CL_HAS(clearcoat)) base = mirroredWithCoat(m, s, base);
  return base;
}
#endif

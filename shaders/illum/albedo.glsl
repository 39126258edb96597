// Albedos of microfacet lobes against direction, from the tables that the host integrates: rows by perceptual
// roughness, columns by the cosine to the normal, both from 0 to 1 with texels at both ends. r: GGX with F = 1;
// g: Charlie sheen, white. Absent (one texel) in scenes that need none; nobody asks then.
#ifndef CROSSLIGHT_ALBEDO_GLSL
#define CROSSLIGHT_ALBEDO_GLSL
#include "math/numeric.glsl"

vec4 albedosAt(float cosine, float perceptualRoughness) {
  vec2 at = clamp(vec2(cosine, perceptualRoughness), 0.0, 1.0) * float(kAlbedoTableSize - 1);
  vec2 base = min(floor(at), vec2(kAlbedoTableSize - 2));
  vec2 f = at - base;
  int first = int(base.y) * kAlbedoTableSize + int(base.x);
  vec4 low = interpolate(texelFetch(albedoTables, first), texelFetch(albedoTables, first + 1), f.x);
  int next = first + kAlbedoTableSize;
  vec4 high = interpolate(texelFetch(albedoTables, next), texelFetch(albedoTables, next + 1), f.x);
  return interpolate(low, high, f.y);
}
#endif

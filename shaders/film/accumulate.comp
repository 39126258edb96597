#version 460
// Adds one sample of every pixel to the film, compensated, and counts what is not finite.
#extension GL_GOOGLE_include_directive : require
#include "shared/entry.glsl"
#include "shared/structs.h"
#include "shared/bindings.h"

layout(local_size_x = 64) in;
// Film parts too: else nothing of them is compiled, since some drivers run both sides of a branch.
layout(constant_id = kSpecVariant) const uint specVariant = 1u;
const bool kAdaptive = (specVariant & kVariantActiveTiles) != 0u;
layout(push_constant, scalar) uniform PushBlock { FilmPush pushed; };
layout(set = 0, binding = kBindSampleColor, scalar) readonly buffer SampleBlock { vec4 samples[]; };
layout(set = 0, binding = kBindFilm, scalar) buffer FilmBlock { FilmPixel film[]; };
layout(set = 0, binding = kBindFilmParts, scalar) buffer PartsBlock { FilmParts parts[]; };
layout(set = 0, binding = kBindAovs, scalar) readonly buffer AovBlock { AovRecord aovs[]; };
layout(set = 0, binding = kBindCounters, scalar) buffer CounterBlock { uint counters[]; };
layout(set = 0, binding = kBindActiveTiles, scalar) readonly buffer ActiveTileBlock { uint activeTiles[]; };
layout(set = 0, binding = kBindMoments, scalar) buffer MomentBlock { PixelMoments moments[]; };

void addParts(uint pixel) {
  AovRecord aov = aovs[pixel];
  float w = pushed.weight;
  FilmParts p = FilmParts(w * aov.albedo, w * aov.ambient, w * aov.diffuse, w * aov.specular, w * aov.emission);
  if (pushed.firstSample == 0u) {
    FilmParts old = parts[pixel];
    p = FilmParts(old.albedo + p.albedo, old.ambient + p.ambient, old.diffuse + p.diffuse, old.specular + p.specular,
                  old.emission + p.emission);
  }
  parts[pixel] = p;
}

uint tileOf(uint pixel) {
  uint across = (pushed.width + kTileSize - 1u) / kTileSize;
  return pixel / pushed.width / kTileSize * across + pixel % pushed.width / kTileSize;
}

void addMoments(uint pixel, vec3 value) {
  PixelMoments m = PixelMoments(value, vec3(0.0), vec3(0.0));
  if (pushed.firstSample == 0u) {
    m = moments[pixel];
    vec3 d = value - m.first;
    m.sum += d;
    m.squares += d * d;
  }
  moments[pixel] = m;
}

void main() {
  uint pixel = gl_GlobalInvocationID.x;
  if (pixel >= pushed.pixelCount) return;
  if (kAdaptive && activeTiles[tileOf(pixel)] == 0u) return;
  vec4 value = samples[pixel];
  if (kAdaptive) addMoments(pixel, value.rgb);
  value *= pushed.weight;
  if (any(isnan(value)) || any(isinf(value))) {
    atomicAdd(counters[kCounterNonfinite], 1u);
    atomicMax(counters[kCounterFirstNonfinite], 0xffffffffu - (pushed.firstPixel + pixel));
  }
  // Kahan 1965, "Pracniques: Further Remarks on Reducing Truncation Errors".
  FilmPixel old = film[pixel];
  vec4 sum = pushed.firstSample != 0u ? vec4(0.0) : old.sum;
  vec4 carried = pushed.firstSample != 0u ? vec4(0.0) : old.compensation;
  precise vec4 y = value - carried;
  precise vec4 t = sum + y;
  precise vec4 c = (t - sum) - y;
  film[pixel] = FilmPixel(t, c);
  if ((specVariant & kVariantFilmParts) != 0u) addParts(pixel);
}

// Texture lookup in the texel buffer: wrap modes, bilinear or nearest, levels. Done in arithmetic rather than by the
// device's sampler, so that raster and rays read the same bits on every device (a sampler weighs with 8 bits).
//
// The rule of levels, one for raster and rays: a pixel is as wide at a point as the way of its light from the camera
// is long, times its width at distance 1; mirrors and refracting surfaces count as flat. That width over the cosine of
// incidence on the triangle, times the triangle's square root of texture area per area, is the pixel's size in texture
// coordinates (Akenine-Moller et al. 2019, "Texture Level of Detail Strategies for Real-Time Ray Tracing", Eq. 34, the
// footprint's longer axis). Level: its log2 in texels. Analytic shapes, cuts of alpha masks and what shadow rays pass
// read level 0.
#ifndef CROSSLIGHT_TEXTURE_GLSL
#define CROSSLIGHT_TEXTURE_GLSL
#include "math/numeric.glsl"
#include "shared/texture_flags.h"

int wrapTexel(int i, int size, uint mode) {
  int repeated = i - size * int(floor(float(i) / float(size)));
  int period = i - 2 * size * int(floor(float(i) / float(2 * size)));
  int mirrored = period < size ? period : 2 * size - 1 - period;
  int clamped = clamp(i, 0, size - 1);
  int wrapped = mode == 0u ? repeated : (mode == 1u ? mirrored : clamped);
  return clamp(wrapped, 0, size - 1);
}

vec4 texelAt(TextureSlot slot, ivec2 at) {
  int x = wrapTexel(at.x, int(slot.width), (slot.flags >> kTextureWrapShiftU) & 3u);
  int y = wrapTexel(at.y, int(slot.height), (slot.flags >> kTextureWrapShiftV) & 3u);
  return texelFetch(texels, int(slot.firstTexel) + y * int(slot.width) + x);
}

vec2 placeInTexture(TextureSlot slot, vec2 uv0, vec2 uv1) {
  vec2 uv = (slot.flags & kTextureUv1) != 0u ? uv1 : uv0;
  return mat2(slot.uvFromUvXy.xy, slot.uvFromUvXy.zw) * uv + slot.uvOffset;
}

vec4 sampleTexture(TextureSlot slot, vec2 uv0, vec2 uv1) {
  vec2 uv = placeInTexture(slot, uv0, uv1);
  // Beyond 2^20 periods the fraction has no digits left; this also keeps the integer conversion defined.
  uv = clamp(uv, vec2(-1048576.0), vec2(1048576.0));
  vec2 at = uv * vec2(slot.width, slot.height);
  bool nearest = (slot.flags & kTextureNearest) != 0u;
  at = nearest ? at : at - 0.5;
  vec2 base = floor(at);
  vec2 f = nearest ? vec2(0.0) : at - base;
  ivec2 i = ivec2(base);
  vec4 top = interpolate(texelAt(slot, i), texelAt(slot, i + ivec2(1, 0)), f.x);
  vec4 bottom = interpolate(texelAt(slot, i + ivec2(0, 1)), texelAt(slot, i + ivec2(1, 1)), f.x);
  return interpolate(top, bottom, f.y);
}

// The slot of one level: they lie one after the other.
TextureSlot levelOf(TextureSlot slot, int level) {
  for (int i = 0; i < level; ++i) {
    slot.firstTexel += slot.width * slot.height;
    slot.width = max(slot.width >> 1u, 1u);
    slot.height = max(slot.height >> 1u, 1u);
  }
  slot.flags = (slot.flags & ~kTextureNearest) | ((slot.flags & kTextureMinNearest) != 0u ? kTextureNearest : 0u);
  return slot;
}

// `footprint`: of the pixel in texture coordinates, by the set that the slot reads.
float levelFor(TextureSlot slot, float footprint) {
  float scale = abs(slot.uvFromUvXy.x * slot.uvFromUvXy.w - slot.uvFromUvXy.y * slot.uvFromUvXy.z);
  float texels = footprint * sqrt(float(slot.width) * float(slot.height) * scale);
  float last = floor(log2(float(max(slot.width, slot.height))));
  return texels > 1.0 ? min(log2(texels), last) : 0.0;
}

// One or two levels; a loop, because the code stands in shaders once per texture.
vec4 sampleTexture(TextureSlot slot, vec2 uv0, vec2 uv1, vec2 footprint) {
  float level = levelFor(slot, (slot.flags & kTextureUv1) != 0u ? footprint.y : footprint.x);
  bool minified = (slot.flags & kTextureMips) != 0u && level > 0.0;
  bool between = minified && (slot.flags & kTextureMipLinear) != 0u;
  float base = between ? floor(level) : floor(level + 0.5);
  float f = between ? level - base : 0.0;
  vec4 first = vec4(0.0), color = vec4(0.0);
  for (int i = 0; i < (f > 0.0 ? 2 : 1); ++i) {
    first = color;
    TextureSlot from = slot;
    if (minified) from = levelOf(slot, int(base) + i);
    color = sampleTexture(from, uv0, uv1);
  }
  if (f > 0.0) color = interpolate(first, color, f);
  return color;
}

bool hasTexture(TextureSlot slot) { return slot.firstTexel != kNoTexture; }
#endif

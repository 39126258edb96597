// Texture lookup in the texel buffer: wrap modes, bilinear or nearest, level 0. Done in arithmetic rather than by the
// device's sampler, so that raster and rays read the same bits on every device (a sampler weighs with 8 bits).
#ifndef CROSSLIGHT_TEXTURE_GLSL
#define CROSSLIGHT_TEXTURE_GLSL
#include "math/numeric.glsl"

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

vec4 sampleTexture(TextureSlot slot, vec2 uv0, vec2 uv1) {
  vec2 uv = (slot.flags & kTextureUv1) != 0u ? uv1 : uv0;
  uv = mat2(slot.uvFromUvXy.xy, slot.uvFromUvXy.zw) * uv + slot.uvOffset;
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

bool hasTexture(TextureSlot slot) { return slot.firstTexel != kNoTexture; }
#endif

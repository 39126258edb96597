// The film's codes: a linear color as a display shows it, by the host's own table, so that both give the same bits.
// A fetch per channel is all: an approximation of the curve with the table for doubtful values only costs more, as
// llvmpipe runs both sides of every branch.
#ifndef CROSSLIGHT_DISPLAY_GLSL
#define CROSSLIGHT_DISPLAY_GLSL
layout(set = 0, binding = kBindDisplayCodes) uniform usamplerBuffer displayCodes;

uint displayCodeOf(float linear) {
  uint bits = floatBitsToUint(smaller(greater(linear * pushed.displayGain, 0.0), 1.0));
  uint word = texelFetch(displayCodes, int(bits >> 16u)).x;
  return (word >> 17u) + ((bits & 0xffffu) >= (word & 0x1ffffu) ? 1u : 0u);
}

uint shownCodes(vec3 linear) {
  float zero = linear.r * 0.0 + linear.g * 0.0 + linear.b * 0.0;  // NaN unless all three are finite
  uint codes = displayCodeOf(linear.r) | displayCodeOf(linear.g) << 8u | displayCodeOf(linear.b) << 16u;
  return codes | (zero == 0.0 ? kFiniteCode : 0u);
}
#endif

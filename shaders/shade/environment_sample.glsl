// Directions into the environment for shadow rays: half of them in proportion to luminance, a texel by its share and then
// uniform in its solid angle, half in proportion to the cosine; weighted by the density of both together (Veach, Guibas
// 1995, "Optimally Combining Sampling Techniques", balance heuristic).
#ifndef CROSSLIGHT_ENVIRONMENT_SAMPLE_GLSL
#define CROSSLIGHT_ENVIRONMENT_SAMPLE_GLSL
#include "shade/environment.glsl"

struct EnvironmentSample {
  vec3 wi;
  vec3 radiance;  // of the texel
  float pdfSolidAngle;
};

uint rowShares() { return frame.environmentSize.x * frame.environmentSize.y; }
float rowShare(uint row) { return texelFetch(environmentTexels, int(rowShares() + row)).x; }
float texelShare(uint row, uint column) {
  return texelFetch(environmentTexels, int(row * frame.environmentSize.x + column)).w;
}
float sharesBefore(uint row) { return row == 0u ? 0.0 : rowShare(row - 1u); }
float sharesBefore(uint row, uint column) { return column == 0u ? 0.0 : texelShare(row, column - 1u); }

// The first whose share, up to and with it, is above u; 16 halvings are enough for any picture.
uint findRow(float u) {
  uint low = 0u, high = frame.environmentSize.y - 1u;
  for (int i = 0; i < 16; ++i) {
    uint middle = (low + high) / 2u;
    bool below = rowShare(middle) <= u;
    low = low < high && below ? middle + 1u : low;
    high = below ? high : middle;
  }
  return min(low, frame.environmentSize.y - 1u);
}
uint findColumn(uint row, float u) {
  uint low = 0u, high = frame.environmentSize.x - 1u;
  for (int i = 0; i < 16; ++i) {
    uint middle = (low + high) / 2u;
    bool below = texelShare(row, middle) <= u;
    low = low < high && below ? middle + 1u : low;
    high = below ? high : middle;
  }
  return min(low, frame.environmentSize.x - 1u);
}

// cos - cos as a product: the difference has no digits left in the rows of a large map.
float environmentSolidAngle(uint row) {
  vec2 size = vec2(frame.environmentSize);
  return 2.0 * kPi / size.x * 2.0 * sin(kPi * (float(row) + 0.5) / size.y) * sin(0.5 * kPi / size.y);
}

vec3 directionByLuminance(vec2 u) {
  uint row = findRow(u.y);
  uint column = findColumn(row, u.x);
  float x = (u.x - sharesBefore(row, column)) / (texelShare(row, column) - sharesBefore(row, column));
  float y = (u.y - sharesBefore(row)) / (rowShare(row) - sharesBefore(row));
  vec2 within = clamp(vec2(x, y), 0.0, 1.0);
  vec2 size = vec2(frame.environmentSize);
  float c0 = cos(kPi * float(row) / size.y), c1 = cos(kPi * float(row + 1u) / size.y);
  float c = c0 + (c1 - c0) * within.y;
  float s = sqrt(greater(1.0 - c * c, 0.0));
  float phi = 2.0 * kPi * ((float(column) + within.x) / size.x - 0.5);
  return fromEnvironment(vec3(sin(phi) * s, c, -cos(phi) * s));
}

vec3 directionByCosine(vec2 u, vec3 n) {
  vec3 t = anyPerpendicular(n);
  float r = sqrt(u.x);
  return r * (cos(2.0 * kPi * u.y) * t + sin(2.0 * kPi * u.y) * cross(n, t)) + sqrt(1.0 - u.x) * n;
}

EnvironmentSample sampleEnvironment(vec2 u, vec3 n, bool byCosine) {
  vec3 wi = byCosine ? directionByCosine(u, n) : directionByLuminance(u);
  uvec2 at = min(uvec2(environmentPlace(toEnvironment(wi)) * vec2(frame.environmentSize)), frame.environmentSize - 1u);
  float rowChance = rowShare(at.y) - sharesBefore(at.y);
  float columnChance = texelShare(at.y, at.x) - sharesBefore(at.y, at.x);
  float byLuminance = rowChance * columnChance / environmentSolidAngle(at.y);
  vec3 radiance = texelFetch(environmentTexels, int(at.y * frame.environmentSize.x + at.x)).rgb;
  return EnvironmentSample(wi, frame.environmentGain * radiance, 0.5 * (byLuminance + greater(dot(n, wi), 0.0) / kPi));
}
#endif

// Light from all directions: what is seen of it, and what it brings to a surface without anything in the way, from maps
// that the host has convolved (upload/environment_tables). By rays a share of that arrives: trace/shadow_environment.comp.
#ifndef CROSSLIGHT_ENVIRONMENT_GLSL
#define CROSSLIGHT_ENVIRONMENT_GLSL
#include "math/numeric.glsl"
#include "shared/environment_layout.h"

layout(set = 0, binding = kBindEnvironment) uniform samplerBuffer environmentTexels;

// In mirrors rays bring what glossy lobes would: whoever sends them says so before illuminate().
bool environmentMirrored_ = false;

bool hasEnvironment() { return CL_HAS(environment) && frame.environmentGain > 0.0; }

// From the scene's directions to the map's, and back.
vec3 toEnvironment(vec3 d) {
  vec2 t = frame.environmentTurn;
  return vec3(t.x * d.x - t.y * d.z, d.y, t.y * d.x + t.x * d.z);
}
vec3 fromEnvironment(vec3 d) {
  vec2 t = frame.environmentTurn;
  return vec3(t.x * d.x + t.y * d.z, d.y, t.x * d.z - t.y * d.x);
}

// Places of the map in [0,1]: the middle column is -Z, the upper edge +Y. atan2, since acos loses digits at the poles.
vec2 environmentPlace(vec3 d) {
  bool pole = d.x == 0.0 && d.z == 0.0;
  return vec2(0.5 + atan(d.x, pole ? 1.0 : -d.z) / (2.0 * kPi), atan(length(d.xz), d.y) / kPi);
}

vec3 environmentTexel(uint first, uvec2 size, int x, int y) {
  int w = int(size.x);
  int column = x < 0 ? x + w : (x >= w ? x - w : x);
  return texelFetch(environmentTexels, int(first) + clamp(y, 0, int(size.y) - 1) * w + column).rgb;
}

vec3 environmentAt(uint first, uvec2 size, vec2 place) {
  vec2 at = place * vec2(size) - 0.5;
  vec2 whole = floor(at);
  vec2 f = at - whole;
  int x = int(whole.x), y = int(whole.y);
  vec3 upper = interpolate(environmentTexel(first, size, x, y), environmentTexel(first, size, x + 1, y), f.x);
  vec3 lower = interpolate(environmentTexel(first, size, x, y + 1), environmentTexel(first, size, x + 1, y + 1), f.x);
  return interpolate(upper, lower, f.y);
}

vec3 environmentRadiance(vec3 d) {
  return frame.environmentGain * environmentAt(0u, frame.environmentSize, environmentPlace(toEnvironment(d)));
}

// What is seen where nothing is; fog without end covers it.
vec3 radianceBehind(vec3 d) {
  bool covered = CL_HAS(fog) && frame.fogMode != 0u && frame.fogByDepth == 0u;
  vec3 seen = frame.background;
  if (hasEnvironment() && !covered) seen = environmentRadiance(d);
  return seen;
}

const uvec2 kConvolvedSize = uvec2(kEnvironmentWidth, kEnvironmentHeight);
uint convolvedMap(uint level) {
  return frame.environmentSize.x * frame.environmentSize.y + frame.environmentSize.y +
         level * kEnvironmentWidth * kEnvironmentHeight;
}

vec3 environmentIrradiance(vec3 n) {
  return (frame.environmentGain * kPi) * environmentAt(convolvedMap(0u), kConvolvedSize, environmentPlace(toEnvironment(n)));
}

// Between two levels; the sharpest is the map itself.
vec3 environmentGlossy(vec3 r, float perceptualRoughness) {
  float level = clamp(perceptualRoughness, 0.0, 1.0) * float(kEnvironmentLevels);
  uint lower = min(uint(level), kEnvironmentLevels - 1u);
  vec2 place = environmentPlace(toEnvironment(r));
  bool sharp = lower == 0u;
  vec3 a = environmentAt(sharp ? 0u : convolvedMap(lower), sharp ? frame.environmentSize : kConvolvedSize, place);
  vec3 b = environmentAt(convolvedMap(lower + 1u), kConvolvedSize, place);
  return frame.environmentGain * interpolate(a, b, level - float(lower));
}

vec3 environmentTable(float NoV, float perceptualRoughness) {
  const float last = float(kEnvironmentTable - 1u);
  vec2 at = clamp(vec2(NoV, perceptualRoughness), 0.0, 1.0) * last;
  vec2 whole = min(floor(at), last - 1.0);
  vec2 f = at - whole;
  int first = int(convolvedMap(1u + kEnvironmentLevels)) + int(whole.y) * int(kEnvironmentTable) + int(whole.x);
  vec3 a = interpolate(texelFetch(environmentTexels, first).rgb, texelFetch(environmentTexels, first + 1).rgb, f.x);
  first += int(kEnvironmentTable);
  vec3 b = interpolate(texelFetch(environmentTexels, first).rgb, texelFetch(environmentTexels, first + 1).rgb, f.x);
  return interpolate(a, b, f.y);
}

// Classic lobes are looked up as the GGX lobe that is as wide, times their integral for a view along the normal:
// 2 pi / (n + 1) of (R.V)^n, and of (N.H)^n 8 pi (1 - 2^-(n+2)/2) / (n + 2).
float classicRoughness(SurfacePoint s) {
  float exponent = s.model == kModel_phong ? 4.0 * s.shininess : s.shininess;
  return sqrt(sqrt(2.0 / (exponent + 2.0)));
}
float classicIntegral(SurfacePoint s) {
  float n = s.shininess;
  float blinn = 8.0 * kPi * (1.0 - exp2(-0.5 * (n + 2.0))) / (n + 2.0);
  return s.model == kModel_lambert ? 0.0 : (s.model == kModel_phong ? 2.0 * kPi / (n + 1.0) : blinn);
}

// Karis 2013, "Real Shading in Unreal Engine 4": the lobe's mean radiance times its integral. The diffuse term of
// metallic-roughness is what the Fresnel term leaves, averaged over the hemisphere.
LightSums environmentSums(SurfacePoint s, vec3 wo) {
  bool physical = s.model == kModel_cookTorrance;
  float NoV = dot(s.n, wo);
  vec3 r = safeNormalize(2.0 * NoV * s.n - wo, s.n);
  float roughness = physical ? sqrt(s.alpha) : classicRoughness(s);
  vec3 table = environmentTable(abs(NoV), roughness);
  vec3 glossy = environmentMirrored_ ? vec3(0.0) : environmentGlossy(r, roughness);
  float refused = s.dielectricF0 + (1.0 - s.dielectricF0) * table.z;
  vec3 diffuse = environmentIrradiance(s.n) * (physical ? (1.0 - refused) / kPi : 1.0);
  bool unlit = s.model == kModel_unlit;
  float specular = physical ? table.x : classicIntegral(s);
  return LightSums(vec3(0.0), unlit ? vec3(0.0) : diffuse, unlit ? vec3(0.0) : glossy * specular,
                   physical ? glossy * table.y : vec3(0.0));
}
#endif

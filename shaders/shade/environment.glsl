// Light from all directions: what is seen of it, and what it brings to a surface without anything in the way, from maps
// that the host has convolved (upload/environment_tables). By rays a share of that arrives: trace/shadow_environment.comp.
#ifndef CROSSLIGHT_ENVIRONMENT_GLSL
#define CROSSLIGHT_ENVIRONMENT_GLSL
#include "math/numeric.glsl"
#include "shared/environment_layout.h"

layout(set = 0, binding = kBindEnvironment) uniform samplerBuffer environmentTexels;

// In mirrors rays bring what glossy lobes would, kLobe*: whoever sends them says so before illuminate().
uint mirrored_ = 0u;

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
// 2 pi / (n + 1) of (R.V)^n, pi of (n+2)/2 (R.V)^n N.L, and of (N.H)^n 8 pi (1 - 2^-(n+2)/2) / (n + 2). Cook and
// Torrance's of 1982 is 4 pi times a lobe of slope alpha.
float classicRoughness(SurfacePoint s) {
  bool aboutR = s.model == kModel_phong || s.model == kModel_modifiedPhong;
  float exponent = aboutR ? 4.0 * s.shininess : s.shininess;
  return s.model == kModel_cookTorrance1982 ? sqrt(s.roughnessAngle) : sqrt(sqrt(2.0 / (exponent + 2.0)));
}
float classicIntegral(SurfacePoint s) {
  float n = s.shininess;
  float blinn = 8.0 * kPi * (1.0 - exp2(-0.5 * (n + 2.0))) / (n + 2.0);
  float integral = s.model == kModel_phong ? 2.0 * kPi / (n + 1.0) : blinn;
  if (s.model == kModel_modifiedPhong) integral = kPi;
  return s.model == kModel_lambert || s.model == kModel_orenNayar ? 0.0 : integral;
}

// Oren and Nayar's reflectance of a constant environment: A + B 2/pi times the integral of sin(alpha) tan(beta)
// cos(theta) sin(theta), by which side of the viewer's angle theta is on.
float orenNayarAlbedo(SurfacePoint s, float NoV) {
  float sigma2 = s.roughnessAngle * s.roughnessAngle;
  float c = clamp(NoV, 0.0, 1.0), sine = sqrt(1.0 - c * c), angle = atan(sine, c);
  float nearer = 0.5 * sine * (angle - sine * c);
  // tan (1 - sin^3) / 3, which vanishes at grazing angles: 1 - sin = cos^2 / (1 + sin).
  float farther = sine * c * (1.0 + sine + sine * sine) / (3.0 * (1.0 + sine));
  return 1.0 - 0.5 * sigma2 / (sigma2 + 0.33) + 0.45 * sigma2 / (sigma2 + 0.09) * (2.0 / kPi) * (nearer + farther);
}

#include "shade/environment_layers.glsl"

// Karis 2013, "Real Shading in Unreal Engine 4": the lobe's mean radiance times its integral. The diffuse term of
// metallic-roughness is what the Fresnel term leaves, averaged over the hemisphere.
LightSums environmentSums(SurfacePoint s, vec3 wo) {
  if (s.model == kModel_unlit) return LightSums(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
  bool physical = s.model == kModel_cookTorrance;
  float NoV = dot(s.n, wo);
  vec3 r = safeNormalize(2.0 * NoV * s.n - wo, s.n);
  float alpha = s.alpha;
  if (CL_HAS(anisotropy) && s.alphaAlong > 0.0) alpha = sqrt(s.alpha * s.alphaAlong);
  float roughness = physical ? sqrt(alpha) : classicRoughness(s);
  vec3 table = environmentTable(abs(NoV), roughness);
  vec3 glossy = (mirrored_ & kLobeBase) != 0u ? vec3(0.0) : environmentGlossy(r, roughness);
  float refused = s.dielectricF0 + (s.dielectricF90 - s.dielectricF0) * table.z;
  vec3 diffuse = environmentIrradiance(s.n) * (physical ? (1.0 - refused) / kPi : 1.0);
  if (s.model == kModel_orenNayar) diffuse *= orenNayarAlbedo(s, NoV);
  float atNormal = physical ? table.x : classicIntegral(s);
  float atGrazing = physical ? table.y * s.F90 : 0.0;
  if (s.model == kModel_cookTorrance1982) {
    atNormal = 4.0 * kPi * table.x;
    atGrazing = 4.0 * kPi * table.y;
  } else if (CL_HAS_TOO(angularSpecular) && !physical && s.angularSpecular) {
    atGrazing = atNormal * grazingWeight(NoV, meanOf(s.specularColor), true);
    atNormal -= atGrazing;
  }
  LightSums sums = LightSums(vec3(0.0), diffuse, glossy * atNormal, glossy * atGrazing);
  if (s.model == kModel_cookTorrance1982 && s.indexed) {
    sums.specular = vec3(0.0);
    sums.fresnel = glossy * s.specularColor * (reflectanceOfSurface(s, 1.0) * atNormal + atGrazing);
  }
  if (physical) addEnvironmentLayers(s, wo, EnvironmentLobe(abs(NoV), glossy, table), refused, sums);
  return sums;
}
#endif

// Smoke, and bodies that scatter: media that absorb light and scatter it once on its way to the viewer. Raster and rays
// call the same functions; whoever includes this has lights at hand (CL_LIGHT).
#ifndef CROSSLIGHT_SMOKE_GLSL
#define CROSSLIGHT_SMOKE_GLSL
#include "light/light.glsl"
#include "shade/area_sample.glsl"

layout(set = 0, binding = kBindSmokeGrid) uniform samplerBuffer smokeGrid;

// Beyond this optical depth 1e-7 of the light is left: ways without an end are cut there.
const float kEndlessDepth = 16.0;

// Where the density is 1, per scene unit.
struct Scatterer {
  vec3 extinction;
  vec3 scattering;
  float anisotropy;  // g of Henyey and Greenstein 1941, -1..1
  bool even;         // the density is 1 all over
  bool body;         // not the smoke of the frame, but what is within a refracting body, and even
};

Scatterer theSmoke() {
  return Scatterer(frame.smokeAbsorption + frame.smokeScattering, frame.smokeScattering, frame.smokeAnisotropy,
                   frame.smokeGridX == 0u, false);
}

// The part of a way that lies in the medium, along a unit direction.
struct SmokeWay {
  vec3 origin;
  vec3 direction;
  float begin, end;  // none: end <= begin
};

bool smokeIsEven() { return frame.smokeGridX == 0u; }

vec2 slabs(vec3 origin, vec3 d) {
  vec3 a = (frame.smokeCenter - frame.smokeHalfSize - origin) / d, b = (frame.smokeCenter + frame.smokeHalfSize - origin) / d;
  vec3 near = min(a, b), far = max(a, b);
  // Along an axis the quotients are infinite, or NaN on a face, which counts as outside.
  return vec2(max(max(near.x, near.y), near.z), min(min(far.x, far.y), far.z));
}

// From the middle of the chord: no difference of large squares.
vec2 ballChord(vec3 origin, vec3 d) {
  float middle = dot(frame.smokeCenter - origin, d);
  vec3 across = (origin + middle * d - frame.smokeCenter) / frame.smokeHalfSize.x;
  float rest = 1.0 - dot(across, across);
  float halfChord = frame.smokeHalfSize.x * sqrt(max(rest, 0.0));
  return rest > 0.0 ? vec2(middle - halfChord, middle + halfChord) : vec2(0.0);
}

SmokeWay smokeAlong(vec3 origin, vec3 d, float distance) {
  vec2 span = vec2(0.0, distance);
  if (frame.smokeKind == kSmokeBox) span = slabs(origin, d);
  if (frame.smokeKind == kSmokeSphere) span = ballChord(origin, d);
  float begin = greater(span.x, 0.0), end = smaller(span.y, distance);
  vec3 extinction = frame.smokeAbsorption + frame.smokeScattering;
  float least = kLargest;
  for (int c = 0; c < 3; ++c) least = extinction[c] > 0.0 ? min(least, extinction[c]) : least;
  end = min(end, begin + kEndlessDepth / least);
  bool none = frame.smokeKind == kSmokeNone || !(end > begin);
  return SmokeWay(origin, d, none ? 0.0 : begin, none ? 0.0 : end);
}

// At the middles of the cells; four to a texel.
float cellDensity(ivec3 cell) {
  ivec3 counts = ivec3(frame.smokeGridX, frame.smokeGridY, frame.smokeGridZ);
  ivec3 at = clamp(cell, ivec3(0), counts - 1);
  int index = at.x + counts.x * (at.y + counts.y * at.z);
  return texelFetch(smokeGrid, index >> 2)[index & 3];
}

float smokeDensity(vec3 renderPos) {
  if (smokeIsEven()) return 1.0;
  vec3 counts = vec3(frame.smokeGridX, frame.smokeGridY, frame.smokeGridZ);
  vec3 at = ((renderPos - frame.smokeCenter) / frame.smokeHalfSize * 0.5 + 0.5) * counts - 0.5;
  ivec3 cell = ivec3(floor(at));
  vec3 f = at - vec3(cell);
  float density = 0.0;
  for (int k = 0; k < 8; ++k) {
    ivec3 corner = ivec3(k & 1, (k >> 1) & 1, k >> 2);
    vec3 weights = mix(1.0 - f, f, equal(corner, ivec3(1)));
    density += weights.x * weights.y * weights.z * cellDensity(cell + corner);
  }
  return density;
}

// Density times length, over a whole way: exact in even smoke, else the middles of the steps.
float smokeAmount(SmokeWay way, uint steps) {
  float length = way.end - way.begin;
  if (smokeIsEven()) return length;
  float sum = 0.0;
  for (uint k = 0u; k < steps; ++k)
    sum += smokeDensity(way.origin + (way.begin + length * ((float(k) + 0.5) / float(steps))) * way.direction);
  return sum * length / float(steps);
}

// Henyey, Greenstein 1941, "Diffuse radiation in the Galaxy", Eq. 2, over the sphere normalised to 1.
float scatteredTowards(float g, float cosAngle) {
  float below = max(1.0 + g * g - 2.0 * g * cosAngle, 1e-12);  // (1 - g)^2 > 0 but for rounding
  return (1.0 - g * g) / (4.0 * kPi * below * sqrt(below));
}

// Where a light sends its light from, to a point in smoke.
struct LightPlace {
  vec3 wi;
  float distance;
  float share;  // falloff; of a light with an area the solid angle
};

// Of a light with an area one place, chosen by `u`: over the steps of a way they add up to all of it.
LightPlace lightPlace(LightRecord light, vec3 p, vec2 u) {
  LightSample at = sampleLight(light, p);
  LightPlace place = LightPlace(at.wi, at.distance, at.falloff);
  if (isAreaLight(light)) {
    AreaFace f = faceOf(light, p);
    FaceSample s = sampleFace(f, u);
    vec3 to = reachLight(light, p, s.to);
    float area = f.circle ? kPi * f.radius * f.radius : (f.triangle ? 0.5 : 1.0);  // a polygon's axis has its area
    place = LightPlace(safeNormalize(to, vec3(0.0)), safeLength(to), f.shines ? area * s.weight : 0.0);
  }
  return place;
}

// Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences": fractions of the plastic number.
vec2 areaPlace(uint step, vec2 start) { return fract(start + float(step) * vec2(0.7548776662466927, 0.5698402909980532)); }

// What a light sends at a point towards the viewer, per unit of scattering, where `amount`, density times length, lies on
// its way.
vec3 scatteredLight(Scatterer medium, vec3 d, LightRecord light, LightPlace from, float amount) {
  if (!(from.share > 0.0)) return vec3(0.0);
  return light.diffuse * (from.share * scatteredTowards(medium.anisotropy, dot(from.wi, d))) * exp(-medium.extinction * amount);
}

// How much of the medium lies before a light. Of a body nobody knows it here: rays find the way out of it.
float amountTowards(Scatterer medium, vec3 p, LightPlace from) {
  return !medium.body && from.share > 0.0 ? smokeAmount(smokeAlong(p, from.wi, from.distance), max(frame.smokeSteps / 2u, 1u)) : 0.0;
}

// Steps: equal shares of what even smoke takes from the light, else equal lengths.
struct SmokeStep {
  float from, at, to;  // along the way, from where the smoke begins
};

float warped(Scatterer medium, float share, float length) {
  float sigma = (medium.extinction.r + medium.extinction.g + medium.extinction.b) / 3.0;
  if (!medium.even || !(sigma * length > 1e-3)) return share * length;  // the logarithm is a line there
  return min(-logOneMinus(share * oneMinusExp(sigma * length)) / sigma, length);
}

// `where`: of the sample within its step, 0..1.
SmokeStep smokeStep(Scatterer medium, SmokeWay way, uint step, float where) {
  float length = way.end - way.begin, count = float(frame.smokeSteps);
  float to = step + 1u == frame.smokeSteps ? length : warped(medium, (float(step) + 1.0) / count, length);
  return SmokeStep(warped(medium, float(step) / count, length), warped(medium, (float(step) + where) / count, length), to);
}

float densityAt(Scatterer medium, vec3 p) { return medium.body ? 1.0 : smokeDensity(p); }

vec3 smokePoint(SmokeWay way, SmokeStep s) { return way.origin + (way.begin + s.at) * way.direction; }

// Share of the light scattered in a step, of unit scattering, that reaches the viewer: the integral over the step.
// `before`: density times length between the viewer and the step.
vec3 smokeWeight(Scatterer medium, SmokeStep s, float before, float density) {
  vec3 extinction = medium.extinction;
  float length = s.to - s.from;
  vec3 depth = extinction * (density * length);
  vec3 weight = vec3(0.0);
  for (int c = 0; c < 3; ++c) {
    float share = depth[c] > 0.0 ? oneMinusExp(depth[c]) / extinction[c] : density * length;
    weight[c] = medium.scattering[c] * share * exp(-extinction[c] * before);
  }
  return weight;
}

struct Air {
  vec3 clear;  // share of the light that comes through
  vec3 light;  // what is added on the way
};

// All steps of a way. `lights`: from 0 on. `start`: in 0..1, of the places within the steps and on lights.
Air airOn(Scatterer medium, SmokeWay way, uint lights, vec3 start) {
  Air air = Air(vec3(1.0), vec3(0.0));
  if (!(way.end > way.begin)) return air;
  float before = 0.0;
  for (uint k = 0u; k < frame.smokeSteps; ++k) {
    SmokeStep s = smokeStep(medium, way, k, start.x);
    vec3 p = smokePoint(way, s);
    float density = densityAt(medium, p);
    vec3 arrives = frame.smokeAround;
    for (uint i = 0u; i < lights && specLights != 0u; ++i) {
      LightRecord light = CL_LIGHT(i);
      LightPlace from = lightPlace(light, p, areaPlace(k, start.yz));
      arrives += scatteredLight(medium, way.direction, light, from, amountTowards(medium, p, from));
    }
    air.light += smokeWeight(medium, s, medium.even ? s.from : before, density) * arrives;
    before += density * (s.to - s.from);
  }
  air.clear = exp(-medium.extinction * (medium.even ? way.end - way.begin : before));
  return air;
}

// `behind`: as throughFog() has it.
vec3 throughSmoke(vec3 color, vec3 behind, Air air) { return color * air.clear + air.light * (1.0 - behind); }
#endif

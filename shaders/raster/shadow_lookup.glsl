// How much of a light reaches a receiver, from the light's map: the share of texels around it where nothing is nearer
// to the light than the receiver's own plane.
#ifndef CROSSLIGHT_SHADOW_LOOKUP_GLSL
#define CROSSLIGHT_SHADOW_LOOKUP_GLSL
#include "raster/shadow_map.glsl"

layout(constant_id = kSpecShadowFilter) const uint specShadowFilter = 3u;
layout(set = 0, binding = kBindShadowTexels) uniform usamplerBuffer shadowTexels;
layout(set = 0, binding = kBindShadowLights, scalar) readonly buffer ShadowLightBlock { ShadowLight shadowLights[]; };

// The receiver's plane as the view has it; the includer knows what is lit.
vec4 receiverPlane(ShadowView view);

// A receiver with its plane in one view.
struct Lookup {
  ShadowView view;
  vec4 plane;
  vec3 q;      // in the view's coordinates
  vec2 place;  // in texels
  float texel; // its size at the receiver, scene units
};

// By how much the plane is moved towards the light before it is compared, in scene units: nothing nearer to it than
// that casts a shadow. The plane itself needs none of it (shadow_map.glsl), but the texels around may show triangles that
// go on from the receiver's in other planes. Within `reach` texels these rise by their slope against the plane times
// reach texels: slopes up to 1, folds up to 45 degrees, are let pass. The rest is rounding: planes of the same surface
// from other corners, each by some 30 roundings of coordinates as large as the scene's.
float planeOffset(Lookup at, float reach) { return reach * at.texel + gammaBound(32.0) * at.view.reach; }

vec4 movedToLight(ShadowView view, vec4 plane, float offset) {
  if (view.orthographic != 0u) return vec4(plane.xyz, plane.w - (plane.z < 0.0 ? -offset : offset));
  float left = max(abs(plane.w) - offset, 0.0);
  return vec4(plane.xyz, plane.w < 0.0 ? -left : left);
}

float wordAt(ShadowView view, uint layer, ivec2 texel) {
  uint size = view.size;
  return uintBitsToFloat(texelFetch(shadowTexels, int(view.firstTexel + layer * size * size + uint(texel.y) * size + uint(texel.x))).x);
}

// What transparent surfaces let pass: the product of all that lie on the texel, for what lies behind the first of them.
float passedAt(ShadowView view, ivec2 texel, float z) {
  uint size = view.size;
  uint word = view.firstTexel + 2u * size * size + 4u * (uint(texel.y) * size + uint(texel.x));
  float passed = uintBitsToFloat(texelFetch(shadowTexels, int(word)).x);
  return wordAt(view, 1u, texel) < z ? passed : 1.0;
}

// Where the plane is not seen at a texel, what is nearer than the receiver itself counts. A plane that was moved to the
// light or behind it is seen, and has nothing before it.
float receiverAtTexel(Lookup at, vec4 plane, ivec2 texel) {
  float z = distanceAt(at.view, plane, vec2(texel) + 0.5);
  bool ahead = at.view.orthographic != 0u || z >= 0.0;
  return ahead && abs(z) < kLargest ? z : at.q.z;
}

ivec2 insideMap(ShadowView view, ivec2 texel) { return clamp(texel, ivec2(0), ivec2(int(view.size) - 1)); }

float litAt(Lookup at, vec4 plane, ivec2 wanted) {
  ivec2 texel = insideMap(at.view, wanted);
  float z = receiverAtTexel(at, plane, texel);
  float lit = wordAt(at.view, 0u, texel) < z ? 0.0 : 1.0;
  if (CL_HAS(transparency) && at.view.layers > 1u) lit *= passedAt(at.view, texel, z);
  return lit;
}

// Reeves, Salesin, Cook 1987, "Rendering Antialiased Shadows with Depth Maps": the share of a square of `size` texels
// around the place, those at its border by the part that lies in it. One texel: the nearest. What is dark is summed, so
// that full light is 1 exactly.
float litShare(Lookup at, int size) {
  vec4 plane = movedToLight(at.view, at.plane, planeOffset(at, 0.5 * float(size + 1)));
  if (size == 1) return litAt(at, plane, ivec2(floor(at.place)));
  vec2 low = at.place - 0.5 * float(size);
  ivec2 first = ivec2(floor(low));
  vec2 cut = low - floor(low);
  float dark = 0.0;
  for (int j = 0; j <= size; ++j) {
    float row = j == 0 ? 1.0 - cut.y : (j == size ? cut.y : 1.0);
    for (int i = 0; i <= size; ++i) {
      float column = i == 0 ? 1.0 - cut.x : (i == size ? cut.x : 1.0);
      dark += row * column * (1.0 - litAt(at, plane, first + ivec2(i, j)));
    }
  }
  return max(1.0 - dark / float(size * size), 0.0);
}

// Half the width that a blocker at distance z leaves between light and shadow on the receiver, in texels of the map.
float penumbraTexels(Lookup at, float radius, float z) {
  float behind = max(at.q.z - z, 0.0);
  float perTexel = 2.0 * at.view.halfSize.x / float(at.view.size);
  return at.view.orthographic != 0u ? tan(radius) * behind / perTexel : radius * behind / (z * at.q.z * perTexel);
}

const int kSoftTaps = 8;  // a side

// From -1 to 1.
vec2 softTap(int i, int j) { return 2.0 * (vec2(i, j) + 0.5) / float(kSoftTaps) - 1.0; }

// Of all that a lamp may hide behind, the one nearest to it has the widest penumbra: how far blockers are looked for, in
// texels. Taps stand closer to each other near the receiver; 0: there are none.
float searchTexels(Lookup at, float radius, vec4 plane) {
  float nearest = at.q.z;
  for (int j = 0; j < kSoftTaps; ++j) {
    for (int i = 0; i < kSoftTaps; ++i) {
      vec2 t = softTap(i, j);
      ivec2 texel = insideMap(at.view, ivec2(floor(at.place + t * abs(t) * at.view.guard)));
      float z = wordAt(at.view, 0u, texel);
      nearest = z < receiverAtTexel(at, plane, texel) ? min(nearest, z) : nearest;
    }
  }
  return nearest < at.q.z ? min(penumbraTexels(at, radius, nearest) + 1.0, at.view.guard) : 0.0;
}

// Fernando 2005, "Percentage-Closer Soft Shadows": the mean distance of what may block the light says how wide a square to
// average over. A texel counts as a blocker only where its own penumbra reaches the receiver.
float softShare(Lookup at, float radius) {
  vec4 plane = movedToLight(at.view, at.plane, planeOffset(at, 1.0));
  float search = searchTexels(at, radius, plane);
  float count = 0.0, inverses = 0.0;
  for (int j = 0; j < kSoftTaps; ++j) {
    for (int i = 0; i < kSoftTaps; ++i) {
      vec2 offset = softTap(i, j) * search;
      ivec2 texel = insideMap(at.view, ivec2(floor(at.place + offset)));
      float z = wordAt(at.view, 0u, texel);
      bool blocks = z < receiverAtTexel(at, plane, texel) && length(offset) <= penumbraTexels(at, radius, z) + 1.0;
      count += blocks ? 1.0 : 0.0;
      inverses += blocks ? 1.0 / z : 0.0;
    }
  }
  float wide = min(count > 0.0 ? penumbraTexels(at, radius, count / inverses) : 0.0, at.view.guard);
  if (wide < 1.5) return litShare(at, 3);
  plane = movedToLight(at.view, at.plane, planeOffset(at, wide + 1.0));
  float dark = 0.0;
  for (int j = 0; j < kSoftTaps; ++j) {
    for (int i = 0; i < kSoftTaps; ++i)
      dark += 1.0 - litAt(at, plane, ivec2(floor(at.place + softTap(i, j) * wide)));
  }
  return 1.0 - dark / float(kSoftTaps * kSoftTaps);
}

Lookup lookupIn(ShadowView view, vec3 position) {
  Lookup at;
  at.view = view;
  at.plane = receiverPlane(view);
  at.q = inView(view, position);
  at.place = texelPlace(view, at.q);
  at.texel = 2.0 * view.halfSize.x / float(view.size) * (view.orthographic != 0u ? 1.0 : at.q.z);
  return at;
}

// Faces in the order +x, -x, +y, -y, +z, -z of render space.
uint faceOf(vec3 v) {
  vec3 a = abs(v);
  uint axis = a.x >= a.y && a.x >= a.z ? 0u : (a.y >= a.z ? 1u : 2u);
  return 2u * axis + (v[axis] < 0.0 ? 1u : 0u);
}

// The first one that has the place and the texels around it: cascades go from fine to coarse.
uint cascadeOf(ShadowLight light, vec3 position) {
  uint chosen = light.viewCount - 1u;
  for (uint i = light.viewCount - 1u; i > 0u; --i) {
    ShadowView view = shadowViews[light.firstView + i - 1u];
    vec2 place = texelPlace(view, inView(view, position));
    float size = float(view.size);
    bool inside = all(greaterThan(place, vec2(view.guard))) && all(lessThan(place, vec2(size - view.guard)));
    chosen = inside ? i - 1u : chosen;
  }
  return chosen;
}

float visibleByMap(uint index, vec3 position) {
  ShadowLight light = shadowLights[index];
  if (light.viewCount == 0u) return 1.0;
  uint view = light.firstView;
  if (light.kind == kShadowCube) view += faceOf(position - shadowViews[view].origin);
  else if (light.kind == kShadowCascades) view += cascadeOf(light, position);
  Lookup at = lookupIn(shadowViews[view], position);
  if (!(at.q.z > 0.0)) return 1.0;  // behind a spot, or where the light is
  if (specShadowFilter == 0u && light.radius > 0.0) return softShare(at, light.radius);
  return litShare(at, int(max(specShadowFilter, 1u)));
}
#endif

// Shadow maps: how a light sees the scene. A map's texel holds the distance along the view of what is nearest at the
// texel's center, computed from the triangle's plane by the same function as shading asks for its own triangle there. A
// surface that the map holds thus compares with itself in the same bits, whatever its slope; what the comparison must
// bear is that neighbouring triangles lie in other planes: see planeOffset().
#ifndef CROSSLIGHT_SHADOW_MAP_GLSL
#define CROSSLIGHT_SHADOW_MAP_GLSL
#include "shade/triangle.glsl"

layout(set = 0, binding = kBindShadowViews, scalar) readonly buffer ShadowViewBlock { ShadowView shadowViews[]; };

// Along the view's right, up and forward, from its origin.
vec3 inView(ShadowView view, vec3 renderPos) {
  vec3 p = renderPos - view.origin;
  return vec3(dot(p, view.right), dot(p, view.up), dot(p, view.forward));
}

vec3 turnedIntoView(ShadowView view, vec3 v) { return vec3(dot(v, view.right), dot(v, view.up), dot(v, view.forward)); }

// Normal and distance from the view's origin, of a triangle given in the view's coordinates.
vec4 planeOf(vec3 a, vec3 b, vec3 c) {
  vec3 n = triangleNormal(a, b, c, false);
  return vec4(n, dot(n, a));
}

// In texels, row by row from the corner where right and up are least.
vec2 texelPlace(ShadowView view, vec3 q) {
  vec2 at = view.orthographic != 0u ? q.xy : q.xy / q.z;
  return (at / view.halfSize + 1.0) * (0.5 * float(view.size));
}

// How far along the view a plane is at a place of the map, in texels. Not finite, or negative, where it is not seen.
float distanceAt(ShadowView view, vec4 plane, vec2 place) {
  vec2 at = (place * (2.0 / float(view.size)) - 1.0) * view.halfSize;
  float across = dot(plane.xy, at);
  return view.orthographic != 0u ? (plane.w - across) / plane.z : plane.w / (across + plane.z);
}
#endif

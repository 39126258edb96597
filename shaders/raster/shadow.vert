#version 460
// A triangle as a light sees it; corners are fetched, so that each knows its triangle's plane.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "shared/raster_bindings.h"
#include "raster/shadow_map.glsl"

layout(push_constant, scalar) uniform PushBlock { ShadowPush pushed; };
layout(location = 0) flat out vec4 outPlane;
layout(location = 1) flat out vec2 outNearAndFar;  // of the corners, along the view
layout(location = 2) out vec4 outTexCoords;        // uv0, uv1
layout(location = 3) out float outAlpha;           // of the vertex color

void main() {
  ShadowView view = shadowViews[pushed.view];
  TriangleCorners c = cornersOf(pushed.firstTriangle + uint(gl_VertexIndex) / 3u);
  uint corner = uint(gl_VertexIndex) % 3u;
  vec3 a = inView(view, c.v0), b = inView(view, c.v1), d = inView(view, c.v2);
  vec3 q = corner == 0u ? a : (corner == 1u ? b : d);
  outPlane = planeOf(a, b, d);
  outNearAndFar = vec2(min(min(a.z, b.z), d.z), max(max(a.z, b.z), d.z));
  // Reversed Z without a far plane: the depth is zNear / distance. Parallel light: 1 at the origin, 0 at zFar.
  bool parallel = view.orthographic != 0u;
  vec2 at = q.xy / view.halfSize;
  gl_Position = parallel ? vec4(at, 1.0 - q.z / view.zFar, 1.0) : vec4(at, view.zNear, q.z);
  outTexCoords = vec4(0.0);
  outAlpha = 1.0;
  if (CL_HAS(alphaMask) || CL_HAS(transparency)) {
    VertexAttributes v = attributesOf(corner == 0u ? c.i0 : (corner == 1u ? c.i1 : c.i2));
    outTexCoords = vec4(v.uv0, v.uv1);
    outAlpha = v.color.a;
  }
}

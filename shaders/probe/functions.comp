#version 460
// One function of the shaders on arguments that the host chooses: the code of every pipeline, without a scene around it.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "shared/probe_functions.h"
#include "math/random.glsl"
#include "accel/bvh.glsl"
#include "accel/shape.glsl"
#include "shade/optics.glsl"
#include "light/area_face.glsl"
#include "shade/mirror.glsl"

layout(local_size_x = 64) in;
layout(constant_id = kSpecProbe) const uint specProbe = 0u;
layout(set = 0, binding = kBindProbeArguments, scalar) readonly buffer ArgumentBlock { ProbeArguments arguments[]; };
layout(set = 0, binding = kBindProbeAnswers, scalar) buffer AnswerBlock { ProbeAnswer answers[]; };
layout(set = 0, binding = kBindProbeTriangles, scalar) readonly buffer TriangleBlock { vec3 corners[]; };

// max(a.b, 0)^n.
ProbeAnswer probe_powerOfCosine(ProbeArguments p) {
  return ProbeAnswer(vec4(powerOfCosine(p.a.xyz, p.b.xyz, p.a.w)), vec4(0.0));
}

ProbeAnswer probe_unitVector(ProbeArguments p) {
  return ProbeAnswer(vec4(safeNormalize(p.a.xyz, vec3(0.0)), safeLength(p.a.xyz)), vec4(0.0));
}

// Share of light that fog of this optical depth takes.
ProbeAnswer probe_fogged(ProbeArguments p) { return ProbeAnswer(vec4(oneMinusExp(p.a.x)), vec4(0.0)); }

// Direction a, normal b, ratio of indices a.w.
ProbeAnswer probe_refracted(ProbeArguments p) {
  vec3 t;
  bool passes = refractRay(p.a.xyz, p.b.xyz, p.a.w, t);
  return ProbeAnswer(vec4(t, passes ? 1.0 : 0.0), vec4(0.0));
}

// Cosine a.x, ratio of indices a.y.
ProbeAnswer probe_reflectance(ProbeArguments p) {
  return ProbeAnswer(vec4(fresnelDielectric(p.a.x, p.a.y)), vec4(0.0));
}

// Kind a.x, parameters b, origin c, direction d, range a.yz. Answers point, hit; normal, t.
ProbeAnswer probe_shape(ProbeArguments p) {
  ShapeHit h = hitShape(uint(p.a.x), p.b, p.c.xyz, p.d.xyz, p.a.y, p.a.z);
  return ProbeAnswer(vec4(h.p, h.hit ? 1.0 : 0.0), vec4(h.n, h.t));
}

// Corners a, b, c; origin in d, direction (a.w, b.w, c.w), end of the range d.w.
ProbeAnswer probe_triangle(ProbeArguments p) {
  TriangleHit h = hitTriangle(p.d.xyz, shearOf(vec3(p.a.w, p.b.w, p.c.w)), p.a.xyz, p.b.xyz, p.c.xyz, 0.0, p.d.w);
  return ProbeAnswer(vec4(h.t, h.b1, h.b2, h.hit ? 1.0 : 0.0), vec4(0.0));
}

// Box from a to b, origin c, direction d.
ProbeAnswer probe_slabs(ProbeArguments p) {
  vec3 inverse = 1.0 / p.d.xyz;
  Ray ray = Ray(p.c.xyz, p.d.xyz, 0.0, kLargest, kNoHit);
  BoxTest box = hitSlabs(p.a.xyz, p.b.xyz, ray, inverse, lessThan(inverse, vec3(0.0)));
  return ProbeAnswer(vec4(box.hit ? 1.0 : 0.0, box.tNear, 0.0, 0.0), vec4(0.0));
}

// Origin a, direction b, against every triangle of the list: how many it meets and the nearest distance.
ProbeAnswer probe_mesh(ProbeArguments p) {
  RayShear shear = shearOf(p.b.xyz);
  float count = 0.0;
  float nearest = kLargest;
  for (uint i = 0u; i + 2u < uint(corners.length()); i += 3u) {
    TriangleHit h = hitTriangle(p.a.xyz, shear, corners[i], corners[i + 1u], corners[i + 2u], 0.0, kLargest);
    count += h.hit ? 1.0 : 0.0;
    nearest = h.hit && h.t < nearest ? h.t : nearest;
  }
  return ProbeAnswer(vec4(count, nearest, 0.0, 0.0), vec4(0.0));
}

// Sample a.x of the sequence that a.y scrambles.
ProbeAnswer probe_samplePlace(ProbeArguments p) {
  return ProbeAnswer(vec4(owenSobol(uint(p.a.x), uint(p.a.y)), 0.0, 0.0), vec4(0.0));
}

// Direction a, a.w times reflected at normals b and c in turn.
ProbeAnswer probe_mirrored(ProbeArguments p) {
  vec3 d = p.a.xyz;
  int count = int(p.a.w);
  for (int i = 0; i < count; ++i) {
    vec3 n = (i & 1) == 0 ? p.b.xyz : p.c.xyz;
    d = mirrorRay(d, n, n);
  }
  return ProbeAnswer(vec4(d, 0.0), vec4(0.0));
}

// Two directions across the unit vector a.
ProbeAnswer probe_perpendicular(ProbeArguments p) {
  vec3 t = anyPerpendicular(p.a.xyz);
  return ProbeAnswer(vec4(t, 0.0), vec4(cross(p.a.xyz, t), 0.0));
}

// Texture coordinates of the point a of a sphere of radius a.w.
ProbeAnswer probe_sphericalPlace(ProbeArguments p) {
  return ProbeAnswer(vec4(sphericalUv(p.a.xyz, p.a.w), 0.0, 0.0), vec4(0.0));
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(arguments.length())) return;
#define CL_FUNCTION(value, name) \
  if (specProbe == value) answers[i] = probe_##name(arguments[i]);
  CL_PROBE_FUNCTIONS(CL_FUNCTION)
#undef CL_FUNCTION
}

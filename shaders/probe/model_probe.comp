#version 460
// What a surface sends towards wo of a white light of unit intensity from wi, at points that the host chooses: the same
// functions as raster and rays, without geometry and lights between.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#include "shade/shade.glsl"

layout(local_size_x = 64) in;
struct Probe {
  vec4 normal;   // w: bits of the material's index
  vec4 tangent;
  vec4 wo;       // w: u
  vec4 wi;       // w: v
};
layout(set = 0, binding = kBindRays, scalar) readonly buffer ProbeBlock { Probe probes[]; };
layout(set = 0, binding = kBindSampleColor, scalar) buffer AnswerBlock { vec4 answers[]; };

float lightVisibility(uint lightIndex) { return 1.0; }

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(probes.length())) return;
  Probe p = probes[i];
  SurfaceInput at;
  at.renderPos = vec3(0.0);
  at.normal = p.normal.xyz;
  at.geometricNormal = p.normal.xyz;
  at.tangent = p.tangent;
  at.uv0 = at.uv1 = vec2(p.wo.w, p.wi.w);
  at.color = vec4(1.0);
  at.materialId = floatBitsToUint(p.normal.w);
  at.frontFacing = true;
  at.colored = false;
  at.bothSides = false;
  at.footprint = vec2(0.0);
  at.alongU = vec3(1.0, 0.0, 0.0);  // texture coordinates are those of the plane z = 0
  at.alongV = vec3(0.0, 1.0, 0.0);
  SurfacePoint s = seenFrom(surfaceAt(at), p.wo.xyz);
  Lobe lobe = evaluateModel(s, p.wo.xyz, p.wi.xyz);
  LightSums sums = LightSums(vec3(0.0), lobe.diffuse, vec3(lobe.specular), lobe.fresnel + lobe.transmitted);
  answers[i] = vec4(sumOf(compose(s, sums, vec3(0.0))), 0.0);
}

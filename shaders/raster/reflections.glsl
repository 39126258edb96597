// What mirrors show in raster methods, per fragment whatever the method: the light is that of the surface's own picture,
// and the mirror's share of it is the tracer's.
#ifndef CROSSLIGHT_RASTER_REFLECTIONS_GLSL
#define CROSSLIGHT_RASTER_REFLECTIONS_GLSL
#include "shade/mirror.glsl"
#include "shade/optics.glsl"

layout(set = 0, binding = kBindReflectors, scalar) readonly buffer ReflectorBlock { Reflector reflectors[]; };
layout(set = 0, binding = kBindReflected) uniform samplerBuffer reflectedTexels;

// Every mirror's picture is made by the same camera turned over: the same pixel, counted from the other side.
vec3 ofPicture(Reflector r) {
  uvec2 at = uvec2(gl_FragCoord.xy);
  uint pixel = at.y * frame.resolution.x + (frame.resolution.x - 1u - at.x) - pushed.firstPixel;
  return texelFetch(reflectedTexels, int(r.firstTexel + pixel)).rgb;
}

vec3 cubeTexel(Reflector r, uint face, ivec2 at) {
  ivec2 inside = clamp(at, ivec2(0), ivec2(int(r.size) - 1));
  return texelFetch(reflectedTexels, int(r.firstTexel + face * r.size * r.size) + inside.y * int(r.size) + inside.x).rgb;
}

vec3 ofCube(Reflector r, vec3 d) {
  vec3 size = abs(d);
  uint a = size.x >= size.y && size.x >= size.z ? 0u : (size.y >= size.z ? 1u : 2u);
  float side = d[a] < 0.0 ? -1.0 : 1.0;
  vec2 at = vec2(d[(a + 1u) % 3u], side * d[(a + 2u) % 3u]) / size[a];  // to the right and down
  vec2 place = 0.5 * (at * float(r.size - 2u) + float(r.size)) - 0.5;   // a border of one pixel
  vec2 whole = floor(place), f = place - whole;
  ivec2 first = ivec2(whole);
  uint face = 2u * a + (side < 0.0 ? 1u : 0u);
  vec3 upper = interpolate(cubeTexel(r, face, first), cubeTexel(r, face, first + ivec2(1, 0)), f.x);
  vec3 lower = interpolate(cubeTexel(r, face, first + ivec2(0, 1)), cubeTexel(r, face, first + ivec2(1, 1)), f.x);
  return interpolate(upper, lower, f.y);
}

// Lagarde, Zanuttini 2012, "Local Image-based Lighting With Parallax-corrected Cubemaps": where the ray leaves the box,
// seen from the cube's center. From outside of the box: the direction alone.
vec3 ontoBox(Reflector r, vec3 position, vec3 d) {
  vec3 ahead = mix(r.lower, r.upper, greaterThan(d, vec3(0.0))) - position;
  float way = kLargest;
  for (int i = 0; i < 3; ++i) way = d[i] != 0.0 ? min(way, ahead[i] / d[i]) : way;
  return way > 0.0 && way < kLargest ? position + way * d - r.center : d;
}

// What of a surface's light comes by way of a mirror, through the air before it.
vec3 reflectedLight(SurfaceInput at, SurfacePoint s) {
  MaterialRecord m = drawMaterial;
  if ((m.flags & kMaterialMirror) == 0u) return vec3(0.0);
  vec3 wo = viewDirection(at.renderPos);
  vec3 ng = dot(s.ng, wo) < 0.0 ? -s.ng : s.ng;
  vec3 n = dot(s.n, ng) > 0.0 ? s.n : -s.n;
  float cosI = clamp(dot(wo, n), 0.0, 1.0);
  vec3 share = mirrorShare(m, s, cosI);
  float ior = max(m.indexOfRefraction, 1.0);
  bool entering = (m.flags & kMaterialThin) != 0u || at.frontFacing;
  if ((m.flags & kMaterialRefracts) != 0u && s.model == kModel_cookTorrance)
    share = vec3(fresnelDielectric(cosI, entering ? 1.0 / ior : ior));
  vec3 d = mirrorRay(-wo, n, ng);
  vec3 seen = radianceBehind(d);
  bool wholeWay = false;  // the picture has the fog between here and the camera too
  if (specReflections == kReflectionsByPictures) {
    Reflector r = reflectors[pushed.drawId];
    if (r.kind == kReflectorCube) seen = ofCube(r, ontoBox(r, at.renderPos, d));
    wholeWay = r.kind == kReflectorPicture;
    if (wholeWay) seen = ofPicture(r);
  }
  if (CL_HAS(fog)) {
    Fog air = fogOver(fogDistance(at.renderPos));
    seen = wholeWay ? seen - throughFog(vec3(0.0), vec3(0.0), air) : seen * air.clear;
  }
  return seenThroughSmoke(share * seen, vec3(1.0), at.renderPos);
}
#endif

// Fragment stage of every raster method: finds the surface, takes or computes its lighting, and either colors the
// pixel, as floats or as a display's codes (CL_CODES), or keeps its color in a list (CL_LAYERS), or (CL_AOV) records what
// is known about it. CL_CENTROID lights the triangle's centroid (flat shading).
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#ifndef CL_SUMS_MODE
#define CL_LIT_HERE
#endif
#include "raster/draw.glsl"
#include "shade/shade.glsl"
#include "raster/air.glsl"
#include "shade/triangle.glsl"
#include "shade/place_textures.glsl"
#include "raster/fragment_in.glsl"
#if !defined(CL_AOV) && !defined(CL_CODES)
#include "raster/reflections.glsl"
#endif

#ifdef CL_AOV
layout(early_fragment_tests) in;
layout(set = 0, binding = kBindAovs, scalar) writeonly buffer AovBlock { AovRecord aovs[]; };
#elif defined(CL_CODES)
layout(location = 0) out uint outCodes;
#include "raster/display.glsl"
#elif defined(CL_LAYERS)
layout(early_fragment_tests) in;
#include "shade/transparency.glsl"
#include "raster/layers.glsl"
#else
layout(location = 0) out vec4 outColor;
#endif

void placeOnTriangle(inout SurfaceInput at) {
  TriangleCorners c = cornersOf(pushed.firstTriangle + uint(gl_PrimitiveID));
  vec3 ng = triangleNormal(c.v0, c.v1, c.v2, (pushed.drawFlags & kDrawFlipsWinding) != 0u);
  TriangleUv uv = triangleUv(c.v0, c.v1, c.v2, uvsOf(c.i0), uvsOf(c.i1), uvsOf(c.i2), bumpReadsSecondSet(at.materialId));
  vec3 way = frame.orthographic != 0u ? frame.cameraForward : safeNormalize(at.renderPos, frame.cameraForward);
  placeTextures(uv, pixelWidthAtCamera() + dot(at.renderPos, frame.cameraForward) * pixelSpread(), way, ng, at);
}

SurfaceInput surfaceInput() {
  SurfaceInput at = interpolatedInput();
#if defined(CL_AOV) || defined(CL_CENTROID)
  TriangleCorners c = cornersOf(pushed.firstTriangle + uint(gl_PrimitiveID));
  at.geometricNormal = triangleNormal(c.v0, c.v1, c.v2, (pushed.drawFlags & kDrawFlipsWinding) != 0u);
#else
  // Only the fallback where the interpolated normal vanishes: the screen-space derivative is good enough for that.
  vec3 facing = safeNormalize(cross(dFdx(at.renderPos), dFdy(at.renderPos)), vec3(0.0, 0.0, 1.0));
  bool away = dot(facing, viewDirection(at.renderPos)) < 0.0;
  at.geometricNormal = away == gl_FrontFacing ? -facing : facing;
#endif
  if (kPlacesTextures) placeOnTriangle(at);
  return at;
}

#ifdef CL_SUMS_MODE
vec3 sumFrom(uint place, bool front) { return front ? CL_SUM_OF(litSums[place]) : CL_SUM_OF(litSums[kBack + place]); }
#endif

LightSums lighting(SurfacePoint s) {
#ifdef CL_SUMS_MODE
  bool front = gl_FrontFacing || !CL_HAS(twoSided);
  LightSums sums = LightSums(sumFrom(0u, front), vec3(0.0), vec3(0.0), vec3(0.0));
  if (kManySums) {
    sums.diffuse = sumFrom(kDiffuse, front);
    sums.specular = sumFrom(kSpecular, front);
    if (kSumsHaveFresnel) sums.fresnel = sumFrom(kFresnel, front);
  }
  return sums;
#else
  uint triangle = pushed.firstTriangle + uint(gl_PrimitiveID);
#ifdef CL_CENTROID
  TriangleCorners c = cornersOf(triangle);
  s.position = (c.v0 + c.v1 + c.v2) / 3.0;
  s.n = s.ng;
#endif
  if (kShadows != kShadowsOff) receiver_ = receiverOn(triangle, s.position, (pushed.drawFlags & kDrawFlipsWinding) != 0u);
  return illuminate(s, viewDirection(s.position), 0u, drawnLightCount());
#endif
}

#ifndef CL_AOV
vec3 litColor(SurfaceInput at, SurfacePoint s) {
#ifdef CL_SUMS_MODE
  LightSums sums = lighting(s);
  vec3 color = sums.ambient;  // as the vertex stage composed it
  if (kClampsColors) {        // only what textures do is left
    MaterialRecord m = drawMaterial;
    if (CL_HAS(baseColorTexture) && hasTexture(m.baseColorTexture)) color *= sampleTexture(m.baseColorTexture, at.uv0, at.uv1).rgb;
    if (CL_HAS(emissiveTexture) && hasTexture(m.emissiveTexture)) color += s.emission;
  } else if (kColorsMayVary) {
    vec3 composed = sumOf(compose(s, sums, frame.ambient));
    if (colorsVary(drawMaterial, at.colored)) color = composed;
  }
  return color;
#else
  vec3 color = sumOf(compose(s, lighting(s), frame.ambient));
  return (specVariant & kVariantClampVertexColors) != 0u ? clamp(color, 0.0, 1.0) : color;
#endif
}
#endif

#ifdef CL_AOV
void record(SurfaceInput at, SurfacePoint s, ShadedParts parts) {
  uint pixel = uint(gl_FragCoord.y) * frame.resolution.x + uint(gl_FragCoord.x) - pushed.firstPixel;
  DrawRecord draw = draws[pushed.drawId];
  AovRecord aov;
  aov.depth = dot(s.position, frame.cameraForward);
  aov.position = s.position;
  aov.normal = s.n;
  aov.geometricNormal = s.ng;
  aov.albedo = s.albedo;
  aov.uv = at.uv0;
  aov.instanceId = draw.instanceId;
  aov.primitiveId = draw.primitiveBase + pushed.firstTriangle + uint(gl_PrimitiveID) - draw.firstTriangle;
  aov.materialId = draw.materialId;
  aov.ambient = parts.ambient;
  aov.diffuse = parts.diffuse;
  aov.specular = parts.specular;
  aov.emission = parts.emission;
  aovs[pixel] = aov;
}
#endif

void main() {
  SurfaceInput at = surfaceInput();
  if (CL_HAS(alphaMask)) {
    MaterialRecord m = drawMaterial;
    if (cutByMask(m, baseAlphaAt(m, at.uv0, at.uv1, at.colored ? at.color.a : 1.0))) discard;
  }
  SurfacePoint s = surfaceAt(at);
  if (kReflects) mirrored_ = mirroredLobes(drawMaterial);
  if (kHasLayers) s = seenFrom(s, viewDirection(at.renderPos));
#ifdef CL_AOV
  record(at, s, compose(s, lighting(s), frame.ambient));
#elif defined(CL_LAYERS)
  Layer layer = layerOf(s, litColor(at, s));
  layer.color = seenThroughAir(layer.color, layer.passed, at.renderPos);
  if (kReflects) layer.color += reflectedLight(at, s);
  keepLayer(layer);
#elif defined(CL_CODES)
  outCodes = shownCodes(seenThroughAir(litColor(at, s), vec3(0.0), at.renderPos));
#ifdef CL_FLAT_CODES
  if (kShownByVertex) outCodes = gl_FrontFacing || !CL_HAS(twoSided) ? litSums[0].x : litSums[kBack].x;
#endif
#else
  vec3 color = seenThroughAir(litColor(at, s), vec3(0.0), at.renderPos);
  if (kReflects) color += reflectedLight(at, s);
  outColor = vec4(color, 1.0);
#endif
}

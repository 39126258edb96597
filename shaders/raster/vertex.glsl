// Vertex stage of every raster method. With CL_SUMS_MODE it also lights the vertex, front and back: to a color where
// the surface's colors are constant over a triangle, else to sums of light that the fragments multiply by their colors.
//
// specVariant bit 0 (kVariantClampVertexColors), OpenGL 1.x 2.13.6: the lit color of each side, without textures, is
// clamped to [0,1] here. The fragments multiply it by the base color texture (GL_MODULATE) and add emission that a
// texture varies, which OpenGL does not have.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#define CL_VERTEX_STAGE
#include "raster/draw.glsl"
#define CL_UNTEXTURED
#include "shade/shade.glsl"
#define CL_STAGE out
#include "raster/varyings.glsl"
#ifdef CL_FLAT_CODES
#include "raster/display.glsl"
#endif

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec4 inTangent;
layout(location = 3) in vec2 inUv0;
layout(location = 4) in vec2 inUv1;
layout(location = 5) in vec4 inColor;

// Depth passes and shading passes must agree bit for bit (DepthTest::equal).
invariant gl_Position;

#ifdef CL_SUMS_MODE
LightSums lightVertex(bool frontFacing) {
  SurfaceInput at = SurfaceInput(inPosition, inNormal, safeNormalize(inNormal, vec3(0.0, 0.0, 1.0)), inTangent, inUv0,
                                 inUv1, inColor, draws[pushed.drawId].materialId, frontFacing, (draws[pushed.drawId].flags & kDrawHasColors) != 0u, false, vec2(0.0), vec3(0.0), vec3(0.0));
  SurfacePoint s = surfaceAt(at);
  if (kReflects) mirrored_ = mirroredLobes(materials[at.materialId]);
  if (kHasLayers) s = seenFrom(s, viewDirection(inPosition));
  LightSums sums = illuminate(s, viewDirection(inPosition), 0u, drawnLightCount());
  bool whole = !kSeparateSums && (kClampsColors || !colorsVary(materials[at.materialId], at.colored));
  if (kClampsColors && CL_HAS(emissiveTexture) && hasTexture(materials[at.materialId].emissiveTexture)) s.emission = vec3(0.0);
  vec3 color = sumOf(compose(s, sums, frame.ambient));
  if (kClampsColors) color = clamp(color, 0.0, 1.0);
  if (whole) sums.ambient = color;
  return sums;
}

void passOn(LightSums sums, uint side) {
  litSums[side] = CL_PASSED_SUM(sums.ambient);
#ifdef CL_FLAT_CODES
  if (kShownByVertex) litSums[side].x = shownCodes(sums.ambient);
#endif
  if (kManySums) {
    litSums[side + kDiffuse] = CL_PASSED_SUM(sums.diffuse);
    litSums[side + kSpecular] = CL_PASSED_SUM(sums.specular);
    if (kSumsHaveFresnel) litSums[side + kFresnel] = CL_PASSED_SUM(sums.fresnel);
  }
}
#endif

void main() {
  gl_Position = frame.clipFromRender * vec4(inPosition, 1.0);
  if (CL_VARIES(Position)) passed[kPosition] = vec4(inPosition, 0.0);
  if (CL_VARIES(Normal)) passed[kNormal] = vec4(inNormal, 0.0);
  if (CL_VARIES(Tangent)) passed[kTangent] = inTangent;
  if (CL_VARIES(Uvs)) passed[kUvs] = vec4(inUv0, inUv1);
  if (CL_VARIES(Color)) passed[kColor] = inColor;
#ifdef CL_SUMS_MODE
  passOn(lightVertex(true), 0u);
  if (CL_HAS(twoSided)) passOn(lightVertex(false), kBack);
#endif
}

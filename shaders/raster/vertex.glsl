// Vertex stage of every raster method. With CL_SUMS_MODE it also lights the vertex, front and back.
//
// specVariant bit 0 (kVariantClampVertexColors), OpenGL 1.x 2.13.6: the lit color of each side, without textures, is
// clamped to [0,1] here and travels as the first of the sums, the others zero. The fragments multiply it by the base
// color texture (GL_MODULATE) and add emission that a texture varies, which OpenGL does not have.
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_bindings.glsl"
#define CL_UNTEXTURED
#include "shade/shade.glsl"
#define CL_STAGE out
#include "raster/varyings.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec4 inTangent;
layout(location = 3) in vec2 inUv0;
layout(location = 4) in vec2 inUv1;
layout(location = 5) in vec4 inColor;

// Depth passes and shading passes must agree bit for bit (DepthTest::equal).
invariant gl_Position;

float lightVisibility(uint lightIndex) { return 1.0; }

#ifdef CL_SUMS_MODE
LightSums lightVertex(bool frontFacing) {
  SurfaceInput at = SurfaceInput(inPosition, inNormal, safeNormalize(inNormal, vec3(0.0, 0.0, 1.0)), inTangent, inUv0,
                                 inUv1, inColor, draws[gl_InstanceIndex].materialId, frontFacing,
                                 (draws[gl_InstanceIndex].flags & kDrawHasColors) != 0u, false);
  SurfacePoint s = surfaceAt(at);
  LightSums sums = illuminate(s, viewDirection(inPosition), 0u, frame.lightCount);
  if ((specVariant & kVariantClampVertexColors) == 0u) return sums;
  if (CL_HAS(emissiveTexture) && hasTexture(materials[at.materialId].emissiveTexture)) s.emission = vec3(0.0);
  vec3 color = clamp(sumOf(compose(s, sums, frame.ambient)), 0.0, 1.0);
  return LightSums(color, vec3(0.0), vec3(0.0), vec3(0.0));
}
#endif

void main() {
  gl_Position = frame.clipFromRender * vec4(inPosition, 1.0);
  renderPos = inPosition;
  renderNormal = inNormal;
  renderTangent = inTangent;
  uvs = vec4(inUv0, inUv1);
  vertexColor = inColor;
  drawId = uint(gl_InstanceIndex);
#ifdef CL_SUMS_MODE
  LightSums front = lightVertex(true);
  frontAmbient = front.ambient;
  frontDiffuse = front.diffuse;
  frontSpecular = front.specular;
  frontFresnel = front.fresnel;
  backAmbient = backDiffuse = backSpecular = backFresnel = vec3(0.0);
  if (CL_HAS(twoSided)) {
    LightSums back = lightVertex(false);
    backAmbient = back.ambient;
    backDiffuse = back.diffuse;
    backSpecular = back.specular;
    backFresnel = back.fresnel;
  }
#endif
}

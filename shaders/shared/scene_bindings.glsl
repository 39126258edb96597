// The GLSL side of bindings.h: declarations only. An entry point includes this once.
#ifndef CROSSLIGHT_SCENE_BINDINGS_GLSL
#define CROSSLIGHT_SCENE_BINDINGS_GLSL
#include "entry.glsl"
#include "structs.h"
#include "lists.h"
#include "bindings.h"

layout(constant_id = kSpecModels) const uint specModels = 0xffffffffu;
layout(constant_id = kSpecLights) const uint specLights = 0xffffffffu;
layout(constant_id = kSpecShapes) const uint specShapes = 0xffffffffu;
layout(constant_id = kSpecEffects) const uint specEffects = 0xffffffffu;
layout(constant_id = kSpecVariant) const uint specVariant = 0u;
layout(constant_id = kSpecMoreEffects) const uint specMoreEffects = 0xffffffffu;

#define CL_EFFECT_ROW(bit, name) const uint kEffect_##name = 1u << bit;
CL_EFFECTS(CL_EFFECT_ROW)
#undef CL_EFFECT_ROW
#define CL_EFFECT_ROW(bit, name) const uint kEffect_##name = 1u << (bit - 32);
CL_MORE_EFFECTS(CL_EFFECT_ROW)
#undef CL_EFFECT_ROW
#define CL_MODEL_ROW(value, name, Stem, text) const uint kModel_##name = uint(value);
CL_ILLUMINATION_MODELS(CL_MODEL_ROW)
#undef CL_MODEL_ROW
#define CL_LIGHT_ROW(value, name, Stem, text) const uint kLightType_##name = uint(value);
CL_LIGHT_TYPES(CL_LIGHT_ROW)
#undef CL_LIGHT_ROW
const bool kHasAreaLights = (specLights & kAreaLightTypes) != 0u;
#define CL_HAS(name) ((specEffects & kEffect_##name) != 0u)
#define CL_HAS_TOO(name) ((specMoreEffects & kEffect_##name) != 0u)

layout(set = 0, binding = kBindFrame, scalar) uniform FrameBlock { FrameRecord frame; };
layout(set = 0, binding = kBindMaterials, scalar) readonly buffer MaterialBlock { MaterialRecord materials[]; };
layout(set = 0, binding = kBindLights, scalar) readonly buffer LightBlock { LightRecord lights[]; };
layout(set = 0, binding = kBindDraws, scalar) readonly buffer DrawBlock { DrawRecord draws[]; };
layout(set = 0, binding = kBindPositions) uniform usamplerBuffer positionTexels;
layout(set = 0, binding = kBindAttributes) uniform samplerBuffer attributeTexels;
layout(set = 0, binding = kBindIndices) uniform usamplerBuffer indexTexels;
layout(set = 0, binding = kBindShapes, scalar) readonly buffer ShapeBlock { ShapeRecord shapes[]; };
layout(set = 0, binding = kBindTexels) uniform samplerBuffer texels;
layout(set = 0, binding = kBindAlbedoTables) uniform samplerBuffer albedoTables;
layout(set = 0, binding = kBindBvhNodes) uniform usamplerBuffer bvhNodes;
layout(set = 0, binding = kBindBvhPrimitives) uniform usamplerBuffer bvhPrimitives;

layout(set = 0, binding = kBindWideNodes) uniform usamplerBuffer wideNodes;
layout(set = 0, binding = kBindQuadNodes) uniform usamplerBuffer quadNodes;
layout(set = 0, binding = kBindMaterialTexels) uniform usamplerBuffer materialTexels;
layout(set = 0, binding = kBindLightTexels) uniform usamplerBuffer lightTexels;
layout(set = 0, binding = kBindDrawTexels) uniform usamplerBuffer drawTexels;
layout(set = 0, binding = kBindShapeTexels) uniform usamplerBuffer shapeTexels;

layout(set = 0, binding = kBindInstances) uniform usamplerBuffer instanceTexels;
layout(set = 0, binding = kBindInstanceTriangles) uniform usamplerBuffer instanceTriangles;

#include "record_texels.glsl"

// Three words of a packed list, from the two texels that they may lie in: texel buffers may be sixteen times a storage
// buffer on llvmpipe, and a texel is one load.
uint texelOfWord(uint word) { return word >> 2u; }
uint nextTexelOfWord(uint word) { return (word + 2u) >> 2u; }
uvec3 threeWords(uvec4 first, uvec4 next, uint word) {
  uint shift = word & 3u;
  uvec3 low = shift == 0u ? first.xyz : first.yzw;
  uvec3 high = shift == 2u ? uvec3(first.zw, next.x) : uvec3(first.w, next.xy);
  return shift < 2u ? low : high;
}

// Vertices of a triangle.
uvec3 cornerIndices(uint triangle) {
  uint word = 3u * triangle;
  return threeWords(texelFetch(indexTexels, int(texelOfWord(word))), texelFetch(indexTexels, int(nextTexelOfWord(word))),
                    word);
}

vec3 positionOf(uint vertex) {
  uint word = 3u * vertex;
  return uintBitsToFloat(threeWords(texelFetch(positionTexels, int(texelOfWord(word))),
                                    texelFetch(positionTexels, int(nextTexelOfWord(word))), word));
}

VertexAttributes attributesOf(uint vertex) {
  int at = int(4u * vertex);
  vec4 normal = texelFetch(attributeTexels, at);
  vec4 uvs = texelFetch(attributeTexels, at + 2);
  return VertexAttributes(normal.xyz, normal.w, texelFetch(attributeTexels, at + 1), uvs.xy, uvs.zw,
                          texelFetch(attributeTexels, at + 3));
}
#endif

// The interface between the raster stages. CL_STAGE is `in` or `out`; CL_SUMS_MODE is the interpolation of lighting
// computed per vertex (`smooth` for Gouraud, `flat` for flat shading) and undefined where lighting is per fragment.
// Each varying costs time per vertex, triangle and pixel: both stages leave out those that specVaryings does not name.
layout(constant_id = kSpecVaryings) const uint specVaryings = kVaryingAll;
#define CL_VARIES(name) ((specVaryings & kVarying##name) != 0u)

layout(location = 0) CL_STAGE vec3 renderPos;
layout(location = 1) CL_STAGE vec3 renderNormal;
layout(location = 2) CL_STAGE vec4 renderTangent;
layout(location = 3) CL_STAGE vec4 uvs;  // uv0, uv1
layout(location = 4) CL_STAGE vec4 vertexColor;
#ifdef CL_SUMS_MODE
const bool kSeparateSums = (specVariant & kVariantSeparateSums) != 0u;
const bool kClampsColors = (specVariant & kVariantClampVertexColors) != 0u && !kSeparateSums;
const uint kColorEffects = kEffect_baseColorTexture | kEffect_metallicRoughnessTexture | kEffect_occlusionTexture |
                           kEffect_emissiveTexture | kEffect_vertexColors;
const bool kColorsMayVary = (specEffects & kColorEffects) != 0u;
// Else the first of the sums is the whole color, and the only one.
const bool kManySums = kSeparateSums || (kColorsMayVary && !kClampsColors);
const bool kSumsHaveFresnel = (specModels & (1u << kModel_cookTorrance)) != 0u;  // else these are zero

// Whether the surface's colors are the same all over a triangle: then its vertices are lit to the end. The material
// decides, not the plan, so that specialized and full pipelines agree.
bool colorsVary(MaterialRecord m, bool colored) {
  return (CL_HAS(baseColorTexture) && hasTexture(m.baseColorTexture)) ||
         (CL_HAS(metallicRoughnessTexture) && hasTexture(m.metallicRoughnessTexture)) ||
         (CL_HAS(occlusionTexture) && hasTexture(m.occlusionTexture)) ||
         (CL_HAS(emissiveTexture) && hasTexture(m.emissiveTexture)) || (CL_HAS(vertexColors) && colored);
}

layout(location = 5) CL_SUMS_MODE CL_STAGE vec3 frontAmbient;  // or the whole color
layout(location = 6) CL_SUMS_MODE CL_STAGE vec3 frontDiffuse;
layout(location = 7) CL_SUMS_MODE CL_STAGE vec3 frontSpecular;
layout(location = 8) CL_SUMS_MODE CL_STAGE vec3 frontFresnel;
layout(location = 9) CL_SUMS_MODE CL_STAGE vec3 backAmbient;  // these four only with the effect twoSided
layout(location = 10) CL_SUMS_MODE CL_STAGE vec3 backDiffuse;
layout(location = 11) CL_SUMS_MODE CL_STAGE vec3 backSpecular;
layout(location = 12) CL_SUMS_MODE CL_STAGE vec3 backFresnel;
#endif

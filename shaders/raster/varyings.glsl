// The interface between the raster stages. CL_STAGE is `in` or `out`; CL_SUMS_MODE is the interpolation of lighting
// computed per vertex (`smooth` for Gouraud, `flat` for flat shading) and undefined where lighting is per fragment.
// Each varying costs time per vertex, triangle and pixel: both stages leave out those that specVaryings does not name.
// Arrays as long as what is passed on, because drivers may keep variables that nobody reads: llvmpipe sets up every
// declared one for every triangle.
layout(constant_id = kSpecVaryings) const uint specVaryings = kVaryingAll;
#define CL_VARIES(name) ((specVaryings & kVarying##name) != 0u)

// Where each one is; 0, which exists, for those left out.
const uint kNormalPlace = uint(CL_VARIES(Position));
const uint kTangentPlace = kNormalPlace + uint(CL_VARIES(Normal));
const uint kUvsPlace = kTangentPlace + uint(CL_VARIES(Tangent));
const uint kColorPlace = kUvsPlace + uint(CL_VARIES(Uvs));
const uint kPassedCount = kColorPlace + uint(CL_VARIES(Color));
const uint kPosition = 0u;
const uint kNormal = kNormalPlace * uint(CL_VARIES(Normal));
const uint kTangent = kTangentPlace * uint(CL_VARIES(Tangent));
const uint kUvs = kUvsPlace * uint(CL_VARIES(Uvs));  // uv0, uv1
const uint kColor = kColorPlace * uint(CL_VARIES(Color));
layout(location = 0) CL_STAGE vec4 passed[kPassedCount + uint(kPassedCount == 0u)];

#ifdef CL_SUMS_MODE
const bool kSeparateSums = (specVariant & kVariantSeparateSums) != 0u;
const bool kClampsColors = (specVariant & (kVariantClampVertexColors | kVariantSeparateSums)) == kVariantClampVertexColors;
const uint kColorEffects = kEffect_baseColorTexture | kEffect_metallicRoughnessTexture | kEffect_occlusionTexture |
                           kEffect_emissiveTexture | kEffect_vertexColors;
const bool kColorsMayVary = (specEffects & kColorEffects) != 0u;
// Else the first of the sums is the whole color, and the only one. In integers: && and || make no constants.
const uint kMany = uint(kSeparateSums) | (uint(kColorsMayVary) & uint(!kClampsColors));
const bool kManySums = kMany != 0u;
// Else these are zero.
const bool kSumsHaveFresnel = ((specModels & (1u << kModel_cookTorrance | 1u << kModel_cookTorrance1982)) |
                               (specMoreEffects & kEffect_angularSpecular)) != 0u;

// Whether the surface's colors are the same all over a triangle: then its vertices are lit to the end. The material
// decides, not the plan, so that specialized and full pipelines agree.
bool colorsVary(MaterialRecord m, bool colored) {
  return (CL_HAS(baseColorTexture) && hasTexture(m.baseColorTexture)) ||
         (CL_HAS(metallicRoughnessTexture) && hasTexture(m.metallicRoughnessTexture)) ||
         (CL_HAS(occlusionTexture) && hasTexture(m.occlusionTexture)) ||
         (CL_HAS(emissiveTexture) && hasTexture(m.emissiveTexture)) || (CL_HAS(vertexColors) && colored);
}

// Sums of each side: ambient (or the whole color), then where there are many diffuse, specular, Fresnel. The back's
// only with the effect twoSided.
const uint kDiffuse = kMany;
const uint kSpecular = 2u * kMany;
const uint kFresnel = 3u * kMany * uint(kSumsHaveFresnel);
const uint kSums = 1u + 2u * kMany + kMany * uint(kSumsHaveFresnel);
const uint kBack = kSums * uint(CL_HAS(twoSided));
#ifdef CL_FLAT_CODES
// The bits of the sums; but where the color is whole, and the same all over the triangle, the word that the film takes.
const bool kShownByVertex = (specEffects & (kColorEffects | kEffect_fog | kEffect_smoke)) == 0u;
layout(location = 5) flat CL_STAGE uvec3 litSums[kSums + kBack];
#define CL_SUM_OF(sum) uintBitsToFloat(sum)
#define CL_PASSED_SUM(sum) floatBitsToUint(sum)
#else
layout(location = 5) CL_SUMS_MODE CL_STAGE vec3 litSums[kSums + kBack];
#define CL_SUM_OF(sum) (sum)
#define CL_PASSED_SUM(sum) (sum)
#endif
#endif

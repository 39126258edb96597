// From a material and a point's attributes to what illumination needs. The same function serves vertices, fragments
// and ray hits; CL_UNTEXTURED (per-vertex lighting) leaves textures to the fragments that follow.
#ifndef CROSSLIGHT_SURFACE_GLSL
#define CROSSLIGHT_SURFACE_GLSL
#include "math/numeric.glsl"
#include "material/texture.glsl"

// Where the record comes from: a list by index (rays), unless the includer has it at hand (raster, a draw's own).
#ifndef CL_MATERIAL
#define CL_MATERIAL(id) materialOf(id)
#define CL_LAYER_SLOT(id, layer) layerSlotOf(id, layer)
#endif

// Smallest GGX alpha that is evaluated: below it a lobe is narrower than fp32 directions resolve (NoH within 2^-24 of 1).
const float kSmallestAlpha = 1e-3;

struct SurfaceInput {
  vec3 renderPos;
  vec3 normal;           // interpolated, of any length, as the mesh has it
  vec3 geometricNormal;  // unit, of the front side
  vec4 tangent;
  vec2 uv0;
  vec2 uv1;
  vec4 color;
  uint materialId;
  bool frontFacing;
  bool colored;    // `color` counts
  bool bothSides;  // lit on the side that is seen whatever the material says: secondary rays
  vec2 footprint;  // size of the pixel in texture coordinates, uv0 and uv1; with mipmaps
  vec3 alongU;     // change of position per texture coordinate that the bump map reads; zero: none; with bumpMap
  vec3 alongV;
};

vec4 textureAt(TextureSlot slot, SurfaceInput at) {
  if (CL_HAS(mipmaps)) return sampleTexture(slot, at.uv0, at.uv1, at.footprint);
  return sampleTexture(slot, at.uv0, at.uv1);
}

// What lies over each other on a surface, as bits: an integral over a light takes them one by one.
const uint kLobeBase = 1u;
const uint kLobeCoat = 2u;
const uint kLobeSheen = 4u;
const uint kLobesAll = 7u;

// Those that a mirrored ray stands for: a smooth coat over a rough base mirrors alone.
uint mirroredLobes(MaterialRecord m) {
  bool mirror = (m.flags & kMaterialMirror) != 0u, coat = (m.flags & kMaterialCoatMirrors) != 0u;
  bool roughBase = m.perceptualRoughness * m.perceptualRoughness >= kSmallestAlpha && (m.flags & kMaterialRefracts) == 0u;
  uint base = coat && roughBase ? 0u : kLobeBase;
  return mirror ? base | (coat ? kLobeCoat : 0u) : 0u;
}

struct SurfacePoint {
  uint lobes;  // kLobe*: those whose glossy light counts
  vec3 position;
  vec3 n;    // unit, on the viewer's side where the surface is two-sided
  vec3 ng;   // unit, the same side as the viewer where two-sided
  uint model;
  vec3 ambientColor;
  vec3 diffuseColor;
  vec3 specularColor;  // ks, or F0
  vec3 albedo;
  vec3 emission;
  float shininess;
  float alpha;             // GGX
  float dielectricF0;
  float opacity;           // coverage and 1 - kt: how much of what is behind is hidden
  vec3 transmissionColor;  // weight of light that passes, Fresnel aside

  // Of some models or extensions only; who reads one asks first whether its effect is on.
  float roughnessAngle;   // orenNayar: sigma; cookTorrance1982: m
  bool angularSpecular;   // W(theta)
  bool indexed;           // the next two count
  vec3 refractiveIndex;
  vec3 extinction;
  float metallic;
  float perceptualRoughness;
  float dielectricF90;    // Fresnel's term of the dielectric at 90 degrees, and of the mix with metal
  float F90;
  vec3 dielectricColor;   // F0 of the dielectric; dielectricF0 is its largest part
  float diffuseRoughness;
  vec3 along;             // unit, across n: the direction of increased roughness
  float alphaAlong;       // 0: isotropic
  float iridescence;
  float filmIndex;
  float filmThickness;    // nanometers
  float diffuseTransmission;
  vec3 diffuseTransmissionColor;
  vec3 sheenColor;
  float sheenRoughness;
  float sheenAlpha;       // 0: no sheen
  float clearcoat;
  vec3 coatNormal;
  float coatAlpha;
  // Left to seenFrom(): what hangs on the viewer.
  float coatWeight;
  float leftBySheen;
  float lostByOneBounce;  // (1 - E) / E
};

vec3 mappedNormal(vec3 texel, float scale, SurfaceInput at, vec3 n) {
  // 8-bit 128 is zero exactly: (b - 128) / 127 instead of 2 b / 255 - 1, which would tilt a flat map by 0.3 degrees.
  vec3 local = max((texel * 255.0 - 128.0) / 127.0, vec3(-1.0)) * vec3(scale, scale, 1.0);
  vec3 t = safeNormalize(at.tangent.xyz - n * dot(n, at.tangent.xyz), vec3(0.0));
  vec3 b = cross(n, t) * at.tangent.w;
  return safeNormalize(t * local.x + b * local.y + n * local.z, n);
}

#include "material/bump.glsl"
#include "material/layers.glsl"

void setClassic(MaterialRecord m, vec3 base, inout SurfacePoint s) {
  s.ambientColor = m.ambientColor * base;
  s.diffuseColor = m.diffuseColor * base;
  s.specularColor = m.specularColor;
  s.albedo = s.diffuseColor;
  s.shininess = m.shininess;
  s.roughnessAngle = m.roughnessAngle;
  s.refractiveIndex = m.refractiveIndex;
  s.extinction = m.extinction;
  s.indexed = (m.flags & kMaterialIndexed) != 0u;
  s.angularSpecular = (m.flags & kMaterialAngularSpecular) != 0u;
}

// glTF 2.0, Appendix B.2: mix of a dielectric (F0 from the index of refraction) and a metal (F0 = base color).
void setMetallicRoughness(MaterialRecord m, LayerTexels layers, vec3 base, SurfaceInput at, inout SurfacePoint s) {
  float metallic = m.metallic;
  float roughness = m.perceptualRoughness;
#ifndef CL_UNTEXTURED
  if (CL_HAS(metallicRoughnessTexture) && hasTexture(m.metallicRoughnessTexture)) {
    vec4 texel = textureAt(m.metallicRoughnessTexture, at);
    metallic *= texel.b;
    roughness *= texel.g;
  }
#endif
  float ior = m.indexOfRefraction;
  float r = (ior - 1.0) / (ior + 1.0);
  s.dielectricF0 = ior == 0.0 ? 1.0 : r * r;
  s.alpha = max(roughness * roughness, kSmallestAlpha);
  float transmission = m.transmission;
  if (CL_HAS_TOO(transmissionTexture)) transmission *= layers.texel[kLayerTransmission].r;
  s.dielectricColor = vec3(s.dielectricF0);
  s.metallic = metallic;
  s.perceptualRoughness = roughness;
  if (CL_HAS_TOO(specularLayer) && (m.flags & kMaterialSpecularLayer) != 0u) setSpecularLayer(m, layers, metallic, s);
  s.albedo = base;
  s.ambientColor = base * (1.0 - transmission * (1.0 - metallic));
  s.diffuseColor = base * (1.0 - metallic) * (1.0 - transmission);
  s.specularColor = interpolate(s.dielectricColor, base, metallic);
  s.transmissionColor = base * transmission * (1.0 - metallic);
  s.diffuseTransmission = 0.0;
  if (CL_HAS(diffuseTransmission)) setDiffuseTransmission(m, layers, (1.0 - metallic) * (1.0 - transmission), s);
}

SurfacePoint surfaceAt(SurfaceInput at) {
  MaterialRecord m = CL_MATERIAL(at.materialId);
  SurfacePoint s;
  s.lobes = kLobesAll;
  s.position = at.renderPos;
  s.model = m.model;
  s.shininess = 0.0;
  s.alpha = 1.0;
  s.dielectricF0 = 0.04;
  s.dielectricF90 = 1.0;
  s.F90 = 1.0;
  s.transmissionColor = vec3(m.transmission);

  bool flip = CL_HAS(twoSided) && !at.frontFacing &&
              (at.bothSides || ((m.flags & kMaterialDoubleSided) | frame.twoSided) != 0u);
  s.ng = flip ? -at.geometricNormal : at.geometricNormal;
  vec3 n = safeNormalize(at.normal, at.geometricNormal);
#ifndef CL_UNTEXTURED
  if (CL_HAS(normalMap) && hasTexture(m.normalTexture) && at.tangent.w != 0.0)
    n = mappedNormal(textureAt(m.normalTexture, at).xyz, m.normalScale, at, n);
#endif
#ifndef CL_UNTEXTURED
  if (CL_HAS(bumpMap) && hasTexture(m.bumpTexture)) n = bumpedNormal(m, at, n);
#endif
  s.n = flip ? -n : n;

  vec4 base = m.baseColor;
  if (CL_HAS(vertexColors) && at.colored) base *= at.color;
  s.emission = m.emission;
#ifndef CL_UNTEXTURED
  if (CL_HAS(baseColorTexture) && hasTexture(m.baseColorTexture)) base *= textureAt(m.baseColorTexture, at);
  if (CL_HAS(emissiveTexture) && hasTexture(m.emissiveTexture)) s.emission *= textureAt(m.emissiveTexture, at).rgb;
#endif
  bool blends = (m.flags & kMaterialAlphaBlend) != 0u;
  bool physical = m.model == kModel_cookTorrance || m.model == kModel_unlit;
  s.opacity = (blends ? base.a : 1.0) * (physical ? 1.0 : 1.0 - m.transmission);

  setClassic(m, base.rgb, s);
  if ((specModels & (1u << kModel_cookTorrance)) != 0u && m.model == kModel_cookTorrance) {
    LayerTexels layers = layerTexels(at);
    setMetallicRoughness(m, layers, base.rgb, at, s);
    setLayers(m, layers, at, flip, s);
  }
  if ((specModels & (1u << kModel_unlit)) != 0u && m.model == kModel_unlit) {  // the base color stands for all light
    s.emission = base.rgb;
    s.albedo = base.rgb;
    s.ambientColor = vec3(0.0);
    s.diffuseColor = vec3(0.0);
    s.specularColor = vec3(0.0);
  }
#ifndef CL_UNTEXTURED
  if (CL_HAS(occlusionTexture) && hasTexture(m.occlusionTexture)) {
    float occlusion = textureAt(m.occlusionTexture, at).r;
    s.ambientColor *= 1.0 + m.occlusionStrength * (occlusion - 1.0);
  }
#endif
  return s;
}

// Share of light that an occlusion test lets pass, and whether the surface is there at all (alpha mask).
// `vertexAlpha` is 1 where the mesh has no colors.
float baseAlphaAt(MaterialRecord m, vec2 uv0, vec2 uv1, float vertexAlpha) {
  float alpha = m.baseColor.a;
  if (CL_HAS(vertexColors)) alpha *= vertexAlpha;
  if (CL_HAS(baseColorTexture) && hasTexture(m.baseColorTexture)) alpha *= sampleTexture(m.baseColorTexture, uv0, uv1).a;
  return alpha;
}

bool cutByMask(MaterialRecord m, float alpha) {
  return (m.flags & kMaterialAlphaMask) != 0u && alpha < m.alphaCutoff;
}
#endif

// Records taken apart from texels. A texel is one load of 16 bytes where a storage buffer's record is one load per word
// and lane on llvmpipe; what is not used is not fetched. The order is that of structs.h.
#ifndef CROSSLIGHT_RECORD_TEXELS_GLSL
#define CROSSLIGHT_RECORD_TEXELS_GLSL

vec3 asVec3(uint x, uint y, uint z) { return uintBitsToFloat(uvec3(x, y, z)); }
vec4 asVec4(uint x, uint y, uint z, uint w) { return uintBitsToFloat(uvec4(x, y, z, w)); }

DrawRecord drawOf(uint draw) {
  uvec4 a = texelFetch(drawTexels, int(2u * draw));
  uvec4 b = texelFetch(drawTexels, int(2u * draw + 1u));
  return DrawRecord(a.x, a.y, a.z, a.w, b.x, b.y, 0u, 0u);
}

LightRecord lightOf(uint light) {
  int at = int(8u * light);
  uvec4 a = texelFetch(lightTexels, at), b = texelFetch(lightTexels, at + 1), c = texelFetch(lightTexels, at + 2);
  uvec4 d = texelFetch(lightTexels, at + 3), e = texelFetch(lightTexels, at + 4), f = texelFetch(lightTexels, at + 5);
  uvec4 g = uvec4(0u), h = uvec4(0u);
  if (kHasAreaLights) {
    g = texelFetch(lightTexels, at + 6);
    h = texelFetch(lightTexels, at + 7);
  }
  return LightRecord(a.x, a.y, asVec3(a.z, a.w, b.x), asVec3(b.y, b.z, b.w), asVec3(c.x, c.y, c.z),
                     asVec3(c.w, d.x, d.y), asVec3(d.z, d.w, e.x), asVec3(e.y, e.z, e.w), uintBitsToFloat(f.x),
                     uintBitsToFloat(f.y), uintBitsToFloat(f.z), uintBitsToFloat(f.w), asVec3(g.x, g.y, g.z),
                     asVec3(g.w, h.x, h.y), uintBitsToFloat(h.z), h.w);
}

ShapeRecord shapeOf(uint shape) {
  int at = int(7u * shape);
  uvec4 a = texelFetch(shapeTexels, at), b = texelFetch(shapeTexels, at + 1), c = texelFetch(shapeTexels, at + 2);
  uvec4 d = texelFetch(shapeTexels, at + 3), e = texelFetch(shapeTexels, at + 4), f = texelFetch(shapeTexels, at + 5);
  uvec4 g = texelFetch(shapeTexels, at + 6);
  return ShapeRecord(a.x, a.y, asVec3(a.z, a.w, b.x),
                     mat3(asVec3(b.y, b.z, b.w), asVec3(c.x, c.y, c.z), asVec3(c.w, d.x, d.y)),
                     mat3(asVec3(d.z, d.w, e.x), asVec3(e.y, e.z, e.w), asVec3(f.x, f.y, f.z)),
                     asVec4(f.w, g.x, g.y, g.z), g.w);
}

// A slot is ten words: every other one begins in the middle of a texel.
TextureSlot evenSlot(int at) {
  uvec4 a = texelFetch(materialTexels, at), b = texelFetch(materialTexels, at + 1), c = texelFetch(materialTexels, at + 2);
  return TextureSlot(a.x, a.y, a.z, a.w, asVec4(b.x, b.y, b.z, b.w), uintBitsToFloat(c.xy));
}
TextureSlot oddSlot(int at) {
  uvec4 a = texelFetch(materialTexels, at), b = texelFetch(materialTexels, at + 1), c = texelFetch(materialTexels, at + 2);
  return TextureSlot(a.z, a.w, b.x, b.y, asVec4(b.z, b.w, c.x, c.y), uintBitsToFloat(c.zw));
}

// What glTF's extensions add; in a plan without them none of it is read.
const uint kLayerEffects = kEffect_bumpMap | kEffect_clearcoat | kEffect_sheen | kEffect_anisotropy | kEffect_iridescence |
                           kEffect_diffuseTransmission;
const uint kMoreLayerEffects = kEffect_specularLayer | kEffect_transmissionTexture | kEffect_diffuseRoughness;
const bool kReadsLayers = ((specEffects & kLayerEffects) | (specMoreEffects & kMoreLayerEffects) |
                           (specModels & (1u << kModel_orenNayar | 1u << kModel_cookTorrance1982))) != 0u;

void readLayers(int at, inout MaterialRecord m) {
  uvec4 a = texelFetch(materialTexels, at), b = texelFetch(materialTexels, at + 1), c = texelFetch(materialTexels, at + 2);
  uvec4 d = texelFetch(materialTexels, at + 3), e = texelFetch(materialTexels, at + 4), f = texelFetch(materialTexels, at + 5);
  uvec4 g = texelFetch(materialTexels, at + 6), h = texelFetch(materialTexels, at + 7);
  m.roughnessAngle = uintBitsToFloat(a.x);
  m.diffuseRoughness = uintBitsToFloat(a.y);
  m.clearcoat = uintBitsToFloat(a.z);
  m.clearcoatRoughness = uintBitsToFloat(a.w);
  m.refractiveIndex = asVec3(b.x, b.y, b.z);
  m.clearcoatNormalScale = uintBitsToFloat(b.w);
  m.extinction = asVec3(c.x, c.y, c.z);
  m.specularFactor = uintBitsToFloat(c.w);
  m.specularTint = asVec3(d.x, d.y, d.z);
  m.sheenRoughness = uintBitsToFloat(d.w);
  m.sheenColor = asVec3(e.x, e.y, e.z);
  m.anisotropy = uintBitsToFloat(e.w);
  m.diffuseTransmissionColor = asVec3(f.x, f.y, f.z);
  m.diffuseTransmission = uintBitsToFloat(f.w);
  m.anisotropyDirection = uintBitsToFloat(g.xy);
  m.iridescence = uintBitsToFloat(g.z);
  m.filmIndex = uintBitsToFloat(g.w);
  m.filmThinnest = uintBitsToFloat(h.x);
  m.filmThickest = uintBitsToFloat(h.y);
  m.bumpFactor = uintBitsToFloat(h.z);
  m.spare = 0u;
  m.bumpTexture = evenSlot(at + 43);
}

// One texture of a layer: their list begins with a texel.
TextureSlot layerSlotOf(uint material, uint layer) {
  int at = int(kMaterialTexels * material + 30u + 5u * (layer >> 1u));
  if ((layer & 1u) == 0u) return evenSlot(at);
  return oddSlot(at + 2);
}

// KHR_materials_volume_scatter: bits of the albedo and of the anisotropy.
uvec4 scatteringOf(uint material) { return texelFetch(materialTexels, int(kMaterialTexels * material) + kScatterTexel); }
bool mediumScatters(uint material) { return any(notEqual(scatteringOf(material).xyz, uvec3(0u))); }

MaterialRecord materialOf(uint material) {
  int at = int(kMaterialTexels * material);
  uvec4 a = texelFetch(materialTexels, at), b = texelFetch(materialTexels, at + 1), c = texelFetch(materialTexels, at + 2);
  uvec4 d = texelFetch(materialTexels, at + 3), e = texelFetch(materialTexels, at + 4), f = texelFetch(materialTexels, at + 5);
  uvec4 g = texelFetch(materialTexels, at + 6), h = texelFetch(materialTexels, at + 7);
  MaterialRecord m;
  m.model = a.x;
  m.flags = a.y;
  m.baseColor = asVec4(a.z, a.w, b.x, b.y);
  m.metallic = uintBitsToFloat(b.z);
  m.perceptualRoughness = uintBitsToFloat(b.w);
  m.ambientColor = asVec3(c.x, c.y, c.z);
  m.diffuseColor = asVec3(c.w, d.x, d.y);
  m.specularColor = asVec3(d.z, d.w, e.x);
  m.shininess = uintBitsToFloat(e.y);
  m.emission = asVec3(e.z, e.w, f.x);
  m.alphaCutoff = uintBitsToFloat(f.y);
  m.normalScale = uintBitsToFloat(f.z);
  m.occlusionStrength = uintBitsToFloat(f.w);
  m.transmission = uintBitsToFloat(g.x);
  m.indexOfRefraction = uintBitsToFloat(g.y);
  m.mirror = asVec3(g.z, g.w, h.x);
  m.attenuationColor = asVec3(h.y, h.z, h.w);
  m.attenuationDistance = uintBitsToFloat(texelFetch(materialTexels, at + 8).x);
  m.unused = 0u;
  m.baseColorTexture = oddSlot(at + 8);
  m.metallicRoughnessTexture = evenSlot(at + 11);
  m.normalTexture = oddSlot(at + 13);
  m.occlusionTexture = evenSlot(at + 16);
  m.emissiveTexture = oddSlot(at + 18);
  m.priority = 0.0;  // mediumOf() reads what bodies need
  m.dispersion = 0.0;
  m.unused1 = m.unused2 = 0u;
  if (kReadsLayers) readLayers(at + 22, m);
  return m;
}
#endif

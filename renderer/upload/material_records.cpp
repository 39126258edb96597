// Materials as the device's records, and all their textures one after the other.
#include <cmath>
#include <map>
#include <set>

#include "effects/material_traits.h"
#include "scene/material_textures.h"
#include "texture_flags.h"
#include "upload/mip_levels.h"
#include "upload/records.h"

namespace crosslight {
namespace {

// IEC 61966-2-1, in double: textures are decoded once, on the host.
float decodeSrgb(float v) {
  const double x = v;
  return static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
}

class MaterialWriter {
 public:
  explicit MaterialWriter(const Scene& scene) : scene_(scene) {}

  MaterialRecords run() {
    for (const Material& m : scene_.materials) {
      for (const TextureUse* use : texturesOf(m)) {
        if (use->present() && use->mip != Mip::none) minified_.insert(use->image);
      }
    }
    for (const Material& m : scene_.materials) result_.materials.push_back(record(m));
    if (result_.materials.empty()) result_.materials.push_back(record(Material{}));
    if (result_.texels.empty()) result_.texels.emplace_back(1.0f);
    return std::move(result_);
  }

 private:
  shared::MaterialRecord record(const Material& m) {
    shared::MaterialRecord r{};
    r.model = static_cast<std::uint32_t>(m.model);
    r.flags = flagsOf(m);
    const bool classic = isClassic(m);
    r.baseColor = classic ? glm::vec4(1.0f, 1.0f, 1.0f, m.baseColorFactor.a) : m.baseColorFactor;
    if (m.alphaMode == AlphaMode::opaque) r.baseColor.a = 1.0f;
    r.metallic = m.metallicFactor;
    r.perceptualRoughness = m.perceptualRoughnessFactor;
    r.ambientColor = m.classic.ambientFactor;
    r.diffuseColor = m.classic.diffuseFactor;
    r.specularColor = m.model == IlluminationModel::lambert ? glm::vec3(0.0f) : m.classic.specularFactor;
    r.shininess = m.classic.shininess;
    r.emission = m.emissiveFactor * m.emissiveStrength;
    r.alphaCutoff = m.alphaCutoff;
    r.normalScale = m.normalScale;
    r.occlusionStrength = m.occlusionStrength;
    r.transmission = transmissionOf(m);
    r.indexOfRefraction = m.indexOfRefraction;
    r.mirror = classic ? m.classic.reflectionFactor : glm::vec3(0.0f);
    r.attenuationColor = m.attenuationColor;
    r.attenuationDistance = absorbs(m) ? m.attenuationDistance : 0.0f;
    r.priority = static_cast<float>(m.priority.value_or(0));
    r.dispersion = m.dispersion;
    r.baseColorTexture = slot(m.baseColorTexture, true);
    r.metallicRoughnessTexture = slot(m.metallicRoughnessTexture, false);
    r.normalTexture = slot(m.normalTexture, false);
    r.occlusionTexture = slot(m.occlusionTexture, false);
    r.emissiveTexture = slot(m.emissiveTexture, true);
    setClassicExtras(m.classic, r);
    setFactors(m.layers, r);
    setLayerTextures(m, r);
    return r;
  }

  static void setClassicExtras(const ClassicMaterial& c, shared::MaterialRecord& r) {
    r.roughnessAngle = c.roughness;
    r.refractiveIndex = c.refractiveIndex;
    r.extinction = c.extinction;
  }

  static void setFactors(const MaterialLayers& l, shared::MaterialRecord& r) {
    r.diffuseRoughness = l.diffuseRoughness;
    r.clearcoat = l.clearcoat;
    r.clearcoatRoughness = l.clearcoatRoughness;
    r.clearcoatNormalScale = l.clearcoatNormalScale;
    r.specularFactor = l.specularFactor;
    r.specularTint = l.specularColor;
    r.sheenColor = l.sheenColor;
    r.sheenRoughness = l.sheenRoughness;
    r.anisotropy = l.anisotropy;
    r.anisotropyDirection = {std::cos(l.anisotropyRotation), std::sin(l.anisotropyRotation)};
    r.iridescence = l.iridescence;
    r.filmIndex = l.filmIndex;
    r.filmThinnest = l.filmThinnest;
    r.filmThickest = l.filmThickest;
    r.diffuseTransmission = l.diffuseTransmission;
    r.diffuseTransmissionColor = l.diffuseTransmissionColor;
  }

  void setLayerTextures(const Material& m, shared::MaterialRecord& r) {
    const MaterialLayers& l = m.layers;
    const auto set = [&](std::uint32_t layer, const TextureUse& use, bool srgb) {
      r.layerTextures[layer] = slot(use, srgb);
    };
    set(shared::kLayerSpecular, l.specularTexture, false);
    set(shared::kLayerSpecularTint, l.specularColorTexture, true);
    set(shared::kLayerClearcoat, l.clearcoatTexture, false);
    set(shared::kLayerClearcoatRoughness, l.clearcoatRoughnessTexture, false);
    set(shared::kLayerClearcoatNormal, l.clearcoatNormalTexture, false);
    set(shared::kLayerSheenColor, l.sheenColorTexture, true);
    set(shared::kLayerSheenRoughness, l.sheenRoughnessTexture, false);
    set(shared::kLayerAnisotropy, l.anisotropyTexture, false);
    set(shared::kLayerIridescence, l.iridescenceTexture, false);
    set(shared::kLayerFilmThickness, l.filmThicknessTexture, false);
    set(shared::kLayerTransmitted, l.diffuseTransmissionTexture, false);
    set(shared::kLayerTransmittedColor, l.diffuseTransmissionColorTexture, true);
    set(shared::kLayerTransmission, m.transmissionTexture, false);
    set(shared::kLayerDiffuseRoughness, l.diffuseRoughnessTexture, false);
    r.bumpTexture = slot(m.bumpTexture, false);
    r.bumpFactor = m.bumpFactor;
    r.scatterAlbedo = scatteringAlbedo(m);
    r.scatterAnisotropy = m.scatterAnisotropy;
  }

  static std::uint32_t flagsOf(const Material& m) {
    std::uint32_t flags = 0;
    if (m.doubleSided) flags |= shared::kMaterialDoubleSided;
    if (m.alphaMode == AlphaMode::mask) flags |= shared::kMaterialAlphaMask;
    if (m.alphaMode == AlphaMode::blend) flags |= shared::kMaterialAlphaBlend;
    if (isMirror(m)) flags |= shared::kMaterialMirror;
    if (refracts(m)) flags |= shared::kMaterialRefracts;
    // KHR_materials_transmission without a volume is an infinitely thin sheet; the classic kt has no such notion.
    if (refracts(m) && !isClassic(m) && !m.hasVolume) flags |= shared::kMaterialThin;
    if (m.hasVolume) flags |= shared::kMaterialVolume;
    if (hasAngularSpecular(m)) flags |= shared::kMaterialAngularSpecular;
    if (m.classic.hasIndex) flags |= shared::kMaterialIndexed;
    if (m.layers.hasSpecular) flags |= shared::kMaterialSpecularLayer;
    if (coatMirrors(m)) flags |= shared::kMaterialCoatMirrors;
    return flags;
  }

  shared::TextureSlot slot(const TextureUse& use, bool srgb) {
    shared::TextureSlot s{};
    s.firstTexel = shared::kNoTexture;
    s.uvFromUvXy = {1.0f, 0.0f, 0.0f, 1.0f};
    if (!use.present()) return s;
    const TextureImage& image = scene_.images[static_cast<std::size_t>(use.image)];
    s.firstTexel = texelsOf(use.image, srgb);
    s.width = image.width;
    s.height = image.height;
    const auto wrap = [](Wrap w) { return static_cast<std::uint32_t>(w); };
    s.flags = (use.texCoord == 1 ? shared::kTextureUv1 : 0u) | minificationOf(use) |
              (use.filter == Filter::nearest ? shared::kTextureNearest : 0u) |
              (wrap(use.wrapU) << shared::kTextureWrapShiftU) | (wrap(use.wrapV) << shared::kTextureWrapShiftV);
    // KHR_texture_transform, T * R * S. Counter-clockwise as seen with v pointing down, as the Khronos test model
    // (TextureTransformTest) and its viewers have it; the specification's code listing has the other sign.
    const float c = std::cos(use.rotation);
    const float n = std::sin(use.rotation);
    s.uvFromUvXy = {use.scale.x * c, -use.scale.x * n, use.scale.y * n, use.scale.y * c};
    s.uvOffset = use.offset;
    return s;
  }

  static std::uint32_t minificationOf(const TextureUse& use) {
    if (use.mip == Mip::none) return 0;
    return shared::kTextureMips | (use.mip == Mip::linear ? shared::kTextureMipLinear : 0u) |
           (use.minFilter == Filter::nearest ? shared::kTextureMinNearest : 0u);
  }

  // Level 0, then the others where some material minifies the image.
  std::uint32_t texelsOf(int image, bool srgb) {
    const auto [found, isNew] = placed_.try_emplace({image, srgb}, static_cast<std::uint32_t>(result_.texels.size()));
    if (!isNew) return found->second;
    const TextureImage& source = scene_.images[static_cast<std::size_t>(image)];
    for (std::size_t i = 0; i + 3 < source.rgba.size(); i += 4) {
      glm::vec4 texel(source.rgba[i], source.rgba[i + 1], source.rgba[i + 2], source.rgba[i + 3]);
      if (srgb) texel = {decodeSrgb(texel.x), decodeSrgb(texel.y), decodeSrgb(texel.z), texel.w};
      result_.texels.push_back(texel);
    }
    if (minified_.contains(image)) appendMipLevels(result_.texels, found->second, source.width, source.height);
    return found->second;
  }

  const Scene& scene_;
  MaterialRecords result_;
  std::map<std::pair<int, bool>, std::uint32_t> placed_;
  std::set<int> minified_;  // images
};

}  // namespace

MaterialRecords makeMaterialRecords(const Scene& scene) { return MaterialWriter(scene).run(); }

}  // namespace crosslight

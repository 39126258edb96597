// Materials with their textures, and those images that they use.
#include <tiny_gltf.h>

#include <fmt/format.h>

#include "base/interrupt.h"
#include "scene/gltf_build.h"
#include "scene/gltf_image.h"

namespace crosslight::gltf {
namespace {

constexpr Range kUnit{0.0, 1.0, false};

Wrap wrapOf(int value) {
  if (value == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clampToEdge;
  return value == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirroredRepeat : Wrap::repeat;
}

void readTextureTransform(const JsonAt& info, TextureUse& use) {
  const auto transform = info.extension("KHR_texture_transform");
  if (!transform) return;
  if (const auto offset = transform->find("offset")) {
    const std::vector<double> values = offset->numbers(2);
    use.offset = {static_cast<float>(values[0]), static_cast<float>(values[1])};
  }
  if (const auto scale = transform->find("scale")) {
    const std::vector<double> values = scale->numbers(2);
    use.scale = {static_cast<float>(values[0]), static_cast<float>(values[1])};
  }
  use.rotation = static_cast<float>(numberOr(*transform, "rotation", 0.0));
  use.texCoord = static_cast<int>(integerOr(*transform, "texCoord", use.texCoord, std::numeric_limits<int>::max()));
}

// Without levels a minified texture is read as a magnified one; so it is where the file leaves the filter open.
void readMinification(int minFilter, TextureUse& use) {
  switch (minFilter) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
      use.mip = Mip::nearest;
      break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR:
      use.mip = Mip::linear;
      break;
    default:
      break;
  }
  const bool nearest = minFilter == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST ||
                       minFilter == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR;
  use.minFilter = nearest ? Filter::nearest : Filter::linear;
}

class MaterialBuilder {
 public:
  MaterialBuilder(const Source& source, Scene& scene)
      : source_(source), scene_(scene), sceneImage_(source.document.count("images"), -1) {}

  Material build(std::size_t index) {
    const tinygltf::Material& in = source_.model.materials[index];
    const JsonAt at = source_.document.entry("materials", index);
    Material out;
    out.name = in.name;
    readCore(in, out);
    readTextures(in, at, out);
    if (const auto archived = at.extension("KHR_materials_pbrSpecularGlossiness")) readArchived(*archived, out);
    readExtensions(at, out);
    return out;
  }

 private:
  static void readCore(const tinygltf::Material& in, Material& out) {
    const tinygltf::PbrMetallicRoughness& pbr = in.pbrMetallicRoughness;
    for (std::size_t i = 0; i < 4; ++i)
      out.baseColorFactor[static_cast<int>(i)] = static_cast<float>(pbr.baseColorFactor[i]);
    out.metallicFactor = static_cast<float>(pbr.metallicFactor);
    out.perceptualRoughnessFactor = static_cast<float>(pbr.roughnessFactor);
    for (std::size_t i = 0; i < 3; ++i)
      out.emissiveFactor[static_cast<int>(i)] = static_cast<float>(in.emissiveFactor[i]);
    out.alphaMode = in.alphaMode == "MASK"    ? AlphaMode::mask
                    : in.alphaMode == "BLEND" ? AlphaMode::blend
                                              : AlphaMode::opaque;
    out.alphaCutoff = static_cast<float>(in.alphaCutoff);
    out.doubleSided = in.doubleSided;
    out.normalScale = static_cast<float>(in.normalTexture.scale);
    out.occlusionStrength = static_cast<float>(in.occlusionTexture.strength);
  }

  void readTextures(const tinygltf::Material& in, const JsonAt& at, Material& out) {
    const tinygltf::PbrMetallicRoughness& pbr = in.pbrMetallicRoughness;
    if (const auto pbrAt = at.find("pbrMetallicRoughness")) {
      out.baseColorTexture =
          texture(pbr.baseColorTexture.index, pbr.baseColorTexture.texCoord, *pbrAt, "baseColorTexture");
      out.metallicRoughnessTexture = texture(pbr.metallicRoughnessTexture.index, pbr.metallicRoughnessTexture.texCoord,
                                             *pbrAt, "metallicRoughnessTexture");
    }
    out.normalTexture = texture(in.normalTexture.index, in.normalTexture.texCoord, at, "normalTexture");
    out.occlusionTexture = texture(in.occlusionTexture.index, in.occlusionTexture.texCoord, at, "occlusionTexture");
    out.emissiveTexture = texture(in.emissiveTexture.index, in.emissiveTexture.texCoord, at, "emissiveTexture");
  }

  TextureUse texture(int index, int texCoord, const JsonAt& owner, const char* key) {
    TextureUse use;
    if (index < 0) return use;
    const JsonAt info = owner.at(key);
    use.texCoord = texCoord;
    readTextureTransform(info, use);
    const tinygltf::Texture& texture = source_.model.textures[static_cast<std::size_t>(index)];
    if (texture.source < 0) {
      source_.document.notes.add(info, "its texture has no image that is supported and is left out");
      return use;
    }
    if (use.texCoord > 1) {
      source_.document.notes.add(
          info, fmt::format("reads TEXCOORD_{}; only 0 and 1 are supported, the texture is left out", use.texCoord));
      return use;
    }
    if (texture.sampler >= 0) {
      const tinygltf::Sampler& sampler = source_.model.samplers[static_cast<std::size_t>(texture.sampler)];
      use.wrapU = wrapOf(sampler.wrapS);
      use.wrapV = wrapOf(sampler.wrapT);
      use.filter = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST ? Filter::nearest : Filter::linear;
      readMinification(sampler.minFilter, use);
    }
    use.image = image(static_cast<std::size_t>(texture.source));
    return use;
  }

  void readArchived(const JsonAt& archived, Material& out) {
    readSpecularGlossiness(archived, out);
    if (archived.find("diffuseTexture")) out.baseColorTexture = extensionTexture(archived, "diffuseTexture");
    out.metallicRoughnessTexture = {};
    ignoreTexture(archived, "specularGlossinessTexture");
  }

  int image(std::size_t index) {
    int& known = sceneImage_[index];
    if (known >= 0) return known;
    throwIfInterrupted();
    const JsonAt at = source_.document.entry("images", index);
    TextureImage decoded = decodeImage(source_.document.images[index], at, source_.document.budget);
    decoded.name = stringOr(at, "name", "");
    known = static_cast<int>(scene_.images.size());
    scene_.images.push_back(std::move(decoded));
    return known;
  }

  TextureUse extensionTexture(const JsonAt& owner, const char* key) {
    const auto info = owner.find(key);
    if (!info) return {};
    const std::size_t index = info->at("index").reference(source_.document.count("textures"), "texture");
    const std::int64_t texCoord = integerOr(*info, "texCoord", 0, std::numeric_limits<int>::max());
    return texture(static_cast<int>(index), static_cast<int>(texCoord), owner, key);
  }

  void readExtensions(const JsonAt& at, Material& out) {
    if (const auto strength = at.extension("KHR_materials_emissive_strength")) {
      out.emissiveStrength = static_cast<float>(numberOr(*strength, "emissiveStrength", 1.0, Range::atLeast(0.0)));
    }
    if (const auto ior = at.extension("KHR_materials_ior")) readIor(*ior, out);
    if (const auto transmission = at.extension("KHR_materials_transmission")) {
      out.transmissionFactor = static_cast<float>(numberOr(*transmission, "transmissionFactor", 0.0, kUnit));
      out.transmissionTexture = extensionTexture(*transmission, "transmissionTexture");
    }
    readMaterialLayers(
        at, [this](const JsonAt& owner, const char* key) { return extensionTexture(owner, key); }, out.layers);
    if (const auto bump = at.extension("EXT_materials_bump")) {
      out.bumpTexture = extensionTexture(*bump, "bumpTexture");
      out.bumpFactor = static_cast<float>(numberOr(*bump, "bumpFactor", 1.0));
    }
    if (const auto volume = at.extension("KHR_materials_volume")) readVolume(*volume, out);
    if (const auto scatter = at.extension("KHR_materials_volume_scatter")) readVolumeScatter(*scatter, out);
    if (const auto dispersion = at.extension("KHR_materials_dispersion")) {
      out.dispersion = static_cast<float>(numberOr(*dispersion, "dispersion", 0.0, Range::atLeast(0.0)));
    }
    if (const auto dielectric = at.extension("CROSSLIGHT_materials_dielectric")) readDielectric(*dielectric, out);
    if (at.extension("KHR_materials_unlit")) out.model = IlluminationModel::unlit;
    // Last: its fallback for other viewers may be anything, unlit too.
    if (const auto classic = at.extension("CROSSLIGHT_materials_classic")) readClassicMaterial(*classic, out);
    if (const auto displacement = at.extension("CROSSLIGHT_materials_displacement")) {
      readDisplacement(
          *displacement, [this](const JsonAt& owner, const char* key) { return extensionTexture(owner, key); }, out);
    }
  }

  static void readIor(const JsonAt& ior, Material& out) {
    const double value = numberOr(ior, "ior", 1.5, Range::atLeast(0.0));
    if (value != 0.0 && value < 1.0) ior.at("ior").fail(fmt::format("must be 0 or at least 1, is {:g}", value));
    out.indexOfRefraction = static_cast<float>(value);
    out.hasIor = true;
  }

  void readVolume(const JsonAt& volume, Material& out) const {
    // A thickness of 0, the default, means a thin wall (KHR_materials_volume, "Properties").
    out.hasVolume = numberOr(volume, "thicknessFactor", 0.0, Range::atLeast(0.0)) > 0.0;
    out.attenuationColor = vec3Or(volume, "attenuationColor", out.attenuationColor, kUnit);
    if (const auto distance = volume.find("attenuationDistance")) {
      out.attenuationDistance = static_cast<float>(distance->number(Range::above(0.0)));
    }
    // Where light leaves a body is found by rays; raster lets it pass at the surface. Neither asks for a thickness.
    if (const auto thickness = volume.find("thicknessTexture"))
      source_.document.notes.add(*thickness, "does not count: the mesh itself is the body that light passes through");
  }

  // A draft. What the medium takes away is KHR_materials_volume's attenuation already, which counts; what it scatters
  // towards the viewer would have to come in through the surface that bends it.
  static void readVolumeScatter(const JsonAt& scatter, Material& out) {
    out.multiscatterColor = vec3Or(scatter, "multiscatterColor", glm::vec3(0.0f), kUnit);
    out.scatterAnisotropy = static_cast<float>(numberOr(scatter, "scatterAnisotropy", 0.0, Range::between(-1.0, 1.0)));
  }

  void ignoreTexture(const JsonAt& extension, const char* key) const {
    if (const auto texture = extension.find(key))
      source_.document.notes.add(*texture, "is not supported yet; the factor alone counts");
  }

  const Source& source_;
  Scene& scene_;
  std::vector<int> sceneImage_;  // by image of the file; -1: not decoded yet
};

}  // namespace

void buildMaterials(const Source& source, Scene& scene) {
  MaterialBuilder builder(source, scene);
  for (std::size_t i = 0; i < source.model.materials.size(); ++i) scene.materials.push_back(builder.build(i));
}

}  // namespace crosslight::gltf

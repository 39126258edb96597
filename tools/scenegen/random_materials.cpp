#include "scenegen/random_materials.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "scenegen/material_stage.h"
#include "scenegen/parts.h"
#include "scenegen/png.h"

namespace crosslight::scenegen {
namespace {

constexpr int kNearest = 9728;

Json samplerOf(Dice& dice) {
  const int magnified = dice.pick({kNearest, kLinear});
  const int minified = dice.pick({kNearest, kLinear, 9984, 9985, 9986, 9987});  // the last four have levels
  const int wrapS = dice.pick({kRepeat, 33071, 33648});
  const int wrapT = dice.pick({kRepeat, 33071, 33648});
  return {{"magFilter", magnified}, {"minFilter", minified}, {"wrapS", wrapS}, {"wrapT", wrapT}};
}

// Triangle waves of four channels, of whole periods: integers alone, and smooth enough to be told from noise.
std::vector<std::byte> wavesPng(Dice& dice, std::uint32_t size) {
  int periods[8];
  for (int& p : periods) p = dice.below(4);
  const int steepness = dice.pick({1, 1, 4});
  return makePng(size, size, 4, [&](std::uint32_t x, std::uint32_t y, std::uint8_t* out) {
    for (int i = 0; i < 4; ++i) {
      const int phase = 512 * (periods[2 * i] * static_cast<int>(x) + (periods[2 * i + 1] + 1) * static_cast<int>(y)) /
                        static_cast<int>(size) % 512;
      const int wave = (phase < 256 ? phase : 511 - phase) - 128;
      out[i] = static_cast<std::uint8_t>(std::clamp(140 + steepness * wave * 7 / 8, 0, 255));
    }
  });
}

// Slopes of the same waves.
std::vector<std::byte> slopesPng() {
  return makePng(16, 16, 3, [](std::uint32_t x, std::uint32_t y, std::uint8_t* out) {
    const double nx = x % 8 < 4 ? 0.3 : -0.3, ny = y % 16 < 8 ? 0.2 : -0.2;
    const double nz = std::sqrt(1.0 - nx * nx - ny * ny);
    const double n[3] = {nx, ny, nz};
    for (int i = 0; i < 3; ++i) out[i] = static_cast<std::uint8_t>(std::lround(127.5 + 127.5 * n[i]));
  });
}

}  // namespace

RandomMaterials::RandomMaterials(GltfBuilder& gltf, Dice& dice) : gltf_(gltf), dice_(dice) {
  for (const std::uint32_t size : {16u, 8u}) {
    const auto png = wavesPng(dice_, size);
    pictures_.push_back(gltf_.addTexture("waves " + std::to_string(size), png, samplerOf(dice_)));
  }
  normals_ = gltf_.addTexture("slopes", slopesPng(), samplerOf(dice_));
  const auto heights = wavesPng(dice_, 8);
  heights_ = gltf_.addTexture("heights", heights,
                              {{"magFilter", kLinear}, {"minFilter", kLinear}, {"wrapS", kRepeat}, {"wrapT", kRepeat}});
}

Json RandomMaterials::color(double low, double high) { return listOf(dice_.vector(low, high)); }

Json RandomMaterials::texture() {
  Json info = textureInfo(pictures_[static_cast<std::size_t>(dice_.below(2))]);
  if (dice_.oneIn(4)) info["texCoord"] = 1;
  if (dice_.oneIn(3)) {
    Json& transform = info["extensions"]["KHR_texture_transform"];
    transform["offset"] = Json{dice_.between(-1.0, 1.0), dice_.between(-1.0, 1.0)};
    transform["rotation"] = dice_.between(-3.0, 3.0);
    transform["scale"] = Json{dice_.pick({0.5, 1.0, 6.0, -2.0}), dice_.pick({0.5, 1.0, 6.0})};
  }
  return info;
}

Json RandomMaterials::normalTexture() {
  Json info = textureInfo(normals_);
  if (dice_.oneIn(2)) info["scale"] = dice_.pick({0.5, 2.0, -1.0});
  return info;
}

void RandomMaterials::maybeTexture(Json& owner, const char* key, int oneIn) {
  if (dice_.oneIn(oneIn)) owner[key] = texture();
}

int RandomMaterials::add(bool mayMove) {
  const int family = dice_.below(20);
  Json material = family < 8 ? classic() : metallicRoughness();
  material["name"] = "material " + std::to_string(count_++);
  if (family == 19) material["extensions"]["KHR_materials_unlit"] = Json::object();
  addMaps(material);
  if (mayMove && dice_.oneIn(10)) {
    Json& moved = material["extensions"]["CROSSLIGHT_materials_displacement"];
    moved["displacementTexture"] = textureInfo(heights_);
    moved["scale"] = dice_.between(-0.2, 0.2);
    moved["bias"] = dice_.between(-0.1, 0.1);
  }
  return gltf_.addMaterial(std::move(material));
}

// What all families may have.
void RandomMaterials::addMaps(Json& material) {
  maybeTexture(material["pbrMetallicRoughness"], "baseColorTexture", 3);
  if (dice_.oneIn(5)) material["normalTexture"] = normalTexture();
  if (dice_.oneIn(6)) {
    material["occlusionTexture"] = texture();
    material["occlusionTexture"]["strength"] = dice_.orEnd(0.0, 1.0);
  }
  if (dice_.oneIn(5)) {
    material["emissiveFactor"] = color(0.0, 1.0);
    maybeTexture(material, "emissiveTexture", 2);
    if (dice_.oneIn(2)) material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 1.5;
  }
  if (dice_.oneIn(8)) {
    Json& bump = material["extensions"]["EXT_materials_bump"];
    bump["bumpTexture"] = texture();
    bump["bumpFactor"] = dice_.between(-0.1, 0.1);
  }
  const int alpha = dice_.below(6);
  if (alpha < 2) material["alphaMode"] = alpha == 0 ? "MASK" : "BLEND";
  if (alpha == 0 && dice_.oneIn(2)) material["alphaCutoff"] = dice_.orEnd(0.0, 1.0);
  if (alpha < 2) material["pbrMetallicRoughness"]["baseColorFactor"][3] = dice_.orEnd(0.0, 1.0);
  if (dice_.oneIn(3)) material["doubleSided"] = true;
}

Json RandomMaterials::metallicRoughness() {
  const glm::dvec3 base = dice_.vector(0.05, 1.0);
  const double metallic = dice_.orEnd(0.0, 1.0);
  const double perceptualRoughness = dice_.orEnd(0.0, 1.0);
  Json material = pbrMaterial("", base, metallic, perceptualRoughness);
  maybeTexture(material["pbrMetallicRoughness"], "metallicRoughnessTexture", 5);
  Json extensions = Json::object();
  addLayers(extensions);
  material["extensions"] = std::move(extensions);
  if (dice_.oneIn(4)) addTransmission(material);
  if (dice_.oneIn(6)) material["extensions"]["KHR_materials_ior"]["ior"] = dice_.pick({0.0, 1.0, 1.33, 2.4});
  return material;
}

void RandomMaterials::addTransmission(Json& material) {
  Json& extensions = material["extensions"];
  Json& transmission = extensions["KHR_materials_transmission"];
  transmission["transmissionFactor"] = dice_.orEnd(0.1, 1.0);
  maybeTexture(transmission, "transmissionTexture", 5);
  if (dice_.oneIn(2)) material["pbrMetallicRoughness"]["metallicFactor"] = 0.0;
  if (dice_.oneIn(2)) material["pbrMetallicRoughness"]["roughnessFactor"] = 0.0;
  if (dice_.oneIn(3)) return;  // a thin wall
  Json& volume = extensions["KHR_materials_volume"];
  volume["thicknessFactor"] = 1.0;
  if (dice_.oneIn(2)) {
    volume["attenuationColor"] = color(0.1, 1.0);
    volume["attenuationDistance"] = dice_.pick({0.05, 1.0, 20.0});
    if (dice_.oneIn(2)) {
      Json& scatter = extensions["KHR_materials_volume_scatter"];
      scatter["multiscatterColor"] = color(0.0, 1.0);
      scatter["scatterAnisotropy"] = dice_.orEnd(-0.9, 0.9);
    }
  }
  if (dice_.oneIn(3)) extensions["KHR_materials_dispersion"]["dispersion"] = dice_.pick({0.3, 2.0});
  if (dice_.oneIn(3)) extensions["CROSSLIGHT_materials_dielectric"]["priority"] = dice_.below(4);
}

void RandomMaterials::addLayers(Json& extensions) {
  if (dice_.oneIn(6)) {
    Json& coat = extensions["KHR_materials_clearcoat"];
    coat["clearcoatFactor"] = dice_.orEnd(0.2, 1.0);
    coat["clearcoatRoughnessFactor"] = dice_.orEnd(0.0, 1.0);
    maybeTexture(coat, "clearcoatTexture", 4);
    maybeTexture(coat, "clearcoatRoughnessTexture", 4);
    if (dice_.oneIn(4)) coat["clearcoatNormalTexture"] = normalTexture();
  }
  if (dice_.oneIn(7)) {
    Json& sheen = extensions["KHR_materials_sheen"];
    sheen["sheenColorFactor"] = color(0.0, 1.0);
    sheen["sheenRoughnessFactor"] = dice_.orEnd(0.0, 1.0);
    maybeTexture(sheen, "sheenColorTexture", 4);
    maybeTexture(sheen, "sheenRoughnessTexture", 4);
  }
  if (dice_.oneIn(7)) {
    Json& anisotropy = extensions["KHR_materials_anisotropy"];
    anisotropy["anisotropyStrength"] = dice_.orEnd(0.1, 1.0);
    anisotropy["anisotropyRotation"] = dice_.between(0.0, 3.0);
    maybeTexture(anisotropy, "anisotropyTexture", 3);
  }
  if (dice_.oneIn(7)) {
    Json& film = extensions["KHR_materials_iridescence"];
    film["iridescenceFactor"] = dice_.orEnd(0.2, 1.0);
    film["iridescenceIor"] = dice_.pick({1.0, 1.3, 2.0});
    film["iridescenceThicknessMaximum"] = dice_.pick({0.0, 300.0, 800.0});
    maybeTexture(film, "iridescenceTexture", 4);
    maybeTexture(film, "iridescenceThicknessTexture", 4);
  }
  if (dice_.oneIn(7)) {
    Json& specular = extensions["KHR_materials_specular"];
    specular["specularFactor"] = dice_.orEnd(0.0, 1.0);
    specular["specularColorFactor"] = color(0.0, 2.0);
    maybeTexture(specular, "specularTexture", 4);
    maybeTexture(specular, "specularColorTexture", 4);
  }
  if (dice_.oneIn(8)) {
    Json& through = extensions["KHR_materials_diffuse_transmission"];
    through["diffuseTransmissionFactor"] = dice_.orEnd(0.2, 1.0);
    through["diffuseTransmissionColorFactor"] = color(0.1, 1.0);
    maybeTexture(through, "diffuseTransmissionTexture", 4);
    maybeTexture(through, "diffuseTransmissionColorTexture", 4);
  }
  if (dice_.oneIn(8)) {
    Json& rough = extensions["KHR_materials_diffuse_roughness"];
    rough["diffuseRoughnessFactor"] = dice_.orEnd(0.1, 1.0);
    maybeTexture(rough, "diffuseRoughnessTexture", 4);
  }
}

Json RandomMaterials::classic() {
  const std::string model = dice_.pick<const char*>(
      {"lambert", "phong", "blinnPhong", "modifiedPhong", "orenNayar", "cookTorrance1982", "blinnPhong", "phong"});
  ClassicSpec spec{.model = model};
  spec.ka = dice_.vector(0.0, 0.5);
  spec.kd = dice_.oneIn(6) ? glm::dvec3(0.0) : dice_.vector(0.1, 1.0);
  if (model != "lambert" && model != "orenNayar") spec.ks = dice_.oneIn(5) ? glm::dvec3(0.0) : dice_.vector(0.0, 1.0);
  spec.shininess = dice_.pick({0.0, 1.0, 12.5, 100.0, 2000.0});
  if (dice_.oneIn(4)) spec.kr = dice_.vector(0.0, 0.9);
  if (dice_.oneIn(4)) spec.transparency = dice_.orEnd(0.2, 1.0);
  Json material = classicMaterial("", spec);
  Json& extension = material["extensions"]["CROSSLIGHT_materials_classic"];
  const bool grooves = model == "cookTorrance1982";
  if (grooves || model == "orenNayar") extension["roughness"] = dice_.pick({0.1, 0.4, 1.0});
  const bool highlight = model == "phong" || model == "blinnPhong" || model == "modifiedPhong";
  if (highlight && dice_.oneIn(4)) extension["specularCoefficient"] = "angular";
  if (grooves && dice_.oneIn(2)) {
    extension["refractiveIndex"] = color(0.2, 3.0);
    extension["extinction"] = color(0.0, 4.0);
  }
  if (spec.transparency > 0.0 && dice_.oneIn(2)) {
    material["extensions"]["KHR_materials_ior"]["ior"] = dice_.pick({1.0, 1.33, 1.5});
    if (dice_.oneIn(3)) material["extensions"]["CROSSLIGHT_materials_dielectric"]["priority"] = dice_.below(4);
  }
  return material;
}

}  // namespace crosslight::scenegen

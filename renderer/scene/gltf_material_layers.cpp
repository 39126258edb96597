// Khronos' extensions that lay something over a metallic-roughness surface or change its lobes. Ranges are those of
// their JSON schemas.
#include "scene/gltf_build.h"

namespace crosslight::gltf {
namespace {

constexpr Range kUnit{0.0, 1.0, false};

float value(const JsonAt& object, const char* key, float fallback, const Range& range = kUnit) {
  return static_cast<float>(numberOr(object, key, double{fallback}, range));
}

void readSpecular(const JsonAt& at, const TextureReader& texture, MaterialLayers& l) {
  l.hasSpecular = true;
  l.specularFactor = value(at, "specularFactor", l.specularFactor);
  l.specularColor = vec3Or(at, "specularColorFactor", l.specularColor, Range::atLeast(0.0));
  l.specularTexture = texture(at, "specularTexture");
  l.specularColorTexture = texture(at, "specularColorTexture");
}

void readClearcoat(const JsonAt& at, const TextureReader& texture, MaterialLayers& l) {
  l.clearcoat = value(at, "clearcoatFactor", l.clearcoat);
  l.clearcoatRoughness = value(at, "clearcoatRoughnessFactor", l.clearcoatRoughness);
  l.clearcoatTexture = texture(at, "clearcoatTexture");
  l.clearcoatRoughnessTexture = texture(at, "clearcoatRoughnessTexture");
  l.clearcoatNormalTexture = texture(at, "clearcoatNormalTexture");
  if (const auto normal = at.find("clearcoatNormalTexture")) l.clearcoatNormalScale = value(*normal, "scale", 1.0f, {});
}

void readSheen(const JsonAt& at, const TextureReader& texture, MaterialLayers& l) {
  l.sheenColor = vec3Or(at, "sheenColorFactor", l.sheenColor, kUnit);
  l.sheenRoughness = value(at, "sheenRoughnessFactor", l.sheenRoughness);
  l.sheenColorTexture = texture(at, "sheenColorTexture");
  l.sheenRoughnessTexture = texture(at, "sheenRoughnessTexture");
}

void readAnisotropy(const JsonAt& at, const TextureReader& texture, MaterialLayers& l) {
  l.anisotropy = value(at, "anisotropyStrength", l.anisotropy);
  l.anisotropyRotation = value(at, "anisotropyRotation", l.anisotropyRotation, {});
  l.anisotropyTexture = texture(at, "anisotropyTexture");
}

void readIridescence(const JsonAt& at, const TextureReader& texture, MaterialLayers& l) {
  l.iridescence = value(at, "iridescenceFactor", l.iridescence);
  l.filmIndex = value(at, "iridescenceIor", l.filmIndex, Range::atLeast(1.0));
  l.filmThinnest = value(at, "iridescenceThicknessMinimum", l.filmThinnest, Range::atLeast(0.0));
  l.filmThickest = value(at, "iridescenceThicknessMaximum", l.filmThickest, Range::atLeast(0.0));
  l.iridescenceTexture = texture(at, "iridescenceTexture");
  l.filmThicknessTexture = texture(at, "iridescenceThicknessTexture");
}

void readDiffuseTransmission(const JsonAt& at, const TextureReader& texture, MaterialLayers& l) {
  l.diffuseTransmission = value(at, "diffuseTransmissionFactor", l.diffuseTransmission);
  l.diffuseTransmissionColor = vec3Or(at, "diffuseTransmissionColorFactor", l.diffuseTransmissionColor, kUnit);
  l.diffuseTransmissionTexture = texture(at, "diffuseTransmissionTexture");
  l.diffuseTransmissionColorTexture = texture(at, "diffuseTransmissionColorTexture");
}

void readDiffuseRoughness(const JsonAt& at, const TextureReader& texture, MaterialLayers& l) {
  l.diffuseRoughness = value(at, "diffuseRoughnessFactor", l.diffuseRoughness);
  l.diffuseRoughnessTexture = texture(at, "diffuseRoughnessTexture");
}

}  // namespace

void readMaterialLayers(const JsonAt& material, const TextureReader& texture, MaterialLayers& layers) {
  using Reader = void (*)(const JsonAt&, const TextureReader&, MaterialLayers&);
  constexpr std::pair<const char*, Reader> kReaders[] = {
      {"KHR_materials_specular", readSpecular},
      {"KHR_materials_clearcoat", readClearcoat},
      {"KHR_materials_sheen", readSheen},
      {"KHR_materials_anisotropy", readAnisotropy},
      {"KHR_materials_iridescence", readIridescence},
      {"KHR_materials_diffuse_transmission", readDiffuseTransmission},
      {"KHR_materials_diffuse_roughness", readDiffuseRoughness}};
  for (const auto& [name, read] : kReaders) {
    if (const auto extension = material.extension(name)) read(*extension, texture, layers);
  }
}

}  // namespace crosslight::gltf

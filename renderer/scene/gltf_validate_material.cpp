// Materials, textures, samplers and images: types, ranges and references of the core. Extensions check themselves
// where they are read.
#include "scene/gltf_document.h"

namespace crosslight::gltf {
namespace {

constexpr Range kUnit{0.0, 1.0, false};

void validateTextureInfo(const JsonAt& owner, const char* key, const Document& document) {
  const auto info = owner.find(key);
  if (!info) return;
  info->at("index").reference(document.count("textures"), "texture");
  integerOr(*info, "texCoord", 0, std::numeric_limits<int>::max());
  numberOr(*info, "scale", 1.0);
  numberOr(*info, "strength", 1.0, kUnit);
}

void validateMaterial(const JsonAt& material, const Document& document) {
  if (const auto pbr = material.find("pbrMetallicRoughness")) {
    if (const auto color = pbr->find("baseColorFactor")) color->numbers(4, kUnit);
    numberOr(*pbr, "metallicFactor", 1.0, kUnit);
    numberOr(*pbr, "roughnessFactor", 1.0, kUnit);
    validateTextureInfo(*pbr, "baseColorTexture", document);
    validateTextureInfo(*pbr, "metallicRoughnessTexture", document);
  }
  for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"}) {
    validateTextureInfo(material, key, document);
  }
  vec3Or(material, "emissiveFactor", glm::vec3(0.0f), kUnit);
  if (const auto mode = material.find("alphaMode")) mode->oneOf({"OPAQUE", "MASK", "BLEND"});
  numberOr(material, "alphaCutoff", 0.5, Range::atLeast(0.0));
  booleanOr(material, "doubleSided", false);
}

void validateSampler(const JsonAt& sampler) {
  const auto oneOf = [&](const char* key, std::initializer_list<std::int64_t> values) {
    const auto member = sampler.find(key);
    if (!member) return;
    const std::int64_t value = member->integer();
    for (const std::int64_t allowed : values) {
      if (value == allowed) return;
    }
    member->fail(std::to_string(value) + " is none of glTF's values");
  };
  oneOf("magFilter", {9728, 9729});
  oneOf("minFilter", {9728, 9729, 9984, 9985, 9986, 9987});
  oneOf("wrapS", {33071, 33648, 10497});
  oneOf("wrapT", {33071, 33648, 10497});
}

void validateImage(const JsonAt& image, const Document& document) {
  const auto uri = image.find("uri");
  const auto view = image.find("bufferView");
  if (uri.has_value() == view.has_value()) image.fail("needs either a uri or a bufferView, and not both");
  if (uri) uri->string();
  if (const auto mime = image.find("mimeType")) mime->string();
  if (!view) return;
  const std::size_t index = view->reference(document.count("bufferViews"), "bufferView");
  if (document.entry("bufferViews", index).find("byteStride"))
    view->warn("a view of an image must not have a byteStride");
  if (!image.find("mimeType")) image.warn("has no mimeType, which a bufferView needs; its content tells");
}

}  // namespace

void validateMaterials(const Document& document) {
  const JsonAt root = document.root();
  if (const auto images = root.find("images")) {
    for (const JsonAt& image : images->items()) validateImage(image, document);
  }
  if (const auto samplers = root.find("samplers")) {
    for (const JsonAt& sampler : samplers->items()) validateSampler(sampler);
  }
  if (const auto textures = root.find("textures")) {
    for (const JsonAt& texture : textures->items()) {
      referenceOr(texture, "source", document.count("images"), "image");
      referenceOr(texture, "sampler", document.count("samplers"), "sampler");
    }
  }
  if (const auto materials = root.find("materials")) {
    for (const JsonAt& material : materials->items()) validateMaterial(material, document);
  }
}

}  // namespace crosslight::gltf

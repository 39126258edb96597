// What the JSON of a glTF file must be before anyone trusts it: the whole of it, then its extensions. Violations that
// change what the file means or where it reads are refused; those that do not are named in a warning.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "scene/gltf_document.h"

namespace crosslight::gltf {
namespace {

constexpr std::array kTopLevelArrays = {"accessors", "animations", "buffers", "bufferViews", "cameras",
                                        "images",    "materials",  "meshes",  "nodes",       "samplers",
                                        "scenes",    "textures",   "skins"};

// Honoured in whole, or with exceptions that the reader names.
constexpr auto kKnownExtensions = std::to_array<std::string_view>({
    "CROSSLIGHT_lights_area",
    "CROSSLIGHT_lights_classic",
    "CROSSLIGHT_materials_classic",
    "CROSSLIGHT_materials_dielectric",
    "CROSSLIGHT_materials_displacement",
    "CROSSLIGHT_node_shape",
    "CROSSLIGHT_scene_atmosphere",
    "EXT_lights_area",
    "EXT_materials_bump",
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_diffuse_roughness",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_materials_volume_scatter",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
});

bool isKnown(std::string_view extension) {
  return std::find(kKnownExtensions.begin(), kKnownExtensions.end(), extension) != kKnownExtensions.end();
}

// "2.0" -> 2; a version is two numbers with a dot between them.
int majorVersion(const JsonAt& version) {
  const std::string& text = version.string();
  const std::size_t dot = text.find('.');
  const auto isNumber = [](std::string_view part) {
    return !part.empty() && part.size() < 6 &&
           std::all_of(part.begin(), part.end(), [](char c) { return c >= '0' && c <= '9'; });
  };
  if (dot == std::string::npos || !isNumber(text.substr(0, dot)) || !isNumber(text.substr(dot + 1))) {
    version.fail("must look like \"2.0\", is \"" + text + "\"");
  }
  return std::stoi(text.substr(0, dot));
}

void validateAsset(const JsonAt& root) {
  const JsonAt asset = root.at("asset");
  const JsonAt version = asset.at("version");
  if (majorVersion(version) != 2) version.fail("is glTF " + version.string() + ", only 2.0 is known");
  if (const auto minimum = asset.find("minVersion")) {
    if (majorVersion(*minimum) != 2 || minimum->string() != "2.0") {
      minimum->fail("asks for glTF " + minimum->string() + ", only 2.0 is known");
    }
  }
}

void validateTopLevel(const JsonAt& root) {
  for (const char* name : kTopLevelArrays) {
    const auto array = root.find(name);
    if (!array) continue;
    if (array->arraySize() == 0) array->warn("is empty, which glTF does not allow");
    for (const JsonAt& entry : array->items()) {
      entry.object();
      if (const auto label = entry.find("name")) label->string();
    }
  }
}

}  // namespace

void validateExtensions(const Document& document) {
  const JsonAt root = document.root();
  if (const auto required = root.find("extensionsRequired")) {
    for (const JsonAt& name : required->items()) {
      if (!isKnown(name.string())) {
        name.fail("the file requires the extension '" + name.string() + "', which is not supported");
      }
    }
  }
  if (const auto used = root.find("extensionsUsed")) {
    for (const JsonAt& name : used->items()) {
      if (!isKnown(name.string())) {
        root.warn("the extension '" + name.string() + "' is not supported and left out");
      }
    }
  }
}

void validateDocument(const Document& document) {
  const JsonAt root = document.root();
  root.object();
  validateAsset(root);
  validateExtensions(document);
  validateTopLevel(root);
  validateData(document);
  validateMeshes(document);
  validateMaterials(document);
  validateNodes(document);
  validateAnimations(document);
}

}  // namespace crosslight::gltf

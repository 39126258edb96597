// Meshes: which attributes there may be, of which format, and that they belong together.
#include <fmt/format.h>

#include <algorithm>

#include "scene/gltf_document.h"

namespace crosslight::gltf {
namespace {

struct Semantic {
  std::string_view name;  // without its number
  bool numbered = false;
  std::vector<std::string_view> types;
};

const std::vector<Semantic>& semantics() {
  static const std::vector<Semantic> all = {{"POSITION", false, {"VEC3"}},      {"NORMAL", false, {"VEC3"}},
                                            {"TANGENT", false, {"VEC4"}},       {"TEXCOORD_", true, {"VEC2"}},
                                            {"COLOR_", true, {"VEC3", "VEC4"}}, {"JOINTS_", true, {"VEC4"}},
                                            {"WEIGHTS_", true, {"VEC4"}}};
  return all;
}

const Semantic* semanticOf(std::string_view attribute) {
  for (const Semantic& semantic : semantics()) {
    if (!semantic.numbered) {
      if (attribute == semantic.name) return &semantic;
    } else if (attribute.starts_with(semantic.name)) {
      const std::string_view number = attribute.substr(semantic.name.size());
      const bool digits = !number.empty() && number.size() < 4 &&
                          std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
      if (digits && (number.size() == 1 || number[0] != '0')) return &semantic;
    }
  }
  return nullptr;
}

// The core's formats, then KHR_mesh_quantization's.
bool formatAllowed(const Semantic& semantic, std::int64_t component, bool normalized, bool quantized, bool isTarget) {
  const bool isByteOrShort = component != kFloat && component != kUnsignedInt;
  const bool isSigned = component == kByte || component == kShort;
  if (semantic.name == "JOINTS_") return (component == kUnsignedByte || component == kUnsignedShort) && !normalized;
  if (component == kFloat) return true;
  if (semantic.name == "WEIGHTS_" || semantic.name == "COLOR_") {
    return isByteOrShort && normalized && (!isSigned || (quantized && isTarget));
  }
  if (semantic.name == "TEXCOORD_") return isByteOrShort && ((normalized && !isSigned) || quantized);
  if (!quantized) return false;
  if (semantic.name == "POSITION") return isByteOrShort;
  return isByteOrShort && isSigned && normalized;  // NORMAL, TANGENT
}

class MeshCheck {
 public:
  explicit MeshCheck(const Document& document)
      : document_(document), quantized_(document.uses("KHR_mesh_quantization")) {}

  void primitive(const JsonAt& primitive) {
    const JsonAt attributes = primitive.at("attributes");
    attributes.object();
    if (attributes.value().empty()) attributes.warn("is empty, nothing is drawn");
    const std::optional<std::int64_t> vertices = attributeCount(attributes, false);
    referenceOr(primitive, "material", document_.count("materials"), "material");
    if (const auto mode = primitive.find("mode")) mode->integer(0, 6);
    indices(primitive);
    if (const auto targets = primitive.find("targets")) {
      for (const JsonAt& target : targets->items()) this->target(target, attributes, vertices);
    }
    joints(attributes);
  }

 private:
  JsonAt accessorOf(const JsonAt& reference) const {
    return document_.entry("accessors", reference.reference(document_.count("accessors"), "accessor"));
  }

  // Checks every attribute; their common number of vertices.
  std::optional<std::int64_t> attributeCount(const JsonAt& attributes, bool isTarget) const {
    std::optional<std::int64_t> count;
    for (const auto& [name, ignored] : attributes.value().items()) {
      const JsonAt reference = attributes.at(name);
      const JsonAt accessor = accessorOf(reference);
      const Semantic* semantic = semanticOf(name);
      if (semantic) {
        format(reference, accessor, *semantic, isTarget);
      } else if (!name.starts_with("_")) {
        reference.warn("is no attribute that glTF knows; it is left alone");
      }
      const std::int64_t own = accessor.at("count").integer();
      if (count && *count != own) reference.fail(fmt::format("has {} elements, the other attributes {}", own, *count));
      count = own;
    }
    return count;
  }

  void format(const JsonAt& reference, const JsonAt& accessor, const Semantic& semantic, bool isTarget) const {
    const std::string& type = accessor.at("type").string();
    const std::int64_t component = accessor.at("componentType").integer();
    const bool normalized = booleanOr(accessor, "normalized", false);
    const bool isTargetTangent = isTarget && semantic.name == "TANGENT";
    const bool typeFits = isTargetTangent
                              ? type == "VEC3"
                              : std::find(semantic.types.begin(), semantic.types.end(), type) != semantic.types.end();
    if (!typeFits || !formatAllowed(semantic, component, normalized, quantized_, isTarget)) {
      reference.fail(fmt::format("its accessor is {} of component type {}{}, which is not allowed{}", type, component,
                                 normalized ? ", normalized" : "",
                                 quantized_ ? "" : " (without KHR_mesh_quantization)"));
    }
    if (semantic.name == "POSITION" && (!accessor.find("min") || !accessor.find("max"))) {
      accessor.warn("has positions but no min and max");
    }
  }

  void indices(const JsonAt& primitive) const {
    const auto reference = primitive.find("indices");
    if (!reference) return;
    const JsonAt accessor = accessorOf(*reference);
    const std::int64_t component = accessor.at("componentType").integer();
    const bool isUnsigned = component == kUnsignedByte || component == kUnsignedShort || component == kUnsignedInt;
    if (accessor.at("type").string() != "SCALAR" || !isUnsigned || booleanOr(accessor, "normalized", false)) {
      reference->fail("indices must be SCALAR of component type 5121, 5123 or 5125, not normalized");
    }
  }

  void target(const JsonAt& target, const JsonAt& attributes, std::optional<std::int64_t> vertices) const {
    target.object();
    const std::optional<std::int64_t> count = attributeCount(target, true);
    for (const auto& [name, ignored] : target.value().items()) {
      if (!attributes.find(name)) target.at(name).fail("the primitive has no such attribute to move");
    }
    if (count && vertices && *count != *vertices) {
      target.fail(fmt::format("has {} elements, the primitive {}", *count, *vertices));
    }
  }

  static void joints(const JsonAt& attributes) {
    for (const auto& [name, ignored] : attributes.value().items()) {
      for (const auto& [own, other] : {std::pair{"JOINTS_", "WEIGHTS_"}, std::pair{"WEIGHTS_", "JOINTS_"}}) {
        if (!name.starts_with(own)) continue;
        const std::string partner = other + name.substr(std::string_view(own).size());
        if (!attributes.find(partner)) attributes.at(name).fail("comes without " + partner);
      }
    }
  }

  const Document& document_;
  bool quantized_;
};

std::size_t targetCount(const JsonAt& primitive) {
  const auto targets = primitive.find("targets");
  return targets ? targets->arraySize() : 0;
}

}  // namespace

void validateMeshes(const Document& document) {
  const auto meshes = document.root().find("meshes");
  if (!meshes) return;
  MeshCheck check(document);
  for (const JsonAt& mesh : meshes->items()) {
    const std::vector<JsonAt> primitives = mesh.at("primitives").items();
    if (primitives.empty()) mesh.at("primitives").warn("is empty, nothing is drawn");
    for (const JsonAt& primitive : primitives) {
      check.primitive(primitive);
      if (targetCount(primitive) != targetCount(primitives[0])) {
        primitive.fail("has another number of morph targets than the mesh's first primitive");
      }
    }
    if (const auto weights = mesh.find("weights")) {
      weights->numbers(primitives.empty() ? weights->arraySize() : targetCount(primitives[0]));
    }
  }
}

}  // namespace crosslight::gltf

// Animations: samplers have an input of times and an output of the right length and format for what they drive.
#include <fmt/format.h>

#include "scene/gltf_document.h"

namespace crosslight::gltf {
namespace {

struct SamplerShape {
  std::int64_t keys = 0;
  std::int64_t values = 0;
  std::string type;
  bool isFloat = false;
};

SamplerShape validateSampler(const JsonAt& sampler, const Document& document) {
  const auto accessorOf = [&](const char* key) {
    return document.entry("accessors", sampler.at(key).reference(document.count("accessors"), "accessor"));
  };
  const JsonAt input = accessorOf("input");
  if (input.at("type").string() != "SCALAR" || input.at("componentType").integer() != kFloat) {
    sampler.at("input").fail("its accessor must be SCALAR of component type 5126");
  }
  const JsonAt output = accessorOf("output");
  if (output.at("componentType").integer() == kUnsignedInt) {
    sampler.at("output").fail("its accessor must not be of component type 5125");
  }
  std::string interpolation = "LINEAR";
  if (const auto named = sampler.find("interpolation")) interpolation = named->oneOf({"LINEAR", "STEP", "CUBICSPLINE"});
  SamplerShape shape{input.at("count").integer(), output.at("count").integer(), output.at("type").string(),
                     output.at("componentType").integer() == kFloat};
  if (interpolation == "CUBICSPLINE") {
    // In-tangent, value and out-tangent for every key.
    if (shape.values % 3 != 0) sampler.at("output").fail("CUBICSPLINE needs three values for each key");
    shape.values /= 3;
  }
  return shape;
}

std::int64_t weightCount(const Document& document, const JsonAt& node) {
  const auto mesh = node.find("mesh");
  if (!mesh) return 0;
  const JsonAt primitives =
      document.entry("meshes", mesh->reference(document.count("meshes"), "mesh")).at("primitives");
  if (primitives.arraySize() == 0) return 0;
  const auto targets = primitives.item(0).find("targets");
  return targets ? static_cast<std::int64_t>(targets->arraySize()) : 0;
}

void validateChannel(const JsonAt& channel, const std::vector<SamplerShape>& samplers, const Document& document) {
  const SamplerShape& shape = samplers[channel.at("sampler").reference(samplers.size(), "sampler")];
  const JsonAt target = channel.at("target");
  const std::string& path = target.at("path").string();
  const int node = referenceOr(target, "node", document.count("nodes"), "node");
  const bool isWeights = path == "weights";
  if (path != "translation" && path != "rotation" && path != "scale" && !isWeights) {
    target.at("path").warn("'" + path + "' is not supported, the channel is left out");
    return;
  }
  const std::string type = isWeights ? "SCALAR" : path == "rotation" ? "VEC4" : "VEC3";
  if (shape.type != type) channel.fail("drives " + path + " with " + shape.type + ", " + type + " is needed");
  if (!shape.isFloat && (path == "translation" || path == "scale")) {
    channel.fail("drives " + path + " with integers, which glTF does not allow");
  }
  if (node < 0) return;  // nothing is driven
  const std::int64_t each =
      isWeights ? weightCount(document, document.entry("nodes", static_cast<std::size_t>(node))) : 1;
  if (isWeights && each == 0) {
    channel.warn("drives weights of a node without morph targets, the channel is left out");
  } else if (shape.values != shape.keys * each) {
    channel.fail(fmt::format("its sampler has {} values for {} keys of {}", shape.values, shape.keys, each));
  }
}

}  // namespace

void validateAnimations(const Document& document) {
  const auto animations = document.root().find("animations");
  if (!animations) return;
  for (const JsonAt& animation : animations->items()) {
    std::vector<SamplerShape> samplers;
    for (const JsonAt& sampler : animation.at("samplers").items())
      samplers.push_back(validateSampler(sampler, document));
    for (const JsonAt& channel : animation.at("channels").items()) validateChannel(channel, samplers, document);
  }
}

}  // namespace crosslight::gltf

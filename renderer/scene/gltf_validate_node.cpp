// Nodes, scenes, skins and cameras: the hierarchy must be a forest, transforms finite, references resolved.
#include <fmt/format.h>

#include <cmath>

#include "scene/gltf_document.h"

namespace crosslight::gltf {
namespace {

// A quaternion whose parts are 8-bit normalized integers has this length at worst: each part is off by 1/254, so the
// length is off by at most sqrt(4) / 254.
constexpr double kUnitTolerance = 2.0 / 254.0;

void validateTransform(const JsonAt& node) {
  const auto matrix = node.find("matrix");
  if (matrix) matrix->numbers(16);
  if (const auto part = node.find("translation")) part->numbers(3);
  if (const auto part = node.find("scale")) part->numbers(3);
  if (const auto part = node.find("rotation")) {
    double squared = 0.0;
    for (const double value : part->numbers(4, Range::between(-1.0 - kUnitTolerance, 1.0 + kUnitTolerance))) {
      squared += value * value;
    }
    if (squared == 0.0) part->fail("is a quaternion of length 0");
    if (!(std::abs(std::sqrt(squared) - 1.0) <= kUnitTolerance)) part->warn("is no unit quaternion; it is normalized");
  }
  if (matrix && (node.find("translation") || node.find("rotation") || node.find("scale"))) {
    node.warn("has a matrix and a translation, rotation or scale; the matrix counts");
  }
}

std::size_t morphTargets(const Document& document, std::size_t mesh) {
  const JsonAt primitives = document.entry("meshes", mesh).at("primitives");
  if (primitives.arraySize() == 0) return 0;
  const auto targets = primitives.item(0).find("targets");
  return targets ? targets->arraySize() : 0;
}

void validateNode(const JsonAt& node, const Document& document) {
  validateTransform(node);
  referenceOr(node, "camera", document.count("cameras"), "camera");
  const int mesh = referenceOr(node, "mesh", document.count("meshes"), "mesh");
  const int skin = referenceOr(node, "skin", document.count("skins"), "skin");
  if (skin >= 0 && mesh < 0) node.at("skin").warn("has no meaning without a mesh");
  if (const auto weights = node.find("weights")) {
    if (mesh < 0) weights->warn("have no meaning without a mesh");
    const std::size_t expected =
        mesh < 0 ? weights->arraySize() : morphTargets(document, static_cast<std::size_t>(mesh));
    weights->numbers(expected);
  }
}

// Each node has one parent at most. Then a loop is a set of nodes that no root reaches.
void validateHierarchy(const JsonAt& nodes, std::vector<int>& parents) {
  parents.assign(nodes.arraySize(), -1);
  std::vector<std::vector<std::size_t>> children(parents.size());
  for (std::size_t i = 0; i < parents.size(); ++i) {
    const auto list = nodes.item(i).find("children");
    if (!list) continue;
    if (list->arraySize() == 0) list->warn("is empty, which glTF does not allow");
    for (const JsonAt& child : list->items()) {
      const std::size_t index = child.reference(parents.size(), "node");
      if (parents[index] >= 0) child.fail(fmt::format("node {} already has the parent {}", index, parents[index]));
      parents[index] = static_cast<int>(i);
      children[i].push_back(index);
    }
  }
  std::vector<std::size_t> reached;
  for (std::size_t i = 0; i < parents.size(); ++i) {
    if (parents[i] < 0) reached.push_back(i);
  }
  std::vector<bool> seen(parents.size(), false);
  for (std::size_t next = 0; next < reached.size(); ++next) {
    seen[reached[next]] = true;
    for (const std::size_t child : children[reached[next]]) reached.push_back(child);
  }
  for (std::size_t i = 0; i < parents.size(); ++i) {
    if (!seen[i]) nodes.item(i).fail("is its own ancestor: the nodes form a loop");
  }
}

// `listedBy` holds the last scene (counted from 1) that listed a node.
void validateScene(const JsonAt& scene, std::size_t number, const std::vector<int>& parents,
                   std::vector<std::size_t>& listedBy) {
  const auto list = scene.find("nodes");
  if (!list) return;
  if (list->arraySize() == 0) list->warn("is empty, which glTF does not allow");
  for (const JsonAt& entry : list->items()) {
    const std::size_t node = entry.reference(parents.size(), "node");
    if (parents[node] >= 0)
      entry.fail(fmt::format("node {} has the parent {}, a scene lists roots", node, parents[node]));
    if (listedBy[node] == number) entry.fail(fmt::format("node {} is listed twice", node));
    listedBy[node] = number;
  }
}

void validateSkin(const JsonAt& skin, const Document& document) {
  const JsonAt joints = skin.at("joints");
  if (joints.arraySize() == 0) joints.warn("is empty, which glTF does not allow");
  for (const JsonAt& joint : joints.items()) joint.reference(document.count("nodes"), "node");
  referenceOr(skin, "skeleton", document.count("nodes"), "node");
  const int matrices = referenceOr(skin, "inverseBindMatrices", document.count("accessors"), "accessor");
  if (matrices < 0) return;
  const JsonAt at = skin.at("inverseBindMatrices");
  const JsonAt accessor = document.entry("accessors", static_cast<std::size_t>(matrices));
  if (accessor.at("type").string() != "MAT4" || accessor.at("componentType").integer() != kFloat) {
    at.fail("its accessor must be MAT4 of component type 5126");
  }
  if (static_cast<std::uint64_t>(accessor.at("count").integer()) < joints.arraySize()) {
    at.fail(fmt::format("has {} matrices for {} joints", accessor.at("count").integer(), joints.arraySize()));
  }
}

void validateCamera(const JsonAt& camera) {
  const std::string type = camera.at("type").oneOf({"perspective", "orthographic"});
  const JsonAt lens = camera.at(type);
  if (type == "perspective") {
    lens.at("yfov").number(Range{0.0, 3.141592653589793, true});
    const double zNear = lens.at("znear").number(Range::above(0.0));
    if (const auto zFar = lens.find("zfar")) zFar->number(Range::above(zNear));
    numberOr(lens, "aspectRatio", 1.0, Range::above(0.0));
    return;
  }
  const double zNear = lens.at("znear").number(Range::atLeast(0.0));
  lens.at("zfar").number(Range::above(zNear));
  for (const char* key : {"xmag", "ymag"}) {
    const JsonAt half = lens.at(key);
    if (half.number() == 0.0) half.fail("must not be 0");
    if (half.number() < 0.0) half.warn("is negative; its amount counts");
  }
}

}  // namespace

void validateNodes(const Document& document) {
  const JsonAt root = document.root();
  std::vector<int> parents;
  if (const auto nodes = root.find("nodes")) {
    for (const JsonAt& node : nodes->items()) validateNode(node, document);
    validateHierarchy(*nodes, parents);
  }
  if (const auto scenes = root.find("scenes")) {
    std::vector<std::size_t> listedBy(parents.size(), 0);
    for (std::size_t i = 0; i < scenes->arraySize(); ++i) validateScene(scenes->item(i), i + 1, parents, listedBy);
  }
  referenceOr(root, "scene", document.count("scenes"), "scene");
  if (const auto skins = root.find("skins")) {
    for (const JsonAt& skin : skins->items()) validateSkin(skin, document);
  }
  if (const auto cameras = root.find("cameras")) {
    for (const JsonAt& camera : cameras->items()) validateCamera(camera);
  }
}

}  // namespace crosslight::gltf

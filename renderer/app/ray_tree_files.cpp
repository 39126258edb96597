#include "app/ray_tree_files.h"

#include <fmt/format.h>

#include <charconv>

#include "base/error.h"
#include "base/file.h"

namespace crosslight {
namespace {

Json jsonOf(const glm::vec3& v) { return {v.x, v.y, v.z}; }
Json jsonOf(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

std::string orNumber(const std::string& name, const char* kind, std::size_t index) {
  return name.empty() ? fmt::format("{} {}", kind, index) : name;
}

Json hitJson(const RayTreeHit& hit, const Scene& scene) {
  Json json = {{"distance", hit.distance},
               {"position", jsonOf(hit.position)},
               {"normal", jsonOf(hit.normal)},
               {"object", objectNameOf(scene, hit.instanceId)},
               {"material", materialNameOf(scene, hit.materialId)},
               {"instanceId", hit.instanceId},
               {"primitiveId", hit.primitiveId},
               {"materialId", hit.materialId},
               {"lights", Json::array()}};
  for (std::size_t i = 0; i < hit.lights.size(); ++i) {
    json["lights"].push_back(
        {{"light", lightNameOf(scene, i)}, {"visible", hit.lights[i].visible}, {"value", jsonOf(hit.lights[i].value)}});
  }
  return json;
}

Json nodeJson(const RayTreeNode& node, const Scene& scene) {
  const auto indexOr = [](const std::optional<std::size_t>& i) { return i ? Json(*i) : Json(nullptr); };
  return {{"ray", nameOf(node.kind)},
          {"depth", node.depth},
          {"origin", jsonOf(node.origin)},
          {"direction", jsonOf(node.direction)},
          {"medium", node.medium ? Json(materialNameOf(scene, *node.medium)) : Json(nullptr)},
          {"hit", node.hit ? hitJson(*node.hit, scene) : Json(nullptr)},
          {"own", jsonOf(node.own)},
          {"alpha", node.alpha},
          {"weight", jsonOf(node.weight)},
          {"value", jsonOf(node.value)},
          {"contribution", jsonOf(node.pathWeight * node.own)},
          {"parent", indexOr(node.parent)},
          {"reflected", indexOr(node.reflected)},
          {"transmitted", indexOr(node.transmitted)}};
}

}  // namespace

RayTreeFiles rayTreeFilesOf(const std::filesystem::path& output) {
  std::filesystem::path json = output, svg = output;
  return {json.replace_extension(".tree.json"), svg.replace_extension(".tree.svg")};
}

glm::uvec2 rayTreePixelOf(const std::string& text, std::uint32_t width, std::uint32_t height) {
  glm::uvec2 pixel(0);
  const char* const end = text.data() + text.size();
  const auto [comma, first] = std::from_chars(text.data(), end, pixel.x);
  if (first == std::errc{} && comma != end && *comma == ',') {
    const auto [stop, second] = std::from_chars(comma + 1, end, pixel.y);
    if (second == std::errc{} && stop == end && pixel.x < width && pixel.y < height) return pixel;
  }
  throw UsageError(
      fmt::format("--ray-tree: '{}' is no pixel X,Y of the picture, which has {} to {} across and {} to {} down", text,
                  0, width - 1, 0, height - 1));
}

const char* nameOf(RayKind kind) {
  constexpr const char* kNames[] = {"primary", "reflection", "refraction", "passThrough", "passThrough"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string objectNameOf(const Scene& scene, std::uint32_t instanceId) {
  for (const ShapeInstance& shape : scene.shapes) {
    if (shape.instanceId == instanceId) return orNumber(shape.name, "object", instanceId);
  }
  for (const MeshInstance& mesh : scene.instances) {
    if (mesh.instanceId == instanceId) return orNumber(mesh.name, "object", instanceId);
  }
  return orNumber("", "object", instanceId);
}

std::string materialNameOf(const Scene& scene, std::uint32_t materialId) {
  return orNumber(materialId < scene.materials.size() ? scene.materials[materialId].name : "", "material", materialId);
}

std::string lightNameOf(const Scene& scene, std::size_t light) {
  return orNumber(light < scene.lights.size() ? scene.lights[light].name : "", "light", light);
}

Json rayTreeJson(const RayTree& tree, const Scene& scene) {
  Json json = {{"schema", 1},
               {"pixel", {tree.pixel.x, tree.pixel.y}},
               {"offset", {0.5, 0.5}},
               {"color", {tree.color.x, tree.color.y, tree.color.z, tree.color.w}},
               {"units", "scene units, world space, linear Rec.709; contributions add up to the color"},
               {"nodes", Json::array()}};
  for (const RayTreeNode& node : tree.nodes) json["nodes"].push_back(nodeJson(node, scene));
  return json;
}

void writeRayTree(const std::filesystem::path& output, const RayTree& tree, const Scene& scene) {
  const RayTreeFiles files = rayTreeFilesOf(output);
  writeFileAtomically(files.json, rayTreeJson(tree, scene).dump(2) + "\n");
  writeFileAtomically(files.svg, rayTreeSvg(tree, scene));
}

}  // namespace crosslight

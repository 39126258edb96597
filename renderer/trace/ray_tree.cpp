#include "trace/ray_tree.h"

#include <glm/geometric.hpp>

#include "ray_tree_records.h"
#include "trace/level_recorder.h"

namespace crosslight {

using namespace shared;

namespace {

RayTreeHit hitOf(const RayTreeRecord& r, std::uint32_t node, const std::vector<std::vector<RayTreeLightRecord>>& lights,
                 const glm::dvec3& renderOrigin) {
  RayTreeHit hit;
  hit.distance = static_cast<double>(r.t) * glm::length(glm::dvec3(r.direction));
  hit.position = glm::dvec3(r.position) + renderOrigin;
  hit.normal = r.normal;
  hit.instanceId = r.instanceId;
  hit.primitiveId = r.primitiveId;
  hit.materialId = r.materialId;
  for (const std::vector<RayTreeLightRecord>& light : lights) {
    if (light[node].visible >= 0.0f) hit.lights.push_back({light[node].value, light[node].visible});
  }
  return hit;
}

// Follows the records from the camera's on; shaders/trace/gather.comp adds in this order.
class Assembly {
 public:
  Assembly(std::span<const RayTreeRecord> records, const std::vector<std::vector<RayTreeLightRecord>>& lights,
           const glm::dvec3& renderOrigin)
      : records_(records), lights_(lights), renderOrigin_(renderOrigin) {}

  // Value and coverage, with all that follows.
  glm::vec4 add(std::uint32_t at, std::optional<std::size_t> parent, RayTree& tree) const {
    const RayTreeRecord& r = records_[at];
    const std::size_t index = tree.nodes.size();
    tree.nodes.emplace_back();
    describe(at, parent, tree);
    glm::vec4 sum(r.own, r.alpha);
    if (r.reflected != kNoRayNode) {
      tree.nodes[index].reflected = tree.nodes.size();
      sum += glm::vec4(glm::vec3(add(r.reflected, index, tree)) * records_[r.reflected].weight, 0.0f);
    }
    if (r.transmitted != kNoRayNode) {
      tree.nodes[index].transmitted = tree.nodes.size();
      const glm::vec4 through = add(r.transmitted, index, tree);
      sum += glm::vec4(glm::vec3(through) * records_[r.transmitted].weight, (1.0f - sum.a) * through.a);
      for (std::uint32_t node = r.transmitted + 1; node < r.transmitted + r.transmittedCount; ++node)
        sum += glm::vec4(glm::vec3(add(node, index, tree)) * records_[node].weight, 0.0f);
    }
    tree.nodes[index].value = glm::vec3(sum);
    return sum;
  }

 private:
  void describe(std::uint32_t at, std::optional<std::size_t> parent, RayTree& tree) const {
    const RayTreeRecord& r = records_[at];
    RayTreeNode& node = tree.nodes.back();
    node.kind = static_cast<RayKind>(r.kind);
    node.depth = r.depth;
    node.origin = glm::dvec3(r.origin) + renderOrigin_;
    node.direction = glm::normalize(glm::dvec3(r.direction));
    if (r.medium != kNoRayNode) node.medium = r.medium;
    if (r.t >= 0.0f) node.hit = hitOf(r, at, lights_, renderOrigin_);
    node.own = r.own;
    node.alpha = r.alpha;
    node.parent = parent;
    if (!parent) return;
    node.weight = r.weight;
    node.pathWeight = tree.nodes[*parent].pathWeight * r.weight;
  }

  std::span<const RayTreeRecord> records_;
  const std::vector<std::vector<RayTreeLightRecord>>& lights_;
  glm::dvec3 renderOrigin_;
};

}  // namespace

RayTree assembleRayTree(const LevelRecorder& recorder, std::uint32_t lightCount, const glm::dvec3& renderOrigin,
                        const glm::vec4& sampleColor, bool branches, const glm::uvec2& pixel) {
  std::vector<RayTreeRecord> records = recorder.nodes();
  if (!branches) {  // no node was kept: the sample is all there is
    records[0].own = glm::vec3(sampleColor);
    records[0].alpha = sampleColor.a;
  }
  std::vector<std::vector<RayTreeLightRecord>> lights;
  for (std::uint32_t i = 0; i < lightCount; ++i) lights.push_back(recorder.lights(i));
  RayTree tree;
  tree.pixel = pixel;
  tree.color = Assembly(records, lights, renderOrigin).add(0, std::nullopt, tree);
  return tree;
}

}  // namespace crosslight

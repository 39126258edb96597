// One pixel's ray tree as values that can be shown: Whitted 1980, "An Improved Illumination Model for Shaded Display",
// Fig. 2. The numbers are those of the picture: added up in the same order they give its bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

namespace crosslight {

// Straight on are passThrough, from the camera's ray, and onward, from another.
enum class RayKind { primary, reflection, refraction, passThrough, onward };

struct RayTreeLight {
  glm::vec3 value{0.0f};  // what the light brings to the surface, within `own` before opacity
  float visible = 1.0f;   // share of it that arrives
};

// What a ray met. World space, scene units.
struct RayTreeHit {
  double distance = 0;
  glm::dvec3 position{0.0};
  glm::vec3 normal{0.0f};  // shading normal, unit
  std::uint32_t instanceId = 0, primitiveId = 0, materialId = 0;
  std::vector<RayTreeLight> lights;  // of the scene, in its order; none within a refracting body
};

struct RayTreeNode {
  RayKind kind = RayKind::primary;
  std::uint32_t depth = 0;                 // rays before it
  glm::dvec3 origin{0.0}, direction{0.0};  // world space; the direction is unit
  std::optional<std::uint32_t> medium;     // material that it travels in; none: the surroundings
  std::optional<RayTreeHit> hit;           // none: it leaves the scene
  glm::vec3 own{0.0f};  // what the surface sends back by itself, times its opacity; or the background
  float alpha = 0;
  glm::vec3 weight{1.0f};      // share of `value` in the parent's
  glm::vec3 value{0.0f};       // own, and what the rays that follow bring back
  glm::vec3 pathWeight{1.0f};  // product of the weights from the camera on: pathWeight * own is its part of the pixel
  std::optional<std::size_t> parent, reflected, transmitted;  // indices into RayTree::nodes
};

struct RayTree {
  glm::uvec2 pixel{0};
  glm::vec4 color{0.0f};           // premultiplied: value and coverage of the first node with all that follows
  std::vector<RayTreeNode> nodes;  // the camera's ray first, parents before their children; a preorder
};

}  // namespace crosslight

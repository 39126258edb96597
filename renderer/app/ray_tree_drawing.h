// What the two halves of a ray tree's drawing share.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "app/ray_tree_files.h"

namespace crosslight {

inline constexpr double kDrawingMargin = 24;  // pixels of the drawing

const char* colorOf(RayKind kind);
// For text and attributes in double quotes or none.
std::string escapedForSvg(const std::string& text);
std::string shown(const glm::vec3& linear);    // "#rrggbb" as a display shows it
std::string numbers(const glm::vec3& linear);  // three, or one where they are equal

// The rays in a plane: the camera's ray goes to the right, up is the direction in which what they meet is spread most.
class RayPlan {
 public:
  // Of the nodes that are `drawn`; the plan must not outlive its arguments.
  RayPlan(const RayTree& tree, const Scene& scene, const std::vector<bool>& drawn, double width);
  double height() const { return height_; }
  std::string svg() const;

 private:
  glm::dvec3 endOf(const RayTreeNode& node) const;
  void choosePlane();
  void fit(double width);
  glm::dvec2 at(const glm::dvec3& p) const;
  std::string line(const glm::dvec3& from, const glm::dvec3& to, const std::string& style) const;
  std::string ray(const RayTreeNode& node) const;
  std::string lightLines(const RayTreeHit& hit, std::size_t& drawnLines) const;

  const RayTree& tree_;
  const Scene& scene_;
  const std::vector<bool>& drawn_;
  glm::dvec3 right_{0.0}, up_{0.0}, start_{0.0};
  double missLength_ = 1, scale_ = 1, height_ = 0;
  glm::dvec2 center_{0.0}, middle_{0.0};
};

}  // namespace crosslight

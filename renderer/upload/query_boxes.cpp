#include "upload/query_boxes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace crosslight {
namespace {

// With B a triangle's largest coordinate and o the origin of a ray: a point that the triangle's test lets pass is off
// by gamma_8 (B + |o|) (shaders/accel/instances.glsl). Devices do not say how they round (Vulkan 1.3, "Ray Traversal");
// for (plane - o) / d, by fused steps or not, gamma_6 (B + |o|) covers the difference, the inverse, the product and the
// move to an instance's space, which is the identity here. gamma_24 leaves as much again.
constexpr double kRoundings = 24.0 * 0x1p-24;
constexpr double kMargin = kRoundings / (1.0 - kRoundings);

float largestCoordinate(const glm::vec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

// Of the coordinates at which rays begin. Rays of an orthographic camera are parallel: those that meet something begin
// no farther from the middle of its plane than that lies from there, which is sqrt(3) times its largest coordinate.
float reachOf(const Bounds& scene) {
  return scene.empty() ? 0.0f : 1.75f * std::max(largestCoordinate(scene.lower), largestCoordinate(scene.upper));
}

}  // namespace

std::vector<gpu::SearchBox> queryBoxes(const FlatScene& flat) {
  const double reach = reachOf(flat.bounds);
  std::vector<gpu::SearchBox> boxes(flat.triangleCount());
  for (std::size_t t = 0; t < boxes.size(); ++t) {
    const auto corner = [&](std::size_t k) { return flat.positions[flat.indices[3 * t + k]]; };
    const glm::vec3 lower = glm::min(corner(0), glm::min(corner(1), corner(2)));
    const glm::vec3 upper = glm::max(corner(0), glm::max(corner(1), corner(2)));
    const double largest = std::max(largestCoordinate(lower), largestCoordinate(upper));
    const double margin = kMargin * (largest + reach);
    for (int i = 0; i < 3; ++i) {
      boxes[t].lower[i] = std::nextafter(static_cast<float>(lower[i] - margin), -INFINITY);
      boxes[t].upper[i] = std::nextafter(static_cast<float>(upper[i] + margin), INFINITY);
    }
  }
  return boxes;
}

}  // namespace crosslight

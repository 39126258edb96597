#include "effects/view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace crosslight {
namespace {

// Samples lie up to 2 pixels beyond a pixel's center (the widest filter), lines are up to a pixel wide: 4 are enough.
constexpr double kPixelsBeyond = 4.0;

// Of the largest coordinate: shaders see positions rounded to floats, 2^-24, after a few operations.
constexpr double kRounding = 0x1p-18;

}  // namespace

std::array<glm::dvec3, 8> cornersOf(const DBounds& box, const glm::dmat4& worldFromObject) {
  std::array<glm::dvec3, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 p((i & 1u) ? box.upper.x : box.lower.x, (i & 2u) ? box.upper.y : box.lower.y,
                       (i & 4u) ? box.upper.z : box.lower.z);
    corners[i] = glm::dvec3(worldFromObject * glm::dvec4(p, 1.0));
  }
  return corners;
}

View::View(const Camera& camera, const RenderSettings& s) : cameraFromWorld_(glm::inverse(camera.worldFromCamera)) {
  const double halfY = camera.orthographic ? camera.yMag : std::tan(0.5 * camera.yFov);
  const double x = halfY * s.width / s.height * (1.0 + 2.0 * kPixelsBeyond / s.width);
  const double y = halfY * (1.0 + 2.0 * kPixelsBeyond / s.height);
  if (camera.orthographic) {
    // Rays may begin anywhere along the line of sight: no plane in front.
    planes_ = {{{{1, 0, 0}, x}, {{-1, 0, 0}, x}, {{0, 1, 0}, y}, {{0, -1, 0}, y}, {}}};
    planeCount_ = 4;
  } else {  // it looks along -Z
    planes_ = {{{{1, 0, x}, 0}, {{-1, 0, x}, 0}, {{0, 1, y}, 0}, {{0, -1, y}, 0}, {{0, 0, 1}, 0}}};
    planeCount_ = 5;
  }
}

bool View::mayShow(const DBounds& box, const glm::dmat4& worldFromObject) const {
  if (box.empty()) return false;
  const std::array<glm::dvec3, 8> corners = cornersOf(box, cameraFromWorld_ * worldFromObject);
  double largest = 0.0;
  for (const glm::dvec3& c : corners) largest = std::max({largest, std::abs(c.x), std::abs(c.y), std::abs(c.z)});
  for (int i = 0; i < planeCount_; ++i) {
    const Plane& plane = planes_[static_cast<std::size_t>(i)];
    const double margin = kRounding * largest * (1.0 + glm::length(plane.normal));
    const bool out = std::all_of(corners.begin(), corners.end(), [&](const glm::dvec3& c) {
      return glm::dot(plane.normal, c) > plane.offset + margin;
    });
    if (out) return false;
  }
  return true;
}

}  // namespace crosslight

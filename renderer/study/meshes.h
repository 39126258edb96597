// Closed meshes for cases and tests.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

namespace crosslight::study {

// Three corners per triangle, closed: the poles are single points, neighboring triangles share bit-identical corners.
inline std::vector<glm::vec3> uvSphereCorners(int rings, int segments, const glm::dvec3& center, double radius) {
  const auto at = [&](int i, int j) {
    const double theta = std::numbers::pi * i / rings, phi = 2 * std::numbers::pi * (j % segments) / segments;
    const double s = i == 0 || i == rings ? 0.0 : std::sin(theta);
    return glm::vec3(center + radius * glm::dvec3(s * std::cos(phi), std::cos(theta), s * std::sin(phi)));
  };
  std::vector<glm::vec3> corners;
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < segments; ++j) {
      if (i + 1 < rings) corners.insert(corners.end(), {at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      if (i > 0) corners.insert(corners.end(), {at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return corners;
}

}  // namespace crosslight::study

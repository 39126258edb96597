// Meshes of the accel tests, the same on every machine.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "accel/intersect.h"
#include "study/meshes.h"
#include "study/random_numbers.h"

namespace crosslight::testing {

using oracle::Ray;
using oracle::Triangle;

using study::Random;

inline std::vector<Bounds> boundsOf(const std::vector<Triangle>& triangles) {
  std::vector<Bounds> bounds;
  for (const Triangle& t : triangles) bounds.push_back(t.bounds());
  return bounds;
}

inline std::vector<Triangle> randomSoup(std::size_t count, double edge, std::uint64_t seed) {
  Random random(seed);
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 center = random.inBox(1);
    triangles.push_back({center + random.inBox(edge), center + random.inBox(edge), center + random.inBox(edge)});
  }
  return triangles;
}

// A grid of points that wraps around in both directions, as triangles.
template <class PointAt>
std::vector<Triangle> closedGrid(int rows, int columns, const PointAt& at) {
  std::vector<Triangle> triangles;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const int nextI = (i + 1) % rows, nextJ = (j + 1) % columns;
      const glm::vec3 a = at(i, j), b = at(nextI, j), c = at(nextI, nextJ), d = at(i, nextJ);
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  return triangles;
}

inline std::vector<Triangle> torusKnot(int rows, int columns) {
  const auto curve = [](double t) {
    const double r = 0.6 + 0.25 * std::cos(3 * t);
    return glm::dvec3(r * std::cos(2 * t), r * std::sin(2 * t), 0.25 * std::sin(3 * t));
  };
  const auto pointAt = [&](int i, int j) {
    const double t = 2 * std::numbers::pi * i / rows, phi = 2 * std::numbers::pi * j / columns;
    const glm::dvec3 tangent = curve(t + 1e-4) - curve(t - 1e-4), out = curve(t);
    glm::dvec3 side{tangent.y * out.z - tangent.z * out.y, tangent.z * out.x - tangent.x * out.z,
                    tangent.x * out.y - tangent.y * out.x};
    side /= std::sqrt(side.x * side.x + side.y * side.y + side.z * side.z);
    glm::dvec3 other{side.y * tangent.z - side.z * tangent.y, side.z * tangent.x - side.x * tangent.z,
                     side.x * tangent.y - side.y * tangent.x};
    other /= std::sqrt(other.x * other.x + other.y * other.y + other.z * other.z);
    return glm::vec3(out + 0.12 * (std::cos(phi) * side + std::sin(phi) * other));
  };
  return closedGrid(rows, columns, pointAt);
}

// Closed: the poles are single points, neighboring triangles share bit-identical corners.
inline std::vector<Triangle> uvSphere(int rings, int segments, const glm::dvec3& center, double radius) {
  const std::vector<glm::vec3> corners = study::uvSphereCorners(rings, segments, center, radius);
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < corners.size(); i += 3) triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
  return triangles;
}

}  // namespace crosslight::testing

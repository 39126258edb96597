// Meshes and random numbers of the accel tests: the same on every machine, because nothing of <random>'s
// implementation-defined distributions is used.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "accel/intersect.h"

namespace crosslight::testing {

using oracle::Ray;
using oracle::Triangle;

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  double unit() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits_() % n); }
  glm::vec3 inBox(double half) {
    const double x = between(-half, half), y = between(-half, half), z = between(-half, half);
    return glm::vec3(glm::dvec3(x, y, z));
  }
  glm::dvec3 direction() {
    const double z = between(-1, 1), phi = between(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
  }

 private:
  std::mt19937_64 bits_;
};

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
  const auto at = [&](int i, int j) {
    const double theta = std::numbers::pi * i / rings, phi = 2 * std::numbers::pi * (j % segments) / segments;
    const double s = i == 0 || i == rings ? 0.0 : std::sin(theta);
    return glm::vec3(center + radius * glm::dvec3(s * std::cos(phi), std::cos(theta), s * std::sin(phi)));
  };
  std::vector<Triangle> triangles;
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < segments; ++j) {
      if (i + 1 < rings) triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      if (i > 0) triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return triangles;
}

}  // namespace crosslight::testing

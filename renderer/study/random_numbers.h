// Random numbers that are the same on every machine: nothing of <random>'s implementation-defined distributions is
// used.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <numbers>
#include <random>

namespace crosslight::study {

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

}  // namespace crosslight::study

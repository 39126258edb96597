// Where within a pixel samples lie.
#include <algorithm>
#include <bit>
#include <cmath>

#include "film/film.h"

namespace crosslight {
namespace {

// First two dimensions of Sobol's sequence as 32-bit fractions: bit reversal, and the generator matrix of x + 1.
std::uint32_t sobol0(std::uint32_t i) {
  std::uint32_t v = 0;
  for (int bit = 0; bit < 32; ++bit) v |= ((i >> bit) & 1u) << (31 - bit);
  return v;
}

std::uint32_t sobol1(std::uint32_t i) {
  std::uint32_t result = 0;
  for (std::uint32_t column = 1u << 31; i != 0; i >>= 1, column ^= column >> 1) {
    if (i & 1u) result ^= column;
  }
  return result;
}

std::uint32_t mix(std::uint64_t x) {  // splitmix64 (Steele, Lea, Flood 2014), upper half
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return static_cast<std::uint32_t>((x ^ (x >> 31)) >> 32);
}

// Inverse of the cumulative tent on [-1, 1].
double tentWarp(double u) { return u < 0.5 ? std::sqrt(2.0 * u) - 1.0 : 1.0 - std::sqrt(2.0 * (1.0 - u)); }

// Inverse of the cumulative Gaussian of deviation 1/2, cut at +-3/2 pixels; bisection to the last bit.
double gaussianWarp(double u) {
  constexpr double kSigma = 0.5, kRadius = 1.5;
  const double edge = std::erf(kRadius / (kSigma * std::sqrt(2.0)));
  double low = -kRadius, high = kRadius;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.5 * (low + high);
    (std::erf(x / (kSigma * std::sqrt(2.0))) < (2.0 * u - 1.0) * edge ? low : high) = x;
  }
  return 0.5 * (low + high);
}

double warp(double u, FilterShape filter) {
  switch (filter) {
    case FilterShape::box:
      return u;
    case FilterShape::tent:
      return 0.5 + tentWarp(u);
    case FilterShape::gaussian:
      return 0.5 + gaussianWarp(u);
  }
  return u;
}

}  // namespace

std::vector<glm::vec2> samplePattern(std::uint32_t count, FilterShape filter, std::uint64_t seed) {
  if (count <= 1) return {glm::vec2(0.5f)};
  // Seed 0: samples stand in the middle of their elementary intervals, never on a pixel's edge. Other seeds shift the
  // sequence digitally and move each sample within its interval.
  const double cells = static_cast<double>(std::bit_ceil(count));
  const auto place = [&](std::uint32_t bits, std::uint64_t dimension, std::uint32_t sample) {
    const std::uint64_t key = (seed << 33) ^ (std::uint64_t{sample} << 1) ^ dimension;
    const std::uint32_t shift = seed == 0 ? 0u : mix(2 * seed + dimension);
    const double within = seed == 0 ? 0.5 : std::ldexp(static_cast<double>(mix(key)) + 0.5, -32);
    const double cell = std::floor(std::ldexp(static_cast<double>(bits ^ shift), -32) * cells);
    return static_cast<float>(warp((cell + within) / cells, filter));
  };
  std::vector<glm::vec2> offsets;
  for (std::uint32_t i = 0; i < count; ++i) offsets.emplace_back(place(sobol0(i), 0, i), place(sobol1(i), 1, i));
  return offsets;
}

}  // namespace crosslight

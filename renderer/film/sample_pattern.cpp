#include "film/sample_pattern.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

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

std::uint64_t mixed(std::uint64_t x) {  // splitmix64 (Steele, Lea, Flood 2014)
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

std::uint32_t wordOf(std::uint64_t x) { return static_cast<std::uint32_t>(mixed(x) >> 32); }

// Each bit is turned over or not by what stands before it: every elementary interval is permuted by itself.
std::uint32_t scrambled(std::uint32_t bits, std::uint64_t key) {
  std::uint32_t result = 0;
  for (int bit = 31; bit >= 0; --bit) {
    const std::uint64_t before = bit == 31 ? 0 : (bits >> (bit + 1)) | (std::uint64_t{1} << (31 - bit));
    result |= (((bits >> bit) & 1u) ^ (wordOf(key ^ (before << 8) ^ static_cast<std::uint64_t>(bit)) & 1u)) << bit;
  }
  return result;
}

// Inverse of the cumulative tent on [-1, 1].
double tentWarp(double u) { return u < 0.5 ? std::sqrt(2.0 * u) - 1.0 : 1.0 - std::sqrt(2.0 * (1.0 - u)); }

// Where an increasing function on [-radius, radius] takes a value; to the last bit.
double inverse(const std::function<double(double)>& increasing, double value, double radius) {
  double low = -radius, high = radius;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.5 * (low + high);
    (increasing(x) < value ? low : high) = x;
  }
  return 0.5 * (low + high);
}

// Of deviation 1/2, cut at +-3/2 pixels.
double gaussianWarp(double u) {
  constexpr double kSigma = 0.5, kRadius = 1.5;
  const double edge = std::erf(kRadius / (kSigma * std::sqrt(2.0)));
  return inverse([](double x) { return std::erf(x / (kSigma * std::sqrt(2.0))); }, (2.0 * u - 1.0) * edge, kRadius);
}

double mitchell(double x) {
  const double a = std::abs(x);
  if (a >= 2.0) return 0.0;
  return a < 1.0 ? (a * a * (7.0 * a - 12.0) + 16.0 / 3.0) / 6.0
                 : (((-7.0 / 3.0 * a + 12.0) * a - 20.0) * a + 32.0 / 3.0) / 6.0;
}

// Integral of mitchell() from 0 to a >= 0.
double mitchellIntegral(double a) {
  if (a < 1.0) return a * (a * a * (1.75 * a - 4.0) + 16.0 / 3.0) / 6.0;
  constexpr double kAtOne = (1.75 - 4.0 + 16.0 / 3.0) / 6.0,
                   kOuterAtOne = (-7.0 / 12.0 + 4.0 - 10.0 + 32.0 / 3.0) / 6.0;
  return kAtOne - kOuterAtOne + a * (((-7.0 / 12.0 * a + 4.0) * a - 10.0) * a + 32.0 / 3.0) / 6.0;
}

// By the density |mitchell|: the filter is negative from its zero between 1 and 2 on.
double mitchellWarp(double u) {
  static const double zero = [] {
    double low = 1.0, high = 1.9;
    for (int i = 0; i < 60; ++i) (mitchell(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
    return 0.5 * (low + high);
  }();
  const auto area = [](double x) {
    const double a = std::abs(x);
    const double positive = mitchellIntegral(std::min(a, zero));
    return std::copysign(a > zero ? 2.0 * positive - mitchellIntegral(a) : positive, x);
  };
  return inverse(area, (2.0 * u - 1.0) * area(2.0), 2.0);
}

double warp(double u, FilterShape filter) {
  switch (filter) {
    case FilterShape::box:
      return u;
    case FilterShape::tent:
      return 0.5 + tentWarp(u);
    case FilterShape::gaussian:
      return 0.5 + gaussianWarp(u);
    case FilterShape::mitchell:
      return 0.5 + mitchellWarp(u);
  }
  return u;
}

// Uniform numbers in (0,1) of one sample: the largest float below 1 at most, so that no sample lies on the next pixel.
struct Uniform {
  double x, y;
};

double fraction(std::uint32_t bits) { return std::min(std::ldexp(bits + 0.5, -32), 1.0 - 0x1p-24); }

// Seed 0: samples stand in the middle of their elementary intervals, never on a pixel's edge.
Uniform sobolSample(std::uint32_t i, std::uint32_t count, std::uint64_t seed) {
  if (seed != 0)
    return {fraction(scrambled(sobol0(i), mixed(2 * seed))), fraction(scrambled(sobol1(i), mixed(2 * seed + 1)))};
  const double cells = static_cast<double>(std::bit_ceil(count));
  const auto middle = [&](std::uint32_t bits) { return (std::floor(std::ldexp(bits, -32) * cells) + 0.5) / cells; };
  return {middle(sobol0(i)), middle(sobol1(i))};
}

Uniform gridSample(std::uint32_t i, const SampleGrid& grid, std::uint64_t seed, bool jitters) {
  const auto within = [&](std::uint64_t dimension) {
    return jitters ? fraction(wordOf(mixed(seed) ^ (std::uint64_t{i} << 1) ^ dimension)) : 0.5;
  };
  return {(i % grid.columns + within(0)) / grid.columns, (i / grid.columns + within(1)) / grid.rows};
}

float sumOfWeights(const std::vector<PixelSample>& samples) {
  float sum = 0;
  for (const PixelSample& s : samples) sum += s.weight;
  return sum;
}

}  // namespace

SampleGrid sampleGrid(std::uint32_t count) {
  std::uint32_t rows = 1;
  for (std::uint32_t d = 1; d <= count / d; ++d) {
    if (count % d == 0) rows = d;
  }
  return {count / rows, rows};
}

std::vector<PixelSample> samplePattern(std::uint32_t count, FilterShape filter, std::uint64_t seed,
                                       SamplePlacement placement) {
  if (count <= 1) return {PixelSample{}};
  const SampleGrid grid = sampleGrid(count);
  std::vector<PixelSample> samples;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Uniform u = placement == SamplePlacement::sobol
                          ? sobolSample(i, count, seed)
                          : gridSample(i, grid, seed, placement == SamplePlacement::jittered);
    const double x = warp(u.x, filter), y = warp(u.y, filter);
    const bool negative = filter == FilterShape::mitchell && mitchell(x - 0.5) * mitchell(y - 0.5) < 0.0;
    samples.push_back({glm::vec2(static_cast<float>(x), static_cast<float>(y)), negative ? -1.0f : 1.0f});
  }
  if (sumOfWeights(samples) <= 0.0f) {
    for (PixelSample& s : samples) s.weight = 1.0f;
  }
  return samples;
}

}  // namespace crosslight

// Samples are where their filter's density says, spread as evenly as their placement promises.
#include "film/sample_pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace crosslight {
namespace {

constexpr FilterShape kFilters[] = {FilterShape::box, FilterShape::tent, FilterShape::gaussian, FilterShape::mitchell};
constexpr SamplePlacement kPlacements[] = {SamplePlacement::sobol, SamplePlacement::regular, SamplePlacement::jittered};

double radiusOf(FilterShape filter) {
  switch (filter) {
    case FilterShape::box:
      return 0.5;
    case FilterShape::tent:
      return 1.0;
    case FilterShape::gaussian:
      return 1.5;
    case FilterShape::mitchell:
      return 2.0;
  }
  return 0;
}

double densityOf(FilterShape filter, double x) {
  const double a = std::abs(x);
  switch (filter) {
    case FilterShape::box:
      return a < 0.5 ? 1.0 : 0.0;
    case FilterShape::tent:
      return std::max(1.0 - a, 0.0);
    case FilterShape::gaussian:
      return a < 1.5 ? std::exp(-2.0 * a * a) : 0.0;
    case FilterShape::mitchell:
      break;
  }
  // Mitchell, Netravali 1988, Eq. 8, with B = C = 1/3 put in.
  constexpr double b = 1.0 / 3, c = 1.0 / 3;
  if (a < 1) return ((12 - 9 * b - 6 * c) * a * a * a + (-18 + 12 * b + 6 * c) * a * a + (6 - 2 * b)) / 6;
  if (a >= 2) return 0;
  return ((-b - 6 * c) * a * a * a + (6 * b + 30 * c) * a * a + (-12 * b - 48 * c) * a + (8 * b + 24 * c)) / 6;
}

double integral(FilterShape filter, double (*f)(double)) {
  constexpr int kSteps = 40000;
  const double radius = radiusOf(filter), h = 2 * radius / kSteps;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double x = -radius + (i + 0.5) * h;
    sum += densityOf(filter, x) * f(x) * h;
  }
  return sum;
}

// Weighted means of smooth functions are the filter's moments. The box needs no quadrature, the regular grid's error
// falls with the square of its 64 columns; the constants are those of the smooth functions' second derivatives.
TEST(SamplePattern, integratesWhatTheFilterWeighs) {
  for (const FilterShape filter : kFilters) {
    for (const SamplePlacement placement : kPlacements) {
      const std::vector<PixelSample> samples = samplePattern(4096, filter, 3, placement);
      double weights = 0, second = 0, cosine = 0;
      for (const PixelSample& s : samples) {
        const double x = s.offset.x - 0.5, y = s.offset.y - 0.5;
        weights += s.weight;
        second += s.weight * x * x;
        cosine += s.weight * std::cos(2 * x + y);
      }
      const double norm = integral(filter, [](double) { return 1.0; });
      const double expectedSecond = integral(filter, [](double x) { return x * x; }) / norm;
      const double expectedCosine = integral(filter, [](double x) { return std::cos(2 * x); }) / norm *
                                    integral(filter, [](double x) { return std::cos(x); }) / norm;
      EXPECT_NEAR(second / weights, expectedSecond, 0.01) << int(filter) << " " << int(placement);
      EXPECT_NEAR(cosine / weights, expectedCosine, 0.01) << int(filter) << " " << int(placement);
    }
  }
}

TEST(SamplePattern, staysWithinItsRadius) {
  for (const FilterShape filter : kFilters) {
    for (const SamplePlacement placement : kPlacements) {
      for (const std::uint32_t count : {2u, 5u, 16u, 1000u}) {
        double sum = 0;
        for (const PixelSample& s : samplePattern(count, filter, 11, placement)) {
          EXPECT_LE(std::abs(s.offset.x - 0.5), radiusOf(filter));
          EXPECT_LE(std::abs(s.offset.y - 0.5), radiusOf(filter));
          const bool onTheNextPixel = filter == FilterShape::box && std::max(s.offset.x, s.offset.y) >= 1.0f;
          EXPECT_FALSE(onTheNextPixel);
          EXPECT_TRUE(s.weight == 1.0f || (filter == FilterShape::mitchell && s.weight == -1.0f));
          sum += s.weight;
        }
        EXPECT_GT(sum, 0.0);
      }
    }
  }
}

// Every elementary interval of 2^k samples holds exactly one, scrambled or not.
TEST(SamplePattern, sobolIsANetForEverySeed) {
  for (const std::uint64_t seed : {0ull, 1ull, 42ull}) {
    const std::vector<PixelSample> samples = samplePattern(64, FilterShape::box, seed);
    for (std::uint32_t columns = 1; columns <= 64; columns *= 2) {
      const std::uint32_t rows = 64 / columns;
      std::set<std::pair<int, int>> cells;
      for (const PixelSample& s : samples)
        cells.emplace(static_cast<int>(s.offset.x * static_cast<float>(columns)),
                      static_cast<int>(s.offset.y * static_cast<float>(rows)));
      EXPECT_EQ(cells.size(), 64u) << columns << " x " << rows << " cells, seed " << seed;
    }
  }
}

TEST(SamplePattern, gridsHoldOneSamplePerCell) {
  for (const SamplePlacement placement : {SamplePlacement::regular, SamplePlacement::jittered}) {
    for (const std::uint32_t count : {4u, 6u, 7u, 16u, 60u}) {
      const SampleGrid grid = sampleGrid(count);
      EXPECT_EQ(grid.columns * grid.rows, count);
      std::set<std::pair<int, int>> cells;
      for (const PixelSample& s : samplePattern(count, FilterShape::box, 5, placement)) {
        cells.emplace(static_cast<int>(s.offset.x * static_cast<float>(grid.columns)),
                      static_cast<int>(s.offset.y * static_cast<float>(grid.rows)));
      }
      EXPECT_EQ(cells.size(), count);
    }
  }
  EXPECT_EQ(sampleGrid(60).columns, 10u);
  EXPECT_EQ(sampleGrid(7).rows, 1u);
}

TEST(SamplePattern, seedsDifferAndRepeat) {
  for (const SamplePlacement placement : {SamplePlacement::sobol, SamplePlacement::jittered}) {
    const auto of = [&](std::uint64_t seed) { return samplePattern(16, FilterShape::box, seed, placement); };
    EXPECT_EQ(of(7), of(7));
    EXPECT_NE(of(7), of(8));
  }
}

// What scrambling is for: the error of a discontinuous integrand falls faster than with independent jitter. Root mean
// square over 64 seeds of the area below a slanted edge; Owen 1997 has n^-3/4 for it, jittered cells too, plain random
// n^-1/2.
TEST(SamplePattern, scrambledNetsEstimateEdgesBetterThanChance) {
  double squares = 0;
  constexpr int kSeeds = 64;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    double below = 0;
    for (const PixelSample& s : samplePattern(256, FilterShape::box, seed))
      below += s.offset.y < 0.3f + 0.4f * s.offset.x;
    squares += (below / 256 - 0.5) * (below / 256 - 0.5);
  }
  EXPECT_LT(std::sqrt(squares / kSeeds), 0.25 * std::sqrt(0.25 / 256)) << "a quarter of what chance gives";
}

}  // namespace
}  // namespace crosslight

// Order statistics by hand; the bootstrap against its exact distribution and against its promise, the coverage.
#include "measure/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "base/error.h"

namespace crosslight {
namespace {

using Samples = std::vector<double>;

TEST(Percentile, InterpolatesBetweenOrderStatistics) {
  const Samples four{40, 10, 30, 20};
  EXPECT_EQ(percentile(four, 0), 10);
  EXPECT_EQ(percentile(four, 1), 40);
  EXPECT_EQ(percentile(four, 1.0 / 3), 20);
  EXPECT_EQ(percentile(four, 0.25), 17.5);
  EXPECT_EQ(median(four), 25);
  EXPECT_EQ(median(Samples{3, 1, 2}), 2);
  EXPECT_EQ(median(Samples{5}), 5);
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(median(Samples{inf, inf, 1}), inf);
}

TEST(Percentile, RefusesNothingAndPassesNaNOn) {
  EXPECT_THROW(median(Samples{}), InternalError);
  EXPECT_THROW(percentile(Samples{1}, 1.5), InternalError);
  EXPECT_TRUE(std::isnan(median(Samples{1, std::nan(""), 2})));
  EXPECT_TRUE(std::isnan(medianEstimate(Samples{1, std::nan(""), 2}).low));
}

TEST(MedianEstimate, OfEqualSamplesIsAPoint) {
  const Estimate e = medianEstimate(Samples(20, 4.5));
  EXPECT_EQ(e.value, 4.5);
  EXPECT_EQ(e.low, 4.5);
  EXPECT_EQ(e.high, 4.5);
}

TEST(MedianEstimate, IsTheSameEveryTimeAndFollowsTheSeed) {
  Samples samples;
  for (int i = 0; i < 30; ++i) samples.push_back(std::sin(i));
  const Estimate a = medianEstimate(samples), b = medianEstimate(samples);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
  EXPECT_LE(a.low, a.value);
  EXPECT_LE(a.value, a.high);
  EXPECT_THROW(medianEstimate(samples, {.resamples = 100}), InternalError);
}

double binomialUpperTail(int n, double p, int atLeast) {
  double sum = 0;
  for (int k = atLeast; k <= n; ++k) {
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) + k * std::log(p) +
                    (n - k) * std::log1p(-p));
  }
  return sum;
}

// For odd n the resample's median is at most the k-th smallest sample if at least (n + 1) / 2 draws are among the k
// smallest: the interval's ends are order statistics that a binomial distribution gives exactly.
TEST(MedianEstimate, HasTheEndsOfTheExactBootstrapDistribution) {
  for (const int n : {5, 11, 21, 51}) {
    Samples samples;
    for (int i = 0; i < n; ++i) samples.push_back(i + 1);
    const auto exact = [&](double share) {
      int k = 1;
      while (k < n && binomialUpperTail(n, static_cast<double>(k) / n, (n + 1) / 2) < share) ++k;
      return k;
    };
    const Estimate e = medianEstimate(samples, {.resamples = 20000});
    // 20000 resamples place a share of 0.025 within 3 sqrt(0.025 * 0.975 / 20000) = 0.0033.
    EXPECT_GE(e.low, exact(0.025 - 0.0033)) << n;
    EXPECT_LE(e.low, exact(0.025 + 0.0033)) << n;
    EXPECT_GE(e.high, exact(0.975 - 0.0033)) << n;
    EXPECT_LE(e.high, exact(0.975 + 0.0033)) << n;
  }
}

// Of 400 experiments with 41 samples each about 95 % must cover the true median. The percentile interval's exact
// coverage depends on n by the discreteness of order statistics (about 0.94 to 0.97 here); three standard deviations of
// a share from 400 are 0.033.
TEST(MedianEstimate, CoversTheTrueMedianAsOftenAsItSays) {
  std::mt19937_64 bits(7);
  int covered = 0;
  constexpr int kExperiments = 400;
  for (int i = 0; i < kExperiments; ++i) {
    Samples samples(41);
    for (double& x : samples) x = -std::log1p(-static_cast<double>(bits() >> 11) * 0x1p-53);  // exponential
    const Estimate e = medianEstimate(samples);
    covered += e.low <= std::log(2.0) && std::log(2.0) <= e.high;
  }
  EXPECT_GE(covered, kExperiments * (0.94 - 0.033));
  EXPECT_LE(covered, kExperiments * (0.97 + 0.033));
}

TEST(RatioEstimate, CancelsWhatDisturbsBothOfAPair) {
  std::mt19937_64 bits(9);
  Samples slow, fast;
  for (int i = 0; i < 40; ++i) {
    const double load = 1 + 9 * static_cast<double>(bits() >> 11) * 0x1p-53,
                 noise = static_cast<double>(i % 3 - 1) * 0.01;
    fast.push_back(10 * load);
    slow.push_back(25 * load * (1 + noise));
  }
  const Estimate ratio = ratioEstimate(slow, fast);
  constexpr double kRounded = 2.5 * 5 * 0x1p-53;  // four products and a quotient
  EXPECT_NEAR(ratio.value, 2.5, kRounded);
  EXPECT_GE(ratio.low, 2.5 * 0.99 - kRounded);
  EXPECT_LE(ratio.high, 2.5 * 1.01 + kRounded);
  const Estimate unpaired = medianEstimate(slow);
  EXPECT_GT((unpaired.high - unpaired.low) / unpaired.value, 0.1) << "the load alone would blur it";
  EXPECT_THROW(ratioEstimate(slow, Samples{1}), InternalError);
}

}  // namespace
}  // namespace crosslight

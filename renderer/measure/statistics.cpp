#include "measure/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "base/check.h"

namespace crosslight {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMinResamples = 2000;
constexpr double kTail = 0.025;  // on either side of a 95 % interval

bool hasNaN(std::span<const double> samples) {
  return std::any_of(samples.begin(), samples.end(), [](double x) { return std::isnan(x); });
}

double sortedPercentile(const std::vector<double>& sorted, double share) {
  const double position = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  // Equal neighbors first: infinity minus infinity is no number.
  if (sorted[below] == sorted[above]) return sorted[below];
  return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

// The remainder's bias is below n / 2^64; std::uniform_int_distribution differs from library to library.
std::size_t draw(std::mt19937_64& bits, std::size_t n) { return static_cast<std::size_t>(bits() % n); }

}  // namespace

double percentile(std::span<const double> samples, double share) {
  CL_CHECK(!samples.empty());
  CL_CHECK(share >= 0 && share <= 1);
  if (hasNaN(samples)) return kNaN;
  std::vector<double> sorted(samples.begin(), samples.end());
  std::sort(sorted.begin(), sorted.end());
  return sortedPercentile(sorted, share);
}

double median(std::span<const double> samples) { return percentile(samples, 0.5); }

Estimate medianEstimate(std::span<const double> samples, const BootstrapOptions& options) {
  CL_CHECK(!samples.empty());
  CL_CHECK_LE(kMinResamples, options.resamples);
  if (hasNaN(samples)) return {kNaN, kNaN, kNaN};
  std::mt19937_64 bits(options.seed);
  std::vector<double> medians(options.resamples);
  std::vector<double> resample(samples.size());
  for (double& result : medians) {
    for (double& x : resample) x = samples[draw(bits, samples.size())];
    std::sort(resample.begin(), resample.end());
    result = sortedPercentile(resample, 0.5);
  }
  std::sort(medians.begin(), medians.end());
  return {median(samples), sortedPercentile(medians, kTail), sortedPercentile(medians, 1 - kTail)};
}

Estimate ratioEstimate(std::span<const double> numerator, std::span<const double> denominator,
                       const BootstrapOptions& options) {
  CL_CHECK_EQ(numerator.size(), denominator.size());
  // A resample of pairs has the ratios of those pairs: drawing ratios is drawing pairs.
  std::vector<double> ratios(numerator.size());
  std::transform(numerator.begin(), numerator.end(), denominator.begin(), ratios.begin(),
                 [](double a, double b) { return a / b; });
  return medianEstimate(ratios, options);
}

}  // namespace crosslight

// Robust summaries of repeated measurements, with confidence intervals by the bootstrap (Efron 1979, "Bootstrap
// Methods: Another Look at the Jackknife"). Seeded: the same samples give the same interval.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace crosslight {

// At least one sample. NaN among the samples makes the result NaN.
double median(std::span<const double> samples);

// `share` in [0, 1]; between order statistics linear, the k-th of n standing at (k - 1) / (n - 1) (Hyndman and Fan
// 1996, type 7).
double percentile(std::span<const double> samples, double share);

struct Estimate {
  double value = 0;
  double low = 0;  // 95 % confidence interval
  double high = 0;
};

struct BootstrapOptions {
  std::size_t resamples = 2000;  // at least 2000: fewer make the interval's own ends noisy
  std::uint64_t seed = 1;
};

// Median and its percentile interval.
Estimate medianEstimate(std::span<const double> samples, const BootstrapOptions& options = {});

// Median of numerator[i] / denominator[i]. The pairs were measured side by side and are drawn as pairs, so that what
// disturbs both of a pair (clock, load) cancels. Spans of the same length.
Estimate ratioEstimate(std::span<const double> numerator, std::span<const double> denominator,
                       const BootstrapOptions& options = {});

}  // namespace crosslight

#include "bench/rounds.h"

#include <algorithm>

#include "base/check.h"
#include "base/interrupt.h"
#include "bench/cpu_time.h"
#include "measure/statistics.h"

namespace crosslight::bench {
namespace {

// Share of the machine that others may have had in a round that counts as undisturbed: it bounds how much slower
// they made it, and stays below what the report's intervals resolve.
constexpr double kCalmShare = 0.02;

struct Round {
  Measured measured;
  std::optional<double> otherSeconds;
  double load = 0;  // share of the machine that others had, beyond what the clock's grain explains
};

Measured runOnce(const std::vector<Contender>& contenders) {
  Measured all;
  for (const Contender& contender : contenders) {
    const Measured some = contender();
    all.insert(all.end(), some.begin(), some.end());
    throwIfInterrupted();
  }
  return all;
}

Measured mediansOf(const std::vector<Measured>& runs) {
  Measured result = runs.front();
  for (std::size_t i = 0; i < result.size(); ++i) {
    std::vector<double> ms;
    for (const Measured& run : runs) {
      CL_CHECK_EQ(run.size(), result.size());
      CL_CHECK_EQ(run[i].first, result[i].first);
      ms.push_back(run[i].second);
    }
    result[i].second = median(ms);
  }
  return result;
}

Round runRound(const std::vector<Contender>& contenders, double shortestSeconds) {
  Round round;
  const OtherCpuTimer timer;
  std::vector<Measured> runs{runOnce(contenders)};
  while (timer.wallSeconds() < shortestSeconds) runs.push_back(runOnce(contenders));
  round.measured = mediansOf(runs);
  round.otherSeconds = timer.otherSeconds();
  const double capacity = timer.wallSeconds() * cpuCount();
  round.load = std::max(0.0, round.otherSeconds.value_or(0.0) - cpuClockGrain()) / capacity;
  return round;
}

bool isCalm(const Round& round) { return round.load <= kCalmShare; }

// The `count` least loaded, in their order; all calm ones are equal.
std::vector<Round> calmest(std::vector<Round> rounds, std::size_t count) {
  std::vector<std::size_t> order(rounds.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::max(rounds[a].load, kCalmShare) < std::max(rounds[b].load, kCalmShare);
  });
  order.resize(std::min(count, order.size()));
  std::sort(order.begin(), order.end());
  std::vector<Round> kept;
  for (const std::size_t i : order) kept.push_back(std::move(rounds[i]));
  return kept;
}

}  // namespace

const std::vector<double>& Rounds::of(const std::string& name) const {
  const auto found = std::find_if(series.begin(), series.end(), [&](const auto& s) { return s.first == name; });
  if (found == series.end()) throw InternalError("nothing was measured under the name '" + name + "'");
  return found->second;
}

Rounds interleave(const std::vector<Contender>& contenders, const RoundOptions& options) {
  CL_CHECK_LT(std::size_t{0}, options.rounds);
  for (std::size_t i = 0; i < options.warmUps; ++i) runOnce(contenders);
  std::vector<Round> all;
  std::size_t calm = 0;
  while (calm < options.rounds && all.size() < 2 * options.rounds) {
    all.push_back(runRound(contenders, options.shortestSeconds));
    if (isCalm(all.back())) ++calm;
  }
  Rounds result;
  result.repeated = all.size() - options.rounds;
  const std::vector<Round> kept = calmest(std::move(all), options.rounds);
  result.count = kept.size();
  result.otherCpuSeconds = 0.0;
  for (const auto& [name, ms] : kept.front().measured) result.series.emplace_back(name, std::vector<double>());
  for (const Round& round : kept) {
    CL_CHECK_EQ(round.measured.size(), result.series.size());
    for (std::size_t i = 0; i < round.measured.size(); ++i) {
      CL_CHECK_EQ(round.measured[i].first, result.series[i].first);
      result.series[i].second.push_back(round.measured[i].second);
    }
    if (result.otherCpuSeconds && round.otherSeconds) *result.otherCpuSeconds += *round.otherSeconds;
    if (!round.otherSeconds) result.otherCpuSeconds.reset();
  }
  return result;
}

}  // namespace crosslight::bench

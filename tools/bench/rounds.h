// The timing protocol: contenders run side by side in one process, round after round (A B A B), so that clock, heat and
// load meet all of them; rounds in which other processes took the CPU are run again.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace crosslight::bench {

// What one run of one contender measured: (name, milliseconds).
using Measured = std::vector<std::pair<std::string, double>>;
using Contender = std::function<Measured()>;

struct RoundOptions {
  std::size_t rounds = 15;
  std::size_t warmUps = 2;  // the first runs compile shaders and fill caches; they do not count
  // A round goes A B A B until it has lasted this long; its value is the median of its runs. At 2 % of the machine for
  // others (what counts as calm) and 100 ticks per second, a shorter one could not tell load from the clock's grain.
  double shortestSeconds = 0.5;
};

// The rounds that count, in the order in which they ran.
struct Rounds {
  std::vector<std::pair<std::string, std::vector<double>>> series;  // by name: one value per round
  std::optional<double> otherCpuSeconds;  // of other processes while they ran; nothing where it cannot be told
  std::size_t count = 0;
  std::size_t repeated = 0;  // rounds that were dropped for their load

  const std::vector<double>& of(const std::string& name) const;  // milliseconds
};

// At most twice `rounds` are run; of more loaded ones than that the least loaded count, and otherCpuSeconds tells.
// Every contender must measure the same names each time.
Rounds interleave(const std::vector<Contender>& contenders, const RoundOptions& options);

}  // namespace crosslight::bench

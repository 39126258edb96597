// CPU time that others took while something was measured: a round with much of it says little about the program.
#pragma once

#include <optional>

#include "base/time.h"

namespace crosslight::bench {

// Between construction and `stop`. All busy CPU time of the machine (/proc/stat, time stolen by a hypervisor included)
// minus this process's and that of its children that have ended (getrusage).
class OtherCpuTimer {
 public:
  OtherCpuTimer();
  // Seconds, not negative; nothing where the system has no /proc/stat.
  std::optional<double> otherSeconds() const;
  double wallSeconds() const { return watch_.elapsedMs() * 1e-3; }

 private:
  Stopwatch watch_;
  std::optional<double> busyAtStart_;
  double ownAtStart_ = 0;
};

// /proc/stat counts in ticks, on every CPU: two readings can differ by this much, in seconds, without any load.
double cpuClockGrain();

// CPUs that this process may use.
unsigned cpuCount();

}  // namespace crosslight::bench

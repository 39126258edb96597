#include "bench/cpu_time.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <thread>

namespace crosslight::bench {
namespace {

double ticksPerSecond() { return static_cast<double>(sysconf(_SC_CLK_TCK)); }

// First line: "cpu user nice system idle iowait irq softirq steal guest guest_nice"; guests count in user already.
std::optional<double> busySeconds() {
  std::ifstream in("/proc/stat");
  std::string label;
  double user = 0, nice = 0, system = 0, idle = 0, iowait = 0, irq = 0, softirq = 0, steal = 0;
  in >> label >> user >> nice >> system >> idle >> iowait >> irq >> softirq >> steal;
  if (!in || label != "cpu" || user + system + idle <= 0) return std::nullopt;
  return (user + nice + system + irq + softirq + steal) / ticksPerSecond();
}

double secondsOf(const timeval& t) { return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6; }

double ownSeconds() {
  double sum = 0;
  for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    sum += secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
  }
  return sum;
}

}  // namespace

OtherCpuTimer::OtherCpuTimer() : busyAtStart_(busySeconds()), ownAtStart_(ownSeconds()) {}

std::optional<double> OtherCpuTimer::otherSeconds() const {
  const std::optional<double> busy = busySeconds();
  if (!busy || !busyAtStart_) return std::nullopt;
  return std::max(0.0, (*busy - *busyAtStart_) - (ownSeconds() - ownAtStart_));
}

double cpuClockGrain() { return static_cast<double>(sysconf(_SC_NPROCESSORS_ONLN)) / ticksPerSecond(); }

unsigned cpuCount() { return std::max(1u, std::thread::hardware_concurrency()); }

}  // namespace crosslight::bench

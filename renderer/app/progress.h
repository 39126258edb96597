// Progress of a long task on stderr: a bar on a terminal, plain lines for logs, or nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/time.h"

namespace crosslight {

enum class ProgressMode { none, plain, bar };

// "auto" is the bar on a terminal and nothing elsewhere; "bar" becomes plain lines where there is no terminal.
ProgressMode progressModeOf(const std::string& name, bool isTerminal);
const std::vector<std::string>& progressNames();  // auto, bar, plain, none

class Progress {
 public:
  using Sink = std::function<void(const std::string&)>;

  Progress(std::string task, ProgressMode mode, Sink sink);  // sink: what writes to stderr
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { clear(); }

  void update(std::uint64_t done, std::uint64_t total);
  void clear();  // takes the bar away, so that other lines can be printed

 private:
  void updateBar(std::uint64_t done, std::uint64_t total);
  void updatePlain(std::uint64_t done, std::uint64_t total);

  std::string task_;
  ProgressMode mode_;
  Sink sink_;
  Stopwatch sinceStart_;
  double lastDrawnMs_ = 0;
  std::uint64_t lastTenth_ = 0;
  bool drawn_ = false;
};

// A progress of this process: mode by name, writing to stderr.
ProgressMode progressModeOfStderr(const std::string& name);
void writeToStderr(const std::string& text);

}  // namespace crosslight

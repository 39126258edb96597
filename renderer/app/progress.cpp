#include "app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace crosslight {
namespace {

// Short tasks show no bar, and the eye needs no more than ten pictures a second.
constexpr double kRedrawMs = 100;
constexpr std::uint64_t kBarCells = 40;
// Before this much is done the time left is a guess that jumps about.
constexpr double kShareBeforeEstimate = 0.05;

double shareOf(std::uint64_t done, std::uint64_t total) {
  return total == 0 ? 0.0 : std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
}

}  // namespace

const std::vector<std::string>& progressNames() {
  static const std::vector<std::string> names = {"auto", "bar", "plain", "none"};
  return names;
}

ProgressMode progressModeOf(const std::string& name, bool isTerminal) {
  if (name == "none") return ProgressMode::none;
  if (name == "plain") return ProgressMode::plain;
  if (isTerminal) return ProgressMode::bar;
  return name == "bar" ? ProgressMode::plain : ProgressMode::none;
}

ProgressMode progressModeOfStderr(const std::string& name) {
  return progressModeOf(name, ::isatty(STDERR_FILENO) == 1);
}

void writeToStderr(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

Progress::Progress(std::string task, ProgressMode mode, Sink sink)
    : task_(std::move(task)), mode_(mode), sink_(std::move(sink)) {}

void Progress::update(std::uint64_t done, std::uint64_t total) {
  if (mode_ == ProgressMode::bar) updateBar(done, total);
  if (mode_ == ProgressMode::plain) updatePlain(done, total);
}

void Progress::updateBar(std::uint64_t done, std::uint64_t total) {
  const double nowMs = sinceStart_.elapsedMs();
  if (nowMs - lastDrawnMs_ < kRedrawMs) return;
  lastDrawnMs_ = nowMs;
  const double share = shareOf(done, total);
  const auto cells = static_cast<std::size_t>(share * static_cast<double>(kBarCells));
  std::string line =
      fmt::format("\r\033[K{} [{:-<{}}] {:3.0f} %", task_, std::string(cells, '#'), kBarCells, share * 100);
  if (share >= kShareBeforeEstimate) line += fmt::format("  {:.0f} s left", nowMs / 1000 * (1 - share) / share);
  sink_(line);
  drawn_ = true;
}

void Progress::updatePlain(std::uint64_t done, std::uint64_t total) {
  const auto tenth = static_cast<std::uint64_t>(shareOf(done, total) * 10);
  if (tenth <= lastTenth_) return;
  lastTenth_ = tenth;
  sink_(fmt::format("crosslight: {} {} % after {:.1f} s\n", task_, tenth * 10, sinceStart_.elapsedMs() / 1000));
}

void Progress::clear() {
  if (drawn_) sink_("\r\033[K");
  drawn_ = false;
}

}  // namespace crosslight

#include "base/log.h"

#include <cstdio>
#include <mutex>
#include <unordered_set>

#include "base/text.h"

namespace crosslight {
namespace {

struct State {
  std::mutex mutex;
  LogLevel level = LogLevel::normal;
  std::unordered_set<std::string> seen;
  std::vector<std::string> warnings;
};

State& state() {
  static State value;
  return value;
}

void print(std::string_view prefix, std::string_view message) {
  const std::string shown = printable(message);
  std::fprintf(stderr, "crosslight: %.*s%s\n", static_cast<int>(prefix.size()), prefix.data(), shown.c_str());
}

}  // namespace

void setLogLevel(LogLevel level) {
  std::scoped_lock lock(state().mutex);
  state().level = level;
}

LogLevel logLevel() {
  std::scoped_lock lock(state().mutex);
  return state().level;
}

void logInfo(std::string_view message) {
  if (logLevel() != LogLevel::quiet) print("", message);
}

void logVerbose(std::string_view message) {
  if (logLevel() == LogLevel::verbose) print("", message);
}

void logWarning(std::string_view message) {
  State& s = state();
  std::scoped_lock lock(s.mutex);
  if (!s.seen.emplace(message).second) return;
  s.warnings.emplace_back(message);
  if (s.level != LogLevel::quiet) print("warning: ", message);
}

void logError(std::string_view message) { print("error: ", message); }

std::vector<std::string> loggedWarnings() {
  std::scoped_lock lock(state().mutex);
  return state().warnings;
}

}  // namespace crosslight

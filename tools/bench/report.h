// What the benchmarks found: ratios with their intervals, absolute medians, checks on the way, and what was left out;
// as a table for people and as a record.
#pragma once

#include <string>
#include <vector>

#include "app/record.h"
#include "bench/rounds.h"

namespace crosslight::bench {

// What a ratio compares: times (ours over theirs, less is better) or rates of the same work (more is better).
enum class Quantity { time, rate };

class Report {
 public:
  // Two series of the same rounds, ours and a peer's. The times of both are added as absolute figures, once each. Left
  // out where one of them took no time that the clock could tell.
  void compare(const std::string& ours, const std::string& against, const Rounds& rounds, Quantity quantity);
  // Median of one series, in milliseconds.
  void addTime(const std::string& name, const Rounds& rounds);
  // Median of count / time, in millions per second.
  void addRate(const std::string& name, const Rounds& rounds, double count);
  // What was verified about the measured work; a failed one fails the program.
  void addCheck(const std::string& name, bool passed, Json figures);
  // A comparison that cannot be made here. Said at once on stderr.
  void omit(const std::string& name, const std::string& reason);

  bool passed() const { return passed_; }
  void writeTo(Json& record) const;  // ratios, medians, checks, omitted
  std::string table() const;

 private:
  void addMedian(const std::string& name, const char* unit, const std::vector<double>& samples);

  Json ratios_ = Json::array(), medians_ = Json::array(), checks_ = Json::array(), omitted_ = Json::array();
  bool passed_ = true;
};

}  // namespace crosslight::bench

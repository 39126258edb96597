#include "bench/report.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/log.h"
#include "measure/statistics.h"

namespace crosslight::bench {
namespace {

constexpr std::size_t kEnoughRounds = 9;  // below, an interval of a median is too wide to be called a result

bool holds(const Json& list, const std::string& name) {
  return std::any_of(list.begin(), list.end(), [&](const Json& item) { return item["name"] == name; });
}

std::string intervalOf(const Json& item) {
  return fmt::format("[{:.3f}, {:.3f}]", item["ci95"][0].get<double>(), item["ci95"][1].get<double>());
}

std::string remarkOn(const Json& ratio) {
  const double low = ratio["ci95"][0], high = ratio["ci95"][1];
  std::string remark = ratio["better"] == "less" ? "time, less is better" : "rate, more is better";
  if (ratio["rounds"].get<std::size_t>() < kEnoughRounds) return remark + "; too few rounds for a result";
  if (!(low > 1.0 || high < 1.0)) remark += "; no difference shown";
  return remark;
}

std::string loadOf(const Json& ratio) {
  return ratio["otherCpuSeconds"].is_null() ? "?" : fmt::format("{:.2f}", ratio["otherCpuSeconds"].get<double>());
}

// CPU time comes in the system's ticks, a peer's own time in its last digit: what is small may take none.
bool tookNone(const std::vector<double>& times) { return std::find(times.begin(), times.end(), 0.0) != times.end(); }

}  // namespace

void Report::compare(const std::string& ours, const std::string& against, const Rounds& rounds, Quantity quantity) {
  if (tookNone(rounds.of(ours)) || tookNone(rounds.of(against))) {
    return omit(against, "it, or ours, was done before the clock had moved");
  }
  addTime(ours, rounds);
  addTime(against, rounds);
  const bool isTime = quantity == Quantity::time;
  // The work is the same: the ratio of rates is the inverse ratio of times.
  const Estimate ratio =
      isTime ? ratioEstimate(rounds.of(ours), rounds.of(against)) : ratioEstimate(rounds.of(against), rounds.of(ours));
  ratios_.push_back({{"name", ours},
                     {"against", against},
                     {"quantity", isTime ? "time" : "rate"},
                     {"better", isTime ? "less" : "more"},
                     {"median", ratio.value},
                     {"ci95", {ratio.low, ratio.high}},
                     {"rounds", rounds.count},
                     {"repeatedRounds", rounds.repeated},
                     {"otherCpuSeconds", rounds.otherCpuSeconds ? Json(*rounds.otherCpuSeconds) : Json(nullptr)}});
}

void Report::addTime(const std::string& name, const Rounds& rounds) {
  if (!holds(medians_, name)) addMedian(name, "ms", rounds.of(name));
}

void Report::addRate(const std::string& name, const Rounds& rounds, double count) {
  std::vector<double> rates;
  for (const double ms : rounds.of(name)) rates.push_back(count / ms * 1e-3);
  addMedian(name + ".rate", "million/s", rates);
}

void Report::addMedian(const std::string& name, const char* unit, const std::vector<double>& samples) {
  const Estimate estimate = medianEstimate(samples);
  medians_.push_back({{"name", name},
                      {"unit", unit},
                      {"median", estimate.value},
                      {"ci95", {estimate.low, estimate.high}},
                      {"min", *std::min_element(samples.begin(), samples.end())},
                      {"max", *std::max_element(samples.begin(), samples.end())},
                      {"rounds", samples.size()}});
}

void Report::addCheck(const std::string& name, bool passed, Json figures) {
  Json check{{"name", name}, {"passed", passed}};
  check.update(figures);
  checks_.push_back(std::move(check));
  passed_ = passed_ && passed;
  if (!passed) logError(fmt::format("check {} failed: {}", name, figures.dump()));
}

void Report::omit(const std::string& name, const std::string& reason) {
  omitted_.push_back({{"name", name}, {"reason", reason}});
  logWarning(fmt::format("left out: {} ({})", name, reason));
}

void Report::writeTo(Json& record) const {
  record["ratios"] = ratios_;
  record["medians"] = medians_;
  record["checks"] = checks_;
  record["omitted"] = omitted_;
}

std::string Report::table() const {
  std::string text =
      fmt::format("{:<34} {:<30} {:>8} {:>18} {:>9}\n", "ratio", "against", "median", "95 %", "others s");
  for (const Json& r : ratios_) {
    text +=
        fmt::format("{:<34} {:<30} {:>8.3f} {:>18} {:>9}  {}\n", r["name"].get<std::string>(),
                    r["against"].get<std::string>(), r["median"].get<double>(), intervalOf(r), loadOf(r), remarkOn(r));
  }
  text += fmt::format("\n{:<48} {:>10} {:>22} {:>10}\n", "absolute", "median", "95 %", "min");
  for (const Json& m : medians_) {
    text += fmt::format("{:<48} {:>10.3f} {:>22} {:>10.3f} {}\n", m["name"].get<std::string>(),
                        m["median"].get<double>(), intervalOf(m), m["min"].get<double>(), m["unit"].get<std::string>());
  }
  if (!checks_.empty()) text += "\n";
  for (const Json& check : checks_) text += "check " + check.dump() + "\n";
  for (const Json& o : omitted_)
    text += fmt::format("left out: {} ({})\n", o["name"].get<std::string>(), o["reason"].get<std::string>());
  return text;
}

}  // namespace crosslight::bench

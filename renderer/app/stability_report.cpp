#include "app/stability_report.h"

#include <fmt/format.h>

#include <cmath>

namespace crosslight {
namespace {

using study::JudgedCase;
using study::Measurement;
using study::Uncovered;

// JSON has no infinities.
Json numberJson(double value) {
  if (std::isnan(value)) return "NaN";
  return std::isfinite(value) ? Json(value) : Json(value > 0 ? "infinity" : "-infinity");
}

Json measurementJson(const JudgedCase& c, const Measurement& m) {
  Json json = {{"id", c.hardCase->id}, {"name", c.hardCase->name}, {"technique", m.technique}, {"what", m.what}};
  json["got"] = numberJson(m.got);
  json["expected"] = numberJson(m.expected);
  json["error"] = numberJson(m.error);
  json["bound"] = numberJson(m.bound);
  json["unit"] = m.unit;
  json["naiveError"] = m.naive ? numberJson(*m.naive) : Json(nullptr);
  json["compared"] = m.compared;
  json["source"] = c.hardCase->source;
  json["verdict"] = study::nameOf(c.of(m));
  if (c.of(m) == study::Verdict::expectedFail) json["reason"] = c.hardCase->expectedFailure;
  return json;
}

std::string measurementLine(const JudgedCase& c, const Measurement& m) {
  const std::string naive = m.naive ? fmt::format(", textbook's {:.3g}", std::abs(*m.naive)) : "";
  if (m.unit == "count")
    return fmt::format("    {:<8}{}: {:.0f} of {}{}  {}\n", m.technique, m.what, m.error, m.compared, naive,
                       study::nameOf(c.of(m)));
  return fmt::format("    {:<8}{}:\n            got {:.9g}, expected {:.9g}, error {:.3g} {}, bound {:.3g}{}  {}\n",
                     m.technique, m.what, m.got, m.expected, m.error, m.unit, m.bound, naive, study::nameOf(c.of(m)));
}

}  // namespace

std::string platformTable(const study::Platform& platform) {
  std::string table;
  for (const study::PlatformFact& f : platform.facts) table += fmt::format("  {:<76}{}\n", f.question, f.answer);
  table += fmt::format("\n  {:<16}{:<36}{:>12}{:>12}{:>10}\n", "function", "Vulkan demands", "worst ulp", "absolute",
                       "share");
  for (const study::FunctionPrecision& f : platform.functions)
    table += fmt::format("  {:<16}{:<36}{:>12.3g}{:>12.2g}{:>10.2g}{}\n", f.name, f.guarantee, f.worstUlp,
                         f.worstAbsolute, f.worstShare, f.holds() ? "" : "  more than permitted");
  return table;
}

Json platformJson(const study::Platform& platform) {
  Json json = {{"facts", Json::object()}, {"functions", Json::array()}};
  for (const study::PlatformFact& f : platform.facts) json["facts"][f.name] = f.answer;
  for (const study::FunctionPrecision& f : platform.functions) {
    json["functions"].push_back({{"name", f.name},
                                 {"guarantee", f.guarantee},
                                 {"worstUlp", numberJson(f.worstUlp)},
                                 {"worstAbsolute", numberJson(f.worstAbsolute)},
                                 {"worstShare", numberJson(f.worstShare)},
                                 {"at", {f.x, f.y}},
                                 {"samples", f.samples},
                                 {"holds", f.holds()}});
  }
  return json;
}

std::string casesTable(const std::vector<JudgedCase>& cases) {
  std::string table;
  std::size_t counts[3] = {0, 0, 0};
  for (const JudgedCase& c : cases) {
    const study::HardCase& h = *c.hardCase;
    ++counts[static_cast<std::size_t>(c.verdict())];
    table += fmt::format("{:<5}{}: {}\n    {}.\n", h.id, h.name, study::nameOf(c.verdict()), h.hard);
    for (const Measurement& m : c.result.measurements()) table += measurementLine(c, m);
    table += fmt::format("    bound: {}\n", h.source);
    if (c.verdict() == study::Verdict::expectedFail) table += fmt::format("    known: {}\n", h.expectedFailure);
  }
  return table + fmt::format("\n{} cases: {} pass, {} fail, {} fail as expected\n", cases.size(), counts[0], counts[1],
                             counts[2]);
}

std::string uncoveredTable(const std::vector<const Uncovered*>& uncovered) {
  std::string table;
  for (const Uncovered* u : uncovered)
    table += fmt::format(
        "{:<5}{}: {}\n", u->id, u->name,
        u->notApplicable != nullptr ? fmt::format("not applicable, {}", u->notApplicable) : "not covered yet");
  return table;
}

Json casesJson(const std::vector<JudgedCase>& cases, const std::vector<const Uncovered*>& uncovered) {
  Json json = Json::array();
  for (const JudgedCase& c : cases) {
    for (const Measurement& m : c.result.measurements()) json.push_back(measurementJson(c, m));
  }
  for (const Uncovered* u : uncovered) {
    if (u->notApplicable == nullptr) continue;
    json.push_back({{"id", u->id}, {"name", u->name}, {"verdict", "not-applicable"}, {"reason", u->notApplicable}});
  }
  return json;
}

Json notCoveredJson(const std::vector<const Uncovered*>& uncovered) {
  Json json = Json::array();
  for (const Uncovered* u : uncovered) {
    if (u->notApplicable == nullptr) json.push_back({{"id", u->id}, {"name", u->name}});
  }
  return json;
}

}  // namespace crosslight

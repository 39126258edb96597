// An explanation as a table for people, 120 columns wide, and as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/explain.h"

namespace crosslight {
namespace {

constexpr std::size_t kWidth = 120;

// Words of a text in lines of at most `width`.
std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> lines{""};
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > width) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
    begin = end + 1;
  }
  return lines;
}

void addRow(std::string& table, const std::string& head, const std::string& text) {
  const std::size_t indent = head.size();
  std::string lead = head;
  for (const std::string& line : wrapped(text, kWidth - indent)) {
    table += lead + line + "\n";
    lead.assign(indent, ' ');
  }
}

// "1.32x [1.28, 1.35]"
std::string ratioText(const Estimate& e) { return fmt::format("{:.2f}x [{:.2f}, {:.2f}]", e.value, e.low, e.high); }

std::string errorText(const Measured& m) {
  if (m.maxError == 0.0) return "no bit";
  return std::isnan(m.maxError) ? "not finite" : fmt::format("{:.2g} / {:.2g}", m.maxError, m.rmsError);
}

std::string effectHead(const ExplainedEffect& e, bool measured) {
  if (!measured) return fmt::format("  {:<26}", e.verdict.name);
  return fmt::format("  {:<26}{:<22} {:<18} ", e.verdict.name, e.measured ? ratioText(e.measured->ratio) : "-",
                     e.measured ? errorText(*e.measured) : "-");
}

void addEffects(std::string& table, const Explanation& e, bool on, bool measured) {
  for (const ExplainedEffect& effect : e.effects) {
    if (effect.verdict.on == on) addRow(table, effectHead(effect, measured), effect.verdict.reason);
  }
}

struct Sum {
  std::uint64_t bytes = 0, wholeBytes = 0;
  double wallMs = 0;
};

Sum sumOf(const PlanCost& cost) {
  Sum sum;
  for (const gpu::PipelineMaking& p : cost.pipelines) {
    sum.bytes += p.bytes;
    sum.wholeBytes += p.wholeBytes;
    sum.wallMs += p.wallMs;
  }
  return sum;
}

template <class Map>
std::string countsText(const Map& counts) {
  std::string text;
  for (const auto& [name, count] : counts) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, count);
  }
  return text.empty() ? "none" : text;
}

void addPlan(std::string& table, const char* name, const PlanCost& cost) {
  const Sum sum = sumOf(cost);
  table += fmt::format("  {:<14}{:>9.2f} ms {:>12.1f} ms {:>10} {:>10.1f} KiB {:>12.1f} ms\n", name, cost.medianMs,
                       cost.firstFrameMs, cost.pipelines.size(), static_cast<double>(sum.bytes) / 1024.0, sum.wallMs);
}

void addPlans(std::string& table, const Explanation& e) {
  table += fmt::format("\n  {:<14}{:>12} {:>15} {:>10} {:>14} {:>15}\n", "plan", "frame", "first frame", "pipelines",
                       "SPIR-V", "making them");
  addPlan(table, "this scene's", *e.specialized);
  addPlan(table, "everything", *e.full);
  table +=
      fmt::format("  A frame of the full pipeline takes {} of the specialized one's time.\n", ratioText(e.fullRatio));
  for (const auto& [title, cost] : {std::pair("this scene's", &*e.specialized), std::pair("everything", &*e.full)}) {
    std::string passes;
    for (const auto& [pass, gpuMs] : cost->passes)
      passes += fmt::format("{}{} {:.2f} ms", passes.empty() ? "" : ", ", pass, gpuMs);
    addRow(table, fmt::format("  passes, {:<14}", title), passes.empty() ? "not timed by this device" : passes);
    addRow(table, fmt::format("  rays,   {:<14}", title), countsText(cost->rays));
  }
}

Json ratioJson(const Estimate& e) { return {{"ratio", e.value}, {"ci95", {e.low, e.high}}}; }

Json planJson(const PlanCost& cost) {
  Json json = {{"frameMs", cost.medianMs}, {"firstFrameMs", cost.firstFrameMs}, {"pipelines", Json::array()}};
  for (const gpu::PipelineMaking& p : cost.pipelines)
    json["pipelines"].push_back(
        {{"shaders", p.name}, {"bytes", p.bytes}, {"wholeBytes", p.wholeBytes}, {"wallMs", p.wallMs}});
  json["passes"] = Json::array();
  for (const auto& [pass, gpuMs] : cost.passes) json["passes"].push_back({{"pass", pass}, {"gpuMs", gpuMs}});
  json["rays"] = cost.rays;
  json["counters"] = cost.counters;
  return json;
}

}  // namespace

std::string explanationTable(const Explanation& e, const ExplainOptions& options) {
  const bool measured = e.specialized.has_value();
  std::string table;
  if (measured) {
    table += fmt::format("  {:<26}{:<22} {:<18} {}\n", "called for", "costs (95 %)", "changes, max / RMS", "because");
  } else {
    table += fmt::format("  {:<26}{}\n", "called for", "because");
  }
  addEffects(table, e, true, measured);
  table += fmt::format("\n  {:<26}{}\n", "left out", "because");
  addEffects(table, e, false, measured && options.measureOff);
  table += "\n";
  for (const EffectRecord& light : e.lightShadows)
    addRow(table, fmt::format("  {:<26}", light.on ? "shadows" : "no shadows"), light.reason);
  addRow(table, fmt::format("  {:<26}", fmt::format("ray depth {}", e.rayDepth)), e.depthReason);
  std::string constants;
  for (const auto& [name, bits] : e.constants)
    constants += fmt::format("{}{} 0x{:x}", constants.empty() ? "" : ", ", name, bits);
  addRow(table, fmt::format("  {:<26}", "constants"), constants);
  if (measured) addPlans(table, e);
  return table;
}

Json explanationJson(const Explanation& e) {
  Json json = {{"effects", Json::array()}, {"lightShadows", Json::array()}};
  for (const ExplainedEffect& effect : e.effects) {
    const EffectRecord& v = effect.verdict;
    Json row = {{"name", v.name}, {"on", v.on}, {"reason", v.reason}, {"leftOut", v.leftOut}};
    row["cost"] = effect.measured ? ratioJson(effect.measured->ratio) : Json(nullptr);
    row["error"] = effect.measured     ? Json{{"max", effect.measured->maxError}, {"rms", effect.measured->rmsError}}
                   : v.on || v.leftOut ? Json(nullptr)
                                       : Json{{"max", 0.0}, {"rms", 0.0}};
    json["effects"].push_back(std::move(row));
  }
  for (const EffectRecord& l : e.lightShadows)
    json["lightShadows"].push_back({{"light", l.name}, {"on", l.on}, {"reason", l.reason}});
  json["rayDepth"] = {{"most", e.rayDepth}, {"reason", e.depthReason}};
  for (const auto& [name, bits] : e.constants) json["constants"][name] = bits;
  json["specialized"] = e.specialized ? planJson(*e.specialized) : Json(nullptr);
  json["full"] = e.full ? planJson(*e.full) : Json(nullptr);
  if (e.full) json["fullBySpecialized"] = ratioJson(e.fullRatio);
  return json;
}

}  // namespace crosslight

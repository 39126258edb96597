#include "app/render_record.h"

#include <fmt/format.h>

#include "app/effects_option.h"
#include "app/scene_summary.h"
#include "app/suggest.h"
#include "app/version.h"
#include "effects/effects.h"

namespace crosslight {
namespace {

Json treeJson(const TreeRecord& tree) {
  return {{"kind", tree.kind},    {"reason", tree.reason}, {"instances", tree.instances},
          {"trees", tree.trees},  {"bytes", tree.bytes},   {"bytesSaved", tree.bytesSaved},
          {"built", tree.built},  {"moved", tree.moved},   {"unchanged", tree.unchanged},
          {"loaded", tree.loaded}};
}

Json settingsJson(const RenderSettings& s, const RenderOptions& o) {
  return {{"width", s.width},
          {"height", s.height},
          {"camera", s.camera},
          {"timeSeconds", o.timeGiven ? Json(o.timeSeconds) : Json(nullptr)},
          {"animation", o.animation},
          {"turnDegrees", o.turnDegrees},
          {"spp", s.spp},
          {"filter", o.filter},
          {"sampler", o.sampler},
          {"adaptive", o.adaptive},
          {"msaa", s.msaa},
          {"maxDepth", s.maxDepth},
          {"lighting", o.lighting},
          {"set", o.set},
          {"environment", o.environment},
          {"effects", o.effects},
          {"exposureStops", o.exposureStops},
          {"toneMap", o.toneMap}};
}

}  // namespace

Json renderRecord(const RecordHead& head, const Scene& scene, const RenderSettings& settings,
                  const RenderOptions& options, const RenderResult& result) {
  const RenderReport& report = result.report;
  Json record = newRecord(head);
  record["scene"] = {{"file", scene.source.string()},
                     {"name", scene.name},
                     {"fileBytes", scene.stats.fileBytes},
                     {"hostBytes", hostBytesOf(scene)},
                     {"triangles", scene.stats.triangles}};
  record["output"] = options.output;
  record["method"] = nameOf(settings.method);
  record["settings"] = settingsJson(settings, options);
  record["layers"] = Json::array();
  for (const Layer& layer : result.image.layers)
    record["layers"].push_back(layer.name.empty() ? "picture" : layer.name);
  record["plan"] = {{"all", settings.allEffects}, {"forced", Json::array()}, {"effects", Json::array()}};
  for (const ForcedEffect& forced : settings.forcedEffects) record["plan"]["forced"].push_back(wordOf(forced));
  for (const EffectRecord& effect : report.effects) {
    record["plan"]["effects"].push_back(
        {{"name", effect.name}, {"on", effect.on}, {"reason", effect.reason}, {"leftOut", effect.leftOut}});
  }
  record["plan"]["lightShadows"] = Json::array();
  for (const EffectRecord& light : report.lightShadows)
    record["plan"]["lightShadows"].push_back({{"light", light.name}, {"on", light.on}, {"reason", light.reason}});
  record["plan"]["within"] = settings.effectsWithin;
  record["plan"]["bound"] = makePlan(scene, settings).bound;
  record["plan"]["rayDepth"] = {{"most", report.rayDepth}, {"reason", report.depthReason}};
  record["gpu"] = Json::array();
  for (const auto& [pass, gpuMs] : report.gpuMs) record["gpu"].push_back({{"pass", pass}, {"gpuMs", gpuMs}});
  record["rays"] = report.rays;
  record["counters"] = report.counters;
  if (!report.tree.kind.empty()) record["tree"] = treeJson(report.tree);
  record["nonfinite"] = report.nonfinite;
  record["deviceBytes"] = report.deviceBytes;
  record["neededBytes"] = report.neededBytes;
  record["reused"] = report.reused;
  record["promise"] = report.promise;
  record["pixelFilter"] = report.pixelFilter;
  return record;
}

void describeInMetadata(RenderResult& result, const RenderSettings& settings, const gpu::DeviceInfo& device) {
  auto& metadata = result.image.metadata;
  metadata["Software"] = fmt::format("crosslight {} ({})", versionText(), commitText());
  metadata["method"] = nameOf(settings.method);
  metadata["spp"] = std::to_string(settings.spp);
  metadata["seed"] = std::to_string(settings.seed);
  metadata["pixelFilter"] = result.report.pixelFilter;
  metadata["promise"] = result.report.promise;
  metadata["device"] = device.name;
  metadata["driver"] = driverOf(device);
}

bool runsBeside(const std::string& phase) { return phase == "instance" || phase == "device" || phase == "write"; }

void setTimings(Json& record, const Times& timesMs) {
  Json& timings = record["timings"] = Json::object();
  Json& beside = record["overlapped"] = Json::array();
  for (const auto& [phase, wallMs] : timesMs) {
    timings[phase + "Ms"] = wallMs;
    if (runsBeside(phase)) beside.push_back(phase);
  }
}

std::string timesText(const Times& timesMs) {
  std::string parts, total;
  for (const auto& [phase, wallMs] : timesMs) {
    if (phase == "total") {
      total = fmt::format("{:.0f} ms", wallMs);
    } else {
      const std::string text = fmt::format("{} {:.1f}", phase, wallMs);
      parts += (parts.empty() ? "" : ", ") + (runsBeside(phase) ? "[" + text + "]" : text);
    }
  }
  return total + " (" + parts + ")";
}

}  // namespace crosslight

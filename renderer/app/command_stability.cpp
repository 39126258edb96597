// `crosslight stability`: the numerically hard cases on this device, and what the device's arithmetic is like.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <set>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/lazy_device.h"
#include "app/output.h"
#include "app/progress.h"
#include "app/stability_report.h"
#include "app/study_draw.h"
#include "base/file.h"
#include "base/log.h"
#include "base/time.h"
#include "study/stability_page.h"

namespace crosslight {
namespace {

struct Options {
  DeviceChoice device;
  std::string pattern;
  std::string json;
  std::string report;
  std::string progress = "auto";
  bool full = false;
  bool probeOnly = false;
};

std::filesystem::path pageIn(const std::string& folder) { return std::filesystem::path(folder) / "stability.html"; }

void checkPlaces(const Options& o) {
  checkRecordPlace(o.json);
  if (o.report.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(o.report, error);
  if (error) throw InputError(o.report, "cannot be made: " + error.message());
  checkOutputPlace(pageIn(o.report));
}

std::vector<const study::HardCase*> wantedCases(const Options& o) {
  if (o.probeOnly) return {};
  std::vector<const study::HardCase*> cases = study::casesFor(o.pattern, o.full);
  if (!cases.empty() || !study::uncoveredFor(o.pattern).empty()) return cases;
  std::string ids;
  std::set<std::string> named;  // a case may have several rows
  for (const study::HardCase& c : study::hardCases()) {
    if (named.insert(c.id).second) ids += std::string(ids.empty() ? "" : ", ") + c.id;
  }
  throw UsageError("--case " + o.pattern + ": no case has such an id or name; there are " + ids);
}

std::vector<study::JudgedCase> runAll(const Options& o, const std::vector<const study::HardCase*>& cases,
                                      LazyDevice& device) {
  const bool quiet = logLevel() == LogLevel::quiet;
  Progress progress("running cases", quiet ? ProgressMode::none : progressModeOfStderr(o.progress), writeToStderr);
  const study::Bench bench{device.get(), drawBy(device.session()), o.full};
  return study::runCases(bench, cases, [&](std::uint64_t done, std::uint64_t total) { progress.update(done, total); });
}

bool anyFailed(const std::vector<study::JudgedCase>& cases) {
  for (const study::JudgedCase& c : cases) {
    if (c.verdict() == study::Verdict::fail) return true;
  }
  return false;
}

Json recordOf(const Options& o, const CommonOptions& common, LazyDevice& device, const Times& timesMs,
              const study::Platform& platform, const std::vector<study::JudgedCase>& cases,
              const std::vector<const study::Uncovered*>& uncovered) {
  Json record = newRecord({"stability", common.arguments, {}, &device.get().info(), timesMs});
  record["probe"] = platformJson(platform);
  if (o.probeOnly) return record;
  record["cases"] = casesJson(cases, uncovered);
  record["notCovered"] = notCoveredJson(uncovered);
  return record;
}

void run(const Options& o, const CommonOptions& common) {
  checkPlaces(o);
  const std::vector<const study::HardCase*> wanted = wantedCases(o);
  const auto uncovered = o.probeOnly ? std::vector<const study::Uncovered*>{} : study::uncoveredFor(o.pattern);
  LazyDevice device(o.device);
  Stopwatch watch;
  const study::Platform platform = study::probePlatform(device.get());
  Times timesMs{{"probe", watch.lapMs()}};
  const std::vector<study::JudgedCase> cases = runAll(o, wanted, device);
  timesMs.emplace_back("cases", watch.lapMs());
  const std::string name = device.get().info().name + ", " + driverOf(device.get().info());
  if (o.json != "-") {
    printToStdout(fmt::format("{}\n\n", name) + (o.probeOnly ? platformTable(platform) : casesTable(cases)));
    if (!uncovered.empty()) printToStdout("\n" + uncoveredTable(uncovered));
  }
  if (!o.report.empty()) writeFileAtomically(pageIn(o.report), study::stabilityPage(name, platform, cases, uncovered));
  if (!o.json.empty()) writeRecord(o.json, recordOf(o, common, device, timesMs, platform, cases, uncovered));
  if (anyFailed(cases))
    throw Error(ExitCode::checkFailed, "some hard cases do not keep their bounds; they are listed as fail");
}

}  // namespace

void addStabilityCommand(CommandLine& line) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  CLI::App& command = line.add(
      "stability", "Run the numerically hard cases on this device", "[option...]",
      "Each case makes a scene or arguments at which formulas of textbooks lose their digits, runs them through "
      "raster, "
      "rays or single functions of the shaders, and compares with a closed form or an evaluation in extended "
      "precision: what is hard, got, expected, error, bound and where the bound comes from. Ends with 1 if any fails; "
      "what is known to be beyond the platform fails as expected, with the reason.");
  line.text(command, "--case", o.pattern, "PATTERN", "Only cases whose id or name fits, as in 'T*' or 'R12'")
      ->group("Cases");
  line.flag(command, "--full", o.full, "All cases, and more samples of each")->group("Cases");
  line.flag(command, "--probe", o.probeOnly,
            "No cases: what the device's arithmetic is like where standards leave it the choice, and how precise its "
            "functions are")
      ->group("Cases");
  line.text(command, "-o,--output", o.report, "FOLDER", "Write stability.html into this folder: figures and pictures",
            ValueKind::file)
      ->group("Output");
  line.text(command, "--json", o.json, "FILE|-", "Write a JSON record; '-' is standard output", ValueKind::file)
      ->group("Output");
  line.choice(command, "--progress", o.progress, progressNames(), "How progress is shown on stderr")->group("Output");
  addDeviceOptions(line, command, o.device);
  line.onRun(command, [&line, options] { run(*options, line.common()); });
}

}  // namespace crosslight

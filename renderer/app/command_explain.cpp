// `crosslight explain`: what a scene calls for, why, what each effect costs here and what it changes.
#include <fmt/format.h>

#include <cstdlib>
#include <memory>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/explain.h"
#include "app/lazy_device.h"
#include "app/output.h"
#include "app/progress.h"
#include "app/render_options.h"
#include "app/scene_store.h"
#include "base/log.h"

namespace crosslight {
namespace {

constexpr std::uint32_t kMostRounds = 1000;

struct Options {
  RenderOptions picture;
  ExplainOptions explain;
};

void run(const Options& o, const CommonOptions& common) {
  checkRecordPlace(o.picture.json);
  const RenderSettings asked = checkedSettings(o.picture);
  // Code that is found on the disk would hide what compiling costs.
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
  DeviceChoice choice = o.picture.device;
  choice.usesPipelineCache = false;
  std::optional<LazyDevice> device;
  if (!o.explain.quick) device.emplace(choice);
  const std::shared_ptr<const Scene> scene = loadPosed(o.picture);
  RenderRequest request{scene, asked};
  request.settings.camera = cameraOf(*scene, o.picture);
  const bool quiet = logLevel() == LogLevel::quiet;
  Progress progress("measuring " + o.picture.method,
                    quiet ? ProgressMode::none : progressModeOfStderr(o.picture.progress), writeToStderr);
  const Explanation explanation =
      explain(device ? &device->get() : nullptr, request, o.explain,
              [&progress](std::uint64_t done, std::uint64_t total) { progress.update(done, total); });
  if (o.picture.json != "-") {
    printToStdout(fmt::format("{} by {}, {}x{}, {} spp\n\n", o.picture.scene, o.picture.method, asked.width,
                              asked.height, asked.spp));
    printToStdout(explanationTable(explanation, o.explain));
  }
  if (o.picture.json.empty()) return;
  Json record = newRecord({"explain", common.arguments, asked.seed, device ? &device->get().info() : nullptr, {}});
  record["scene"] = {{"file", scene->source.string()}, {"name", scene->name}};
  record["method"] = o.picture.method;
  record["rounds"] = o.explain.quick ? 0 : o.explain.rounds;
  record.update(explanationJson(explanation));
  writeRecord(o.picture.json, record);
}

}  // namespace

void addExplainCommand(CommandLine& line) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  CLI::App& command = line.add(
      "explain", "Say what a scene calls for, why, and what it costs", "SCENE [option...]",
      "Every effect, illumination model, light type and shape: whether the picture calls for it, with the object that "
      "does. What is called for is left out in turn and the frame drawn with and without it, one after the other: the "
      "cost is the ratio of the two times with its 95 % interval, the change is the largest and the root mean square "
      "difference of the pictures. What is left out changes no bit.");
  line.text(command, "SCENE", o.picture.scene, "SCENE", "A glTF 2.0 file, .gltf or .glb", ValueKind::file)->required();
  addPictureOptions(line, command, o.picture);
  line.whole(command, "--spp", o.picture.spp, "N", 1, 1u << 20, "Samples per pixel")->group("Sampling");
  addDepthOption(line, command, o.picture);
  line.whole(command, "--rounds", o.explain.rounds, "N", 2, kMostRounds, "Frames with and without each effect")
      ->group("Measuring");
  line.flag(command, "--quick", o.explain.quick, "Say what is called for and why, and draw nothing: needs no device")
      ->group("Measuring");
  line.flag(command, "--all", o.explain.measureOff,
            "Measure too what compiling in costs that is not called for; takes a pipeline for each")
      ->group("Measuring");
  line.text(command, "--json", o.picture.json, "FILE|-", "Write a JSON record; '-' is standard output", ValueKind::file)
      ->group("Output");
  line.choice(command, "--progress", o.picture.progress, progressNames(), "How progress is shown on stderr")
      ->group("Output");
  addDeviceOptions(line, command, o.picture.device);
  line.onRun(command, [&line, options] { run(*options, line.common()); });
}

}  // namespace crosslight

// `crosslight render`: the options of a picture, and the way from a file to a file.
#include <fmt/format.h>

#include <memory>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/device_choice.h"
#include "app/output.h"
#include "app/progress.h"
#include "app/render_options.h"
#include "app/render_record.h"
#include "app/suggest.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/time.h"
#include "image/image_io.h"
#include "scene/load.h"

namespace crosslight {
namespace {

RenderResult renderWithProgress(gpu::Device& device, const Scene& scene, const RenderOptions& options,
                                const RenderSettings& settings) {
  const bool quiet = logLevel() == LogLevel::quiet;
  Progress progress(options.method, quiet ? ProgressMode::none : progressModeOfStderr(options.progress), writeToStderr);
  return render(device, scene, settings,
                [&progress](std::uint64_t done, std::uint64_t total) { progress.update(done, total); });
}

void describe(const RenderResult& result) {
  for (const EffectRecord& effect : result.report.effects) {
    logVerbose(fmt::format("effect {} is {}: {}", effect.name, effect.on ? "on" : "off", effect.reason));
  }
  for (const auto& [pass, gpuMs] : result.report.gpuMs)
    logVerbose(fmt::format("device time of {}: {:.2f} ms", pass, gpuMs));
}

void run(const RenderOptions& options, const CommonOptions& common) {
  if (options.listDevices) {
    printToStdout(deviceTable(gpu::listDevices()));
    return openIfAsked(options.device);
  }
  Stopwatch total, lap;
  const RenderSettings checked = checkedSettings(options);  // all that can be said before the file is read
  const DisplayTransform display = checkedDisplay(options);
  checkOutputPlace(options.output);
  checkRecordPlace(options.json);

  Times timesMs;
  lap.lapMs();
  const Scene scene = loadScene(options.scene, loadOptionsOf(options));
  timesMs.emplace_back("load", lap.lapMs());
  RenderSettings settings = checked;
  if (!options.camera.empty()) settings.camera = findCamera(scene, options.camera);
  throwIfInterrupted();

  gpu::Device device = openDevice(options.device);
  timesMs.emplace_back("instance", device.openTimes().instanceMs);
  timesMs.emplace_back("device", device.openTimes().deviceMs);
  logVerbose("drawing on " + device.info().name);
  RenderResult result = renderWithProgress(device, scene, options, settings);
  timesMs.insert(timesMs.end(), result.report.timesMs.begin(), result.report.timesMs.end());
  throwIfInterrupted();

  lap.lapMs();
  describeInMetadata(result, settings, device.info());
  writeImage(options.output, result.image, display);
  timesMs.emplace_back("encode", lap.lapMs());
  timesMs.emplace_back("total", total.elapsedMs());

  describe(result);
  logInfo(fmt::format("{} ({} {}x{}, {} spp) in {}", options.output, options.method, settings.width, settings.height,
                      settings.spp, timesText(timesMs)));
  if (!options.json.empty()) {
    writeRecord(options.json, renderRecord({"render", common.arguments, settings.seed, &device.info(), timesMs}, scene,
                                           settings, options, result));
  }
}

}  // namespace

void addRenderCommand(CommandLine& line) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App& command = line.add(
      "render", "Draw a scene into an image file", "SCENE -o OUT.{png,exr,hdr,pfm} [option...]",
      "The image is linear inside. PNG is shown through exposure, tone map and the sRGB curve; EXR, HDR and PFM "
      "stay linear and know the exposure only. EXR also takes the AOVs, as layers, and what made the image, as "
      "attributes.");
  addRenderOptions(line, command, *options);
  line.onRun(command, [&line, options] { run(*options, line.common()); });
}

}  // namespace crosslight

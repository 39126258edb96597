// `crosslight render`: a picture, or many of them.
#include <memory>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/output.h"
#include "app/render_batch.h"
#include "app/render_work.h"

namespace crosslight {
namespace {

void run(const RenderOptions& options, const CommonOptions& common) {
  if (options.listDevices) {
    printToStdout(deviceTable(gpu::listDevices()));
    return openIfAsked(options.device);
  }
  if (!options.batch.empty()) return runBatch(options, common);
  const RenderWork work = checkedWork(options);
  checkPlaces(work);
  LazyDevice device(options.device);
  SceneStore scenes;
  RenderContext context{device, scenes, common};
  const Json record = runWork(work, context);
  if (!options.json.empty()) writeRecord(options.json, record);
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

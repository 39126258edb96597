// `crosslight info`: what a scene file has, as a table for people or a JSON record. Needs no device.
#include <fmt/format.h>

#include <memory>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/output.h"
#include "app/record.h"
#include "app/scene_summary.h"
#include "base/log.h"
#include "base/time.h"
#include "scene/load.h"

namespace crosslight {
namespace {

struct Options {
  std::string file;
  std::string scene;
  std::string json;
};

void run(const Options& options, const CommonOptions& common) {
  checkRecordPlace(options.json);
  Stopwatch watch;
  LoadOptions load;
  load.scene = options.scene;
  const Scene scene = loadScene(options.file, load);
  const Times timesMs = {{"load", watch.elapsedMs()}};
  if (options.json != "-") printToStdout(sceneTable(scene));
  if (options.json.empty()) return;
  Json record = newRecord({"info", common.arguments, {}, nullptr, timesMs});
  record["scene"] = sceneJson(scene);
  writeRecord(options.json, record);
}

}  // namespace

void addInfoCommand(CommandLine& line) {
  auto options = std::make_shared<Options>();
  CLI::App& command = line.add("info", "Say what a scene file has", "SCENE [option...]",
                               "Counts, bounds, cameras, lights, materials with their illumination models, extensions "
                               "and memory. Needs no device.");
  line.text(command, "SCENE", options->file, "SCENE", "A glTF 2.0 file, .gltf or .glb", ValueKind::file)->required();
  line.text(command, "--scene", options->scene, "NAME|N", "The scene of the file; without it the file's default")
      ->group("Scene");
  line.text(command, "--json", options->json, "FILE|-", "Write a JSON record; '-' is standard output", ValueKind::file)
      ->group("Output");
  line.onRun(command, [&line, options] { run(*options, line.common()); });
}

}  // namespace crosslight

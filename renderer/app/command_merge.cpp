// `crosslight merge`: the parts of one picture, drawn by `render --part`, as the picture.
#include <fmt/format.h>

#include <memory>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/output.h"
#include "app/part.h"
#include "app/record.h"
#include "app/render_record.h"
#include "base/log.h"
#include "base/time.h"

namespace crosslight {
namespace {

struct Options {
  std::vector<std::string> parts;
  std::string output;
  std::string json;
};

void run(const Options& options, const CommonOptions& common) {
  const ImageFormat format = imageFormatOf(options.output);
  checkOutputPlace(options.output);
  checkRecordPlace(options.json);
  Stopwatch total, lap;
  Times timesMs;
  const Merged merged = mergeParts(options.parts);
  timesMs.emplace_back("read", lap.lapMs());
  if (merged.image.layers.size() > 1 && format != ImageFormat::exr) {
    throw UsageError("the parts have AOVs, which need an EXR file: -o " +
                     std::filesystem::path(options.output).replace_extension(".exr").string());
  }
  writeImage(options.output, merged.image, merged.display);
  timesMs.emplace_back("encode", lap.lapMs());
  timesMs.emplace_back("total", total.elapsedMs());
  logInfo(fmt::format("{} ({} parts, {}x{}) in {}", options.output, options.parts.size(), merged.image.width,
                      merged.image.height, timesText(timesMs)));
  if (options.json.empty()) return;
  Json record = newRecord({"merge", common.arguments, {}, nullptr, timesMs});
  record["output"] = options.output;
  record["parts"] = options.parts;
  record["metadata"] = merged.image.metadata;
  writeRecord(options.json, record);
}

}  // namespace

void addMergeCommand(CommandLine& line) {
  auto options = std::make_shared<Options>();
  CLI::App& command = line.add("merge", "Join the parts of one picture", "PART... -o OUT.{png,exr,hdr,pfm} [option...]",
                               "The picture has the same bits as one that is drawn at once. Parts that are missing, "
                               "damaged, there twice or of another picture end with exit code 3.");
  line.declare(
      command.add_option("PART", options->parts, "Files that 'render --part I/N -o x.clpart' has written")->required(),
      "PART", {ValueKind::file, {}});
  line.text(command, "-o,--output", options->output, "OUT", "The image file; .png, .exr, .hdr or .pfm", ValueKind::file)
      ->required()
      ->group("Output");
  line.text(command, "--json", options->json, "FILE|-", "Write a JSON record; '-' is standard output", ValueKind::file)
      ->group("Output");
  line.onRun(command, [&line, options] { run(*options, line.common()); });
}

}  // namespace crosslight

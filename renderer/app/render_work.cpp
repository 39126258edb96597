#include "app/render_work.h"

#include <fmt/format.h>

#include "app/command_line.h"
#include "app/lighting_preset.h"
#include "app/output.h"
#include "app/picture_layers.h"
#include "app/progress.h"
#include "app/ray_tree_files.h"
#include "app/render_record.h"
#include "app/video_pipe.h"
#include "base/hash.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/time.h"

namespace crosslight {
namespace {

void describe(const RenderResult& result) {
  for (const EffectRecord& effect : result.report.effects) {
    logVerbose(fmt::format("effect {} is {}: {}", effect.name, effect.on ? "on" : "off", effect.reason));
  }
  const TreeRecord& tree = result.report.tree;
  if (!tree.kind.empty()) {
    logVerbose(fmt::format("{} tree of rays, {} trees, {} instances, {:.1f} MiB, {:.1f} MiB saved: {}", tree.kind,
                           tree.trees, tree.instances, static_cast<double>(tree.bytes) / (1u << 20),
                           static_cast<double>(tree.bytesSaved) / (1u << 20), tree.reason));
  }
  for (const auto& [pass, gpuMs] : result.report.gpuMs)
    logVerbose(fmt::format("device time of {}: {:.2f} ms", pass, gpuMs));
}

// The output is of the kind that the other options ask for.
void checkOutputKind(const RenderWork& work) {
  const RenderOptions& o = work.options;
  if (isPartFile(o.output) != work.part.has_value()) {
    throw UsageError(work.part ? "--part writes part files: -o " +
                                     std::filesystem::path(o.output).replace_extension(".clpart").string()
                               : "\"" + o.output + "\": a part file needs --part I/N, which rows it holds");
  }
  if (work.part && !work.frames.empty())
    throw UsageError("--part is of one picture; it excludes --frames and --turntable");
  if (work.frames.empty() && isVideo(o.output))
    throw UsageError("\"" + o.output + "\": a video needs --frames or --turntable");
  if (!work.frames.empty() && !isVideo(o.output)) {
    imageFormatOf(frameName(o.output, 0));
  } else if (work.frames.empty() && !work.part) {
    imageFormatOf(o.output);
  }
}

std::optional<glm::uvec2> checkedRayTree(const RenderWork& work) {
  if (work.options.rayTree.empty()) return std::nullopt;
  if (!isTraced(work.settings.method)) throw UsageError("--ray-tree is of rays: add --method whitted");
  if (!work.frames.empty() || work.part) throw UsageError("--ray-tree is of one picture; it excludes frames and parts");
  return rayTreePixelOf(work.options.rayTree, work.settings.width, work.settings.height);
}

PartHeader partHeaderOf(const RenderWork& work, const Scene& scene, const RenderSettings& settings, const Json& record,
                        const Image& image) {
  PartHeader header{settings.width, settings.height, *work.part, Json::object(), work.display};
  for (const char* key : {"version", "commit", "device", "driver", "method", "seed"}) header.same[key] = record[key];
  header.same["scene"] = {{"name", scene.name}, {"hash", hexOf(scene.stats.contentHash)}};
  header.same["settings"] = record["settings"];
  header.same["aovs"] = settings.aovs;
  header.same["metadata"] = image.metadata;
  return header;
}

// A picture, or a part of one.
Json runPicture(const RenderWork& work, RenderContext& context) {
  const RenderOptions& options = work.options;
  Stopwatch total, lap;
  Times timesMs;
  const std::shared_ptr<const Scene> scene = context.scenes.take(options);
  timesMs.emplace_back("load", lap.lapMs());
  RenderSettings settings = work.settings;
  settings.camera = cameraOf(*scene, options);
  throwIfInterrupted();

  gpu::Device& device = context.device.get();
  append(context.device.takeTimes(), timesMs);
  const std::vector<Band> rows = work.part ? rowsOfPart(*work.part, settings.height) : std::vector<Band>();
  RenderResult result = drawWithProgress(
      work, context,
      {scene, settings, rows, fileBytesPerPixel(work), false, shownBy(work), bvhCacheOf(options), work.rayTreePixel});
  append(std::move(result.report.timesMs), timesMs);
  throwIfInterrupted();

  lap.lapMs();
  describeInMetadata(result, settings, device.info());
  const RecordHead head{"render", context.common.arguments, settings.seed, &device.info(), {}};
  Json record = renderRecord(head, *scene, settings, options, result);
  if (work.part) {
    writePart(options.output, partHeaderOf(work, *scene, settings, record, result.image), result.image);
  } else {
    writeImage(options.output, result.image, work.display);
  }
  if (result.rayTree) {
    writeRayTree(options.output, *result.rayTree, *scene);
    record["rayTree"] = rayTreeFilesOf(options.output).json.string();
  }
  timesMs.emplace_back("encode", lap.lapMs());
  timesMs.emplace_back("total", total.elapsedMs());
  setTimings(record, timesMs);

  describe(result);
  const std::string share = work.part ? fmt::format(", part {}/{}", work.part->index, work.part->count) : "";
  logInfo(fmt::format("{} ({} {}x{}, {} spp{}) in {}", options.output, options.method, settings.width, settings.height,
                      settings.spp, share, timesText(timesMs)));
  return record;
}

}  // namespace

RenderWork checkedWork(const RenderOptions& options) {
  RenderWork work;
  work.options = options;
  if (!options.part.empty()) work.part = partOf(options.part);
  if (options.scene.empty()) throw UsageError("no scene given: crosslight render SCENE -o OUT.png");
  if (options.output.empty()) throw UsageError("no output given: add -o OUT.png (or .exr, .hdr, .pfm)");
  work.frames = framesOf(options);
  checkOutputKind(work);
  work.settings = checkedSettings(options);
  work.display = checkedDisplay(options);
  work.rayTreePixel = checkedRayTree(work);
  return work;
}

void checkPlaces(const RenderWork& work) {
  checkOutputPlace(work.options.output);
  checkRecordPlace(work.options.json);
  if (work.rayTreePixel) {
    const RayTreeFiles files = rayTreeFilesOf(work.options.output);
    for (const auto& file : {files.json, files.svg}) checkOutputPlace(file);
  }
  if (isVideo(work.options.output)) findVideoEncoder();
}

std::uint64_t fileBytesPerPixel(const RenderWork& work) {
  constexpr std::uint64_t kCodes = 4, kColors = 3 * sizeof(float);
  if (work.part) return 0;  // written as it lies in memory
  if (isVideo(work.options.output)) return kCodes;
  switch (imageFormatOf(work.options.output)) {
    case ImageFormat::png:
      return 2 * kCodes;  // filtered rows, packed stream
    case ImageFormat::exr:
      return layerBytesPerPixel(work.settings.aovs);  // packed, at worst as large as unpacked
    case ImageFormat::hdr:
    case ImageFormat::pfm:
      return 2 * kColors;
  }
  return 0;
}

std::optional<DisplayTransform> shownBy(const RenderWork& work) {
  const std::string& output = work.options.output;
  const bool shown = !work.part && (isVideo(output) || imageFormatOf(output) == ImageFormat::png);
  return shown ? std::optional(work.display) : std::nullopt;
}

void append(Times&& more, Times& timesMs) { timesMs.insert(timesMs.end(), more.begin(), more.end()); }

RenderResult drawWithProgress(const RenderWork& work, RenderContext& context, const RenderRequest& request) {
  if (work.options.lighting == "opengl") {
    for (const std::string& sentence : unlikeOpenGl(*request.scene, request.settings)) logWarning(sentence);
  }
  const bool quiet = logLevel() == LogLevel::quiet;
  Progress progress(context.task + work.options.method,
                    quiet ? ProgressMode::none : progressModeOfStderr(work.options.progress), writeToStderr);
  return context.device.session().render(
      request, [&progress](std::uint64_t done, std::uint64_t total) { progress.update(done, total); });
}

Json runWork(const RenderWork& work, RenderContext& context) {
  return work.frames.empty() ? runPicture(work, context) : runFrames(work, context);
}

}  // namespace crosslight

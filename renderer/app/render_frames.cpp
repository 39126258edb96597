// The frames of an animation or a turntable, into a file each or into one video. What no frame changes is kept from one
// to the next; a frame is written while the next one is drawn.
#include <fmt/format.h>

#include <future>

#include "app/command_line.h"
#include "app/picture_layers.h"
#include "app/render_record.h"
#include "app/render_work.h"
#include "app/scene_extras.h"
#include "app/video_pipe.h"
#include "base/file.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/time.h"
#include "scene/load.h"

namespace crosslight {
namespace {

LoadOptions loadOptionsOfFrames(const RenderOptions& options) {
  LoadOptions load = loadOptionsOf(options);
  load.animate = framesAnimate(options);
  return load;
}

// The scene at each frame. Read once; posed again only where time moves it.
class FrameScenes {
 public:
  explicit FrameScenes(const RenderOptions& options)
      : options_(options), file_(options.scene, loadOptionsOfFrames(options)) {}

  // `before` is called with the scene of the frame before when that one is about to change.
  std::shared_ptr<const Scene> at(const Frame& frame, const std::function<void(const Scene&)>& before) {
    const bool moves = posed_ == nullptr || (hasAnimations() && frame.timeSeconds != posedSeconds_);
    if (!moves && frame.turnDegrees == turnedDegrees_) return posed_;
    if (posed_ != nullptr) before(*posed_);
    if (moves) {
      posed_ = std::make_shared<Scene>(file_.pose(frame.timeSeconds));
      posed_->atmosphere.environment.map = map_;
      completeScene(*posed_, options_);
      map_ = posed_->atmosphere.environment.map;
      cameras_ = posed_->cameras;
      lights_ = posed_->lights;
      camera_ = cameraOf(*posed_, options_);
    } else {
      posed_->cameras = cameras_;
      posed_->lights = lights_;
    }
    posedSeconds_ = frame.timeSeconds;
    turnedDegrees_ = frame.turnDegrees;
    orbit(*posed_, camera_, frame.turnDegrees);
    return posed_;
  }
  int camera() const { return camera_; }
  bool hasAnimations() const { return posed_->stats.animations > 0 && framesAnimate(options_); }

 private:
  const RenderOptions& options_;
  SceneFile file_;
  std::shared_ptr<Scene> posed_;
  std::shared_ptr<const EnvironmentMap> map_;  // read once
  std::vector<Camera> cameras_;                // before the turn
  std::vector<Light> lights_;
  int camera_ = 0;
  double posedSeconds_ = 0, turnedDegrees_ = 0;
};

double phaseMs(const Times& timesMs, const std::string& phase) {
  for (const auto& [name, wallMs] : timesMs) {
    if (name == phase) return wallMs;
  }
  return 0;
}

using FrameSink = std::function<void(const Frame&, const Image&)>;

class FrameRun {
 public:
  FrameRun(const RenderWork& work, RenderContext& context) : work_(work), context_(context) {}

  Json run() {
    const Stopwatch total;
    Stopwatch lap;
    scenes_.emplace(work_.options);
    scenes_->at(work_.frames.front(), {});
    add("load", lap.lapMs());
    if (work_.options.turntable == 0 && !scenes_->hasAnimations()) {
      logWarning(work_.options.scene + ": has no animation, all its frames are alike");
    }
    context_.device.get();
    for (const auto& [phase, ms] : context_.device.takeTimes()) add(phase, ms);
    if (isVideo(work_.options.output)) {
      drawVideo();
    } else {
      drawAll([this](const Frame& frame, const Image& image) { writeImage(nameOf(frame), image, work_.display); });
    }
    add("total", total.elapsedMs());
    record_["output"] = work_.options.output;
    record_["frames"] = std::move(frames_);
    record_["framesPerSecond"] = work_.options.framesPerSecond;
    setTimings(record_, timesMs_);
    logInfo(fmt::format("{} ({} frames, {} {}x{}, {} spp) in {}", work_.options.output, work_.frames.size(),
                        work_.options.method, work_.settings.width, work_.settings.height, work_.settings.spp,
                        timesText(timesMs_)));
    return record_;
  }

 private:
  std::string nameOf(const Frame& frame) const { return frameName(work_.options.output, frame.number); }

  void add(const std::string& phase, double wallMs) {
    for (auto& [name, sumMs] : timesMs_) {
      if (name != phase) continue;
      sumMs += wallMs;
      return;
    }
    timesMs_.emplace_back(phase, wallMs);
  }

  void drawVideo() {
    const VideoFormat format{work_.settings.width, work_.settings.height, work_.options.framesPerSecond};
    writeFileAtomically(work_.options.output, [&](const std::filesystem::path& temporary) {
      VideoPipe pipe(format, temporary);
      drawAll([&](const Frame&, const Image& image) { pipe.write(displayPicture(image, work_.display)); });
      const Stopwatch watch;
      pipe.finish();
      add("finish", watch.elapsedMs());
    });
  }

  void drawAll(const FrameSink& sink) {
    std::future<double> writing;
    const auto finishWriting = [&] {
      if (!writing.valid()) return;
      const Stopwatch watch;
      add("write", writing.get());
      add("writeWait", watch.elapsedMs());
    };
    for (std::size_t i = 0; i < work_.frames.size(); ++i) {
      throwIfInterrupted();
      Image image = draw(i);
      finishWriting();
      writing = std::async(std::launch::async, [&sink, &work = work_, i, shown = std::move(image)] {
        const Stopwatch watch;
        sink(work.frames[i], shown);
        return watch.elapsedMs();
      });
    }
    finishWriting();
  }

  Image draw(std::size_t index) {
    const Frame& frame = work_.frames[index];
    Stopwatch watch;
    RenderSession& session = context_.device.session();
    const std::shared_ptr<const Scene> scene = scenes_->at(frame, [&](const Scene& old) { session.forget(old); });
    add("pose", watch.lapMs());
    RenderSettings settings = work_.settings;
    settings.camera = scenes_->camera();
    RenderContext context{context_.device, context_.scenes, context_.common,
                          fmt::format("{}frame {}/{} ", context_.task, index + 1, work_.frames.size())};
    // One frame is drawn while the one before is written.
    const std::uint64_t besideBytes = fileBytesPerPixel(work_) + layerBytesPerPixel(settings.aovs);
    RenderResult result = drawWithProgress(work_, context, {scene, settings, {}, besideBytes, true, shownBy(work_)});
    const gpu::DeviceInfo& device = context_.device.get().info();
    describeInMetadata(result, settings, device);
    for (const auto& [phase, ms] : result.report.timesMs) add(phase, ms);
    const double drawMs = watch.lapMs();
    record_ = renderRecord({"render", context_.common.arguments, settings.seed, &device, {}}, *scene, settings,
                           work_.options, result);
    const bool video = isVideo(work_.options.output);
    frames_.push_back({{"number", frame.number},
                       {"timeSeconds", frame.timeSeconds},
                       {"turnDegrees", frame.turnDegrees},
                       {"output", video ? Json(nullptr) : Json(nameOf(frame))},
                       {"drawMs", drawMs},
                       {"bvhMs", phaseMs(result.report.timesMs, "bvh")},
                       {"treesBuilt", result.report.tree.built},
                       {"treesMoved", result.report.tree.moved},
                       {"reused", result.report.reused}});
    logVerbose(fmt::format("frame {} drawn in {:.1f} ms", frame.number, drawMs));
    return std::move(result.image);
  }

  const RenderWork& work_;
  RenderContext& context_;
  std::optional<FrameScenes> scenes_;
  Times timesMs_;
  Json record_;  // of the last frame
  Json frames_ = Json::array();
};

}  // namespace

Json runFrames(const RenderWork& work, RenderContext& context) { return FrameRun(work, context).run(); }

}  // namespace crosslight

// The host's side of the ray tree: chunks of pixels, levels within a chunk, batches of lights within a level. All loops
// over unbounded counts are here and not in a kernel (a kernel's loops end silently after 65,535 rounds on Mesa 22.3).
#include "trace/whitted.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "effects/material_traits.h"
#include "trace/level_recorder.h"
#include "trace/ray_store.h"
#include "upload/smoke_check.h"

namespace crosslight {

using namespace shared;

namespace {

constexpr std::uint32_t kRaysPerClassifyGroup = kClassifiedPerLane * kRaysPerGroup;
constexpr std::uint64_t kWord = sizeof(std::uint32_t);

class Whitted final : public Technique {
 public:
  Whitted(const gpu::Device& device, GpuScene& scene, const Plan& plan, const RenderSettings& settings,
          FilmBuffers& buffers, std::shared_ptr<KernelPipelines> kernels, std::uint32_t cameraRays)
      : device_(device),
        scene_(scene),
        settings_(settings),
        buffers_(buffers),
        branches_(crosslight::branches(plan)),
        nestedMedia_(plan.has(Effect::nestedMedia)),
        coloredShadows_(plan.has(Effect::coloredShadows)),
        smoke_(hasSmoke(scene.scene().atmosphere.smoke)),
        bodiesScatter_(plan.has(Effect::volumeScatter) && anyScatters(scene.scene())),
        lightShadows_(plan.lightShadows),
        kernels_(std::move(kernels)),
        choice_(forTree(kernels_->choice(), scene)),
        classes_(kernels_->classes().classes),
        store_(device, storeSize(cameraRays), kernels_->classes()),
        set_(device, kernels_->layout()),
        commands_(device) {
    checkSmokeLoops(device.info(), scene.scene(), plan, settings);
    scene_.bind(set_);
    store_.bind(set_);
    set_.set(kBindCounters, buffers.counters);
    set_.set(kBindSampleColor, buffers.sampleColor);
    set_.set(kBindAovs, buffers.aovs);
    if (settings.adaptiveError > 0) set_.set(kBindTileList, *buffers.tileList);
  }

  void renderSample(const SampleRequest& request, Tally& tally) override {
    scene_.setSample(request.offset, request.index);
    rays_["primary"] += request.pixels;
    const std::uint32_t rays =
        request.tiles ? *request.tiles * kTileSize * kTileSize : cameraRayCount(request.width, request.band.rowCount);
    for (std::uint32_t first = 0; first < rays;) {
      const std::uint32_t count = std::min(store_.chunk, rays - first);
      if (traceChunk(request, first, count, tally)) first += count;
      throwIfInterrupted();
    }
  }

  // The tree of one camera ray, by its place in the tile order of the band; what is left of it is the recorder's.
  void traceOne(const SampleRequest& request, std::uint32_t place, LevelRecorder& recorder) {
    scene_.setSample(request.offset, request.index);
    recorder.bind(store_);
    recorder_ = &recorder;
    Tally unused;
    while (!traceChunk(request, place, 1, unused)) throwIfInterrupted();
    recorder_ = nullptr;
  }

  std::uint32_t nodeCapacity() const { return store_.capacity; }

  std::string promise() const override {
    return "E | L[DS_glossy]?S*E: direct light with its shadows (soft ones by samples), seen directly or through "
           "mirrors and smooth "
           "dielectrics; no light that reaches a surface by way of another";
  }

  std::map<std::string, std::uint64_t> rays() const override { return rays_; }

  std::map<std::string, std::uint64_t> counters() const override {
    return {{"rayLevels", levels_},
            {"chunksRepeated", repeated_},
            {"traversalsCapped", capped_},
            {"packetsGivenUp", gaveUp_}};
  }

 private:
  RayStoreSize storeSize(std::uint32_t cameraRays) const {
    return {.cameraRays = cameraRays,
            .lights = scene_.lightCount(),
            .tree = branches_ && settings_.maxDepth > 0,
            .branches = branches_,
            .environment = scene_.scene().atmosphere.environment.present(),
            .nestedMedia = nestedMedia_,
            .coloredShadows = coloredShadows_,
            .shadows = !choice_.shadow.empty()};
  }

  // Is something missing from what a chunk left? Then it is set up to succeed the next time.
  bool mustRepeat(const std::array<std::uint32_t, kCounterCount>& counters, std::uint32_t chunkRays) {
    if (counters[kCounterOverflow] > 0) {
      halveChunk(chunkRays);
      return true;
    }
    if (counters[kCounterGaveUp] == 0 || packetsGiveUp_) return false;
    ++repeated_;
    packetsGiveUp_ = true;
    logVerbose("some packets of rays part too soon: their rays go one by one");
    return true;
  }

  void halveChunk(std::uint32_t count) {
    ++repeated_;
    if (count == 1) {
      throw DeviceError(fmt::format("one pixel's ray tree needs more than {} nodes: lower --max-depth (now {})",
                                    store_.capacity, settings_.maxDepth));
    }
    store_.chunk = (count + 1) / 2;
    logVerbose(fmt::format("ray tree store is full: going on with chunks of {} pixels", store_.chunk));
  }

  // Where a kernel's groups come from: all rays of the level, or a queue of its hits.
  void dispatchGroups(const TracePush& push, bool queued) {
    if (queued)
      commands_.dispatchIndirect(store_.queues, push.hitClass * kQueueWords * kWord);
    else
      commands_.dispatch((push.nodeCount + kRaysPerGroup - 1) / kRaysPerGroup);
  }

  // No kernel named: no such pass.
  void dispatch(const KernelKey& key, const TracePush& push, const char* span) {
    if (key.kernel.empty()) return;
    commands_.beginSpan(span);
    commands_.bind(kernels_->get(key), set_);
    commands_.push(push);
    dispatchGroups(push, (key.variant & kVariantQueue) != 0);
    commands_.endSpan();
    commands_.barrier();
  }

  // With packets; then, one ray per lane, those that packets gave up.
  void dispatch(const KernelKey& key, const std::string& rest, const TracePush& push, const char* span) {
    if (!rest.empty()) {
      commands_.fill(store_.rest, 0, kWord, 0u);
      commands_.fill(store_.rest, kWord, 2 * kWord, 1u);
      commands_.barrier();
    }
    dispatch(key, push, span);
    if (rest.empty() || !packetsGiveUp_) return;
    commands_.beginSpan(span);
    commands_.bind(kernels_->get({rest, key.variant | kVariantRest}), set_);
    commands_.push(push);
    commands_.dispatchIndirect(store_.rest, 0);
    commands_.endSpan();
    commands_.barrier();
  }

  void submit(Tally& tally) {
    commands_.submitAndWait();
    tally.add(commands_.spans());
  }

  // False when the chunk has to be repeated: nothing counts then.
  bool traceChunk(const SampleRequest& request, std::uint32_t first, std::uint32_t count, Tally& tally) {
    std::array<std::uint32_t, kCounterCount> start{};
    buffers_.counters.read(0, std::as_writable_bytes(std::span(start)));
    std::array<std::uint32_t, kCounterCount> reset = start;
    reset[kCounterRayNodes] = count;
    reset[kCounterOverflow] = reset[kCounterShadowRays] = reset[kCounterReflection] = 0;
    reset[kCounterRefraction] = reset[kCounterPassThrough] = reset[kCounterCapped] = 0;
    reset[kCounterGaveUp] = reset[kCounterMediaLost] = 0;
    buffers_.counters.write(0, std::as_bytes(std::span(reset)));

    TracePush push{};
    push.firstRow = request.band.firstRow;
    push.bandRows = request.band.rowCount;
    push.firstInTiles = first;
    push.nodeCapacity = store_.capacity;
    push.maxDepth = settings_.maxDepth;
    push.nodeCount = count;
    std::vector<TracePush> levels;
    std::array<std::uint32_t, kCounterCount> now{};
    while (push.nodeCount > 0) {
      traceLevel(push, levels.empty(), request.aovs, tally);
      levels.push_back(push);
      buffers_.counters.read(0, std::as_writable_bytes(std::span(now)));
      if (mustRepeat(now, count)) return false;
      push.firstNode += push.nodeCount;
      push.nodeCount = now[kCounterRayNodes] - push.firstNode;
    }
    gather(levels, tally);
    count_(now, levels.size());
    return true;
  }

  void traceLevel(TracePush push, bool primary, bool aovs, Tally& tally) {
    commands_.begin();
    commands_.barrier();
    if (primary)
      dispatch({choice_.camera}, choice_.cameraRest, push, "intersect");
    else
      dispatch({choice_.secondary}, push, "intersect");
    dispatch({choice_.shapes}, push, "shapes");
    if (!classes_.empty()) queueHits(push);
    const std::uint32_t lights = scene_.lightCount();
    for (std::uint32_t first = 0; first == 0 || first < lights; first += store_.batch) {
      push.firstLight = first;
      push.lightCount = std::min(store_.batch, lights - first);
      shadeLevel(push, primary && aovs ? kVariantAovs : 0);
      if (first + store_.batch >= lights) addSmoke(push, primary);
      if (recorder_ != nullptr) recorder_->record(commands_, push);
    }
    submit(tally);
  }

  // After all else of a level: what its rays bring is weakened, then light is added. With shadows, one step of one
  // light at a time (shaders/trace/smoke.comp).
  void addSmoke(TracePush push, bool primary) {
    const bool inBodies = bodiesScatter_ && (!primary || nestedMedia_);  // only then may the camera be in one
    if (choice_.smoke.empty() || !(smoke_ || inBodies)) return;
    push.lightInBatch = ~0u;
    dispatch({choice_.smoke}, push, "smoke");
    if (choice_.shadow.empty()) return;
    for (push.lightInBatch = 0; push.lightInBatch < scene_.lightCount(); ++push.lightInBatch) {
      for (push.smokeStep = 0; push.smokeStep < settings_.smokeSteps; ++push.smokeStep) {
        for (push.shadowChannel = 0; push.shadowChannel < shadowChannels(); ++push.shadowChannel)
          dispatch({choice_.smoke}, push, "smoke");
      }
    }
  }

  void queueHits(const TracePush& push) {
    for (std::uint64_t c = 0; c < kHitClasses; ++c) {  // no group yet, of 1 x 1; none in the queue
      const std::uint64_t at = c * kQueueWords * kWord;
      commands_.fill(store_.queues, at, kWord, 0u);
      commands_.fill(store_.queues, at + kWord, 2 * kWord, 1u);
      commands_.fill(store_.queues, at + 3 * kWord, kWord, 0u);
    }
    commands_.barrier();
    commands_.beginSpan("classify");
    commands_.bind(kernels_->get({"classify.comp"}), set_);
    commands_.push(push);
    commands_.dispatch((push.nodeCount + kRaysPerClassifyGroup - 1) / kRaysPerClassifyGroup);
    commands_.endSpan();
    commands_.barrier();
  }

  bool castsShadows(std::uint32_t light) const { return lightShadows_.empty() || lightShadows_[light].shadows; }

  // Of lights that nothing can stop: no rays, all of their light arrives.
  void fillUnshadowed(const TracePush& push) {
    if (choice_.shadow.empty()) return;
    const std::uint32_t planes = push.lightCount + (scene_.scene().atmosphere.environment.present() ? 1 : 0);
    const std::uint64_t planeBytes = std::uint64_t{push.nodeCount} * sizeof(float);
    for (std::uint32_t light = 0; light < push.lightCount; ++light) {
      if (castsShadows(push.firstLight + light)) continue;
      for (std::uint32_t channel = 0; channel < shadowChannels(); ++channel)
        commands_.fill(store_.visibility, (channel * planes + light) * planeBytes, planeBytes,
                       std::bit_cast<std::uint32_t>(1.0f));
    }
    commands_.barrier();
  }

  // For one batch of lights: which of them reach the hits, and what the hits look like then.
  void shadeLevel(TracePush push, std::uint32_t variant) {
    fillUnshadowed(push);
    if (classes_.empty()) {
      traceShadows(push, 0);
      traceEnvironment(push, 0);
      dispatch({"shade.comp", variant}, push, "shade");
    }
    for (push.hitClass = 0; push.hitClass < classes_.size(); ++push.hitClass) {
      if (!classes_[push.hitClass].lit) continue;
      traceShadows(push, kVariantQueue);
      traceEnvironment(push, kVariantQueue);
    }
    for (push.hitClass = 0; push.hitClass < classes_.size(); ++push.hitClass) {
      dispatch({"shade.comp", variant | kVariantQueue, push.hitClass}, push, "shade");
    }
  }

  void traceShadows(TracePush push, std::uint32_t variant) {
    for (push.lightInBatch = 0; push.lightInBatch < push.lightCount; ++push.lightInBatch) {
      if (!castsShadows(push.firstLight + push.lightInBatch)) continue;
      const Light& light = scene_.scene().lights[push.firstLight + push.lightInBatch];
      for (push.shadowChannel = 0; push.shadowChannel < shadowChannels(); ++push.shadowChannel) {
        if (isArea(light) && !choice_.areaShadow.empty())
          dispatch({choice_.areaShadow, variant}, push, "soft shadow");
        else
          dispatch({choice_.shadow, variant}, choice_.shadowRest, push, "shadow");
      }
    }
  }

  // Into the environment, once: behind the visibilities of the first batch.
  void traceEnvironment(TracePush push, std::uint32_t variant) {
    if (push.firstLight > 0 || !scene_.scene().atmosphere.environment.present()) return;
    push.lightInBatch = push.lightCount;
    for (push.shadowChannel = 0; push.shadowChannel < shadowChannels(); ++push.shadowChannel)
      dispatch({choice_.environmentShadow, variant}, push, "soft shadow");
  }

  std::uint32_t shadowChannels() const { return coloredShadows_ && settings_.coloredShadows ? 3 : 1; }

  void gather(const std::vector<TracePush>& levels, Tally& tally) {
    if (!branches_) return;
    commands_.begin();
    commands_.barrier();
    for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
      dispatch({choice_.gather}, *level, "gather");
    }
    submit(tally);
  }

  void count_(const std::array<std::uint32_t, kCounterCount>& counters, std::size_t levels) {
    rays_["shadow"] += counters[kCounterShadowRays];
    rays_["reflection"] += counters[kCounterReflection];
    rays_["refraction"] += counters[kCounterRefraction];
    rays_["passThrough"] += counters[kCounterPassThrough];
    levels_ = std::max<std::uint64_t>(levels_, levels);
    capped_ += counters[kCounterCapped];
    gaveUp_ += counters[kCounterGaveUp];
    if (counters[kCounterMediaLost] > 0) {
      logWarning(fmt::format("some rays are in more than {} bodies at once: those that they entered last are left out",
                             kMostMedia));
    }
    if (counters[kCounterCapped] > 0) {
      logWarning("some rays met the limit of traversal steps; what lies beyond it is missing from the image");
    }
  }

  const gpu::Device& device_;
  GpuScene& scene_;
  const RenderSettings& settings_;
  FilmBuffers& buffers_;
  bool branches_, nestedMedia_, coloredShadows_, smoke_, bodiesScatter_;
  std::vector<LightVerdict> lightShadows_;
  std::shared_ptr<KernelPipelines> kernels_;
  KernelChoice choice_;
  const std::vector<HitClass>& classes_;
  RayStore store_;
  gpu::BindingSet set_;
  gpu::Commands commands_;
  LevelRecorder* recorder_ = nullptr;
  bool packetsGiveUp_ = false;  // some do in this scene: what they leave is done again
  std::map<std::string, std::uint64_t> rays_;
  std::uint64_t levels_ = 0, repeated_ = 0, capped_ = 0, gaveUp_ = 0;
};

}  // namespace

// Place of a pixel within its tile: shaders/trace/camera.glsl.
static std::uint32_t mortonOf(const glm::uvec2& within) {
  std::uint32_t place = 0;
  for (std::uint32_t bit = 0; bit < 3; ++bit)
    place |= ((within.x >> bit & 1u) << (2 * bit)) | ((within.y >> bit & 1u) << (2 * bit + 1));
  return place;
}

std::uint32_t cameraRayCount(std::uint32_t width, std::uint32_t height) {
  const auto tiles = [](std::uint32_t pixels) { return (pixels + kTileSize - 1) / kTileSize; };
  return tiles(width) * tiles(height) * kTileSize * kTileSize;
}

std::unique_ptr<Technique> makeWhittedWith(std::shared_ptr<KernelPipelines> kernels, const gpu::Device& device,
                                           GpuScene& scene, const Plan& plan, const RenderSettings& settings,
                                           FilmBuffers& buffers) {
  kernels->wait();
  return std::make_unique<Whitted>(device, scene, plan, settings, buffers, std::move(kernels),
                                   cameraRayCount(settings.width, settings.height));
}

RayTree traceRayTree(std::shared_ptr<KernelPipelines> kernels, const gpu::Device& device, GpuScene& scene,
                     const Plan& plan, const RenderSettings& settings, const glm::uvec2& pixel) {
  kernels->wait();
  FilmBuffers buffers;
  const std::uint64_t bandPixels = std::uint64_t{settings.width} * kTileSize;
  const auto buffer = [&](const char* name, std::uint64_t bytes) {
    return gpu::Buffer(device, name, bytes, gpu::useStorage | gpu::useReadback);
  };
  buffers.sampleColor = buffer("sample", bandPixels * sizeof(glm::vec4));
  buffers.aovs = buffer("AOV records", sizeof(AovRecord));
  buffers.counters = gpu::Buffer::of(device, "counters", std::vector<std::uint32_t>(kCounterCount, 0u),
                                     gpu::useStorage | gpu::useReadback);
  // Where the kernels look tiles up: those of this band, all of them.
  std::vector<std::uint32_t> tiles((settings.width + kTileSize - 1) / kTileSize);
  std::iota(tiles.begin(), tiles.end(), 0u);
  const gpu::Buffer tileList = gpu::Buffer::of(device, "tiles of the band", tiles, gpu::useUniformTexel);
  buffers.tileList = &tileList;
  Whitted tracer(device, scene, plan, settings, buffers, kernels, 1);
  LevelRecorder recorder(device, *kernels, scene, tracer.nodeCapacity());
  const std::uint32_t firstRow = pixel.y / kTileSize * kTileSize;
  const Band band{firstRow, std::min(kTileSize, settings.height - firstRow)};
  const glm::uvec2 within(pixel.x % kTileSize, pixel.y - firstRow);
  const std::uint32_t place = pixel.x / kTileSize * kTileSize * kTileSize + mortonOf(within);
  tracer.traceOne({band, settings.width, glm::vec2(0.5f)}, place, recorder);
  glm::vec4 color;
  buffers.sampleColor.read((std::uint64_t{within.y} * settings.width + pixel.x) * sizeof(color),
                           std::as_writable_bytes(std::span(&color, 1)));
  return assembleRayTree(recorder, scene.lightCount(), scene.flat().origin, color, branches(plan), pixel);
}

std::unique_ptr<Technique> makeWhitted(const gpu::Device& device, GpuScene& scene, const Plan& plan,
                                       const RenderSettings& settings, FilmBuffers& buffers) {
  auto kernels = std::make_shared<KernelPipelines>(device, scene.scene(), plan, settings);
  return makeWhittedWith(std::move(kernels), device, scene, plan, settings, buffers);
}

}  // namespace crosslight

// The host's side of the ray tree: chunks of pixels, levels within a chunk, batches of lights within a level. All loops
// over unbounded counts are here and not in a kernel (a kernel's loops end silently after 65,535 rounds on Mesa 22.3).
#include "trace/whitted.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/log.h"

namespace crosslight {

using namespace shared;

namespace {

constexpr std::uint32_t kChunkRays = 1u << 18;   // camera rays at once
constexpr std::uint32_t kChunkTrees = 1u << 17;  // the same where they grow trees
constexpr std::uint32_t kNodesPerPixel = 8;      // room for a tree, on average; a fuller chunk is halved
constexpr std::uint32_t kQueueWords = 4;         // of kBindQueues per class, before the rays
constexpr std::uint32_t kRaysPerClassifyGroup = 4 * kRaysPerGroup;
constexpr std::uint32_t kFewestNodes = 4096;  // a small image may still have deep trees

class Whitted final : public Technique {
 public:
  Whitted(const gpu::Device& device, GpuScene& scene, const Plan& plan, const RenderSettings& settings,
          FilmBuffers& buffers, std::shared_ptr<KernelPipelines> kernels)
      : device_(device),
        scene_(scene),
        settings_(settings),
        buffers_(buffers),
        branches_(crosslight::branches(plan)),
        kernels_(std::move(kernels)),
        choice_(forTree(kernels_->choice(), scene)),
        classes_(kernels_->classes().classes),
        set_(device, kernels_->layout()),
        commands_(device) {
    makeBuffers();
    scene_.bind(set_);
    set_.set(kBindRays, raysBuffer_);
    set_.set(kBindRayTexels, raysBuffer_);
    set_.set(kBindRayNodes, nodes_);
    set_.set(kBindNodeTexels, nodes_);
    set_.set(kBindHits, hits_);
    set_.set(kBindHitTexels, hits_);
    set_.set(kBindRest, rest_);
    set_.set(kBindQueues, queues_);
    set_.set(kBindHitClasses, hitClasses_);
    set_.set(kBindVisibility, visibility_);
    set_.set(kBindCounters, buffers.counters);
    set_.set(kBindSampleColor, buffers.sampleColor);
    set_.set(kBindAovs, buffers.aovs);
  }

  void renderSample(const SampleRequest& request, Tally& tally) override {
    scene_.setSample(request.offset);
    rays_["primary"] += std::uint64_t{request.band.rowCount} * request.width;
    const std::uint32_t rays = cameraRayCount(request.width, request.band.rowCount);
    for (std::uint32_t first = 0; first < rays;) {
      const std::uint32_t count = std::min(chunk_, rays - first);
      if (traceChunk(request, first, count, tally)) first += count;
      throwIfInterrupted();
    }
  }

  std::string promise() const override {
    return "E | L[DS_glossy]?S*E: direct light with hard shadows, seen directly or through mirrors and smooth "
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
  void makeBuffers() {
    const bool tree = branches_ && settings_.maxDepth > 0;
    chunk_ = std::min(tree ? kChunkTrees : kChunkRays, cameraRayCount(settings_.width, settings_.height));
    const std::uint64_t fits = device_.info().maxStorageBufferBytes / sizeof(RayNode);
    const std::uint64_t wanted =
        std::max(std::uint64_t{chunk_} * (tree ? kNodesPerPixel : 1), std::uint64_t{kFewestNodes});
    capacity_ = static_cast<std::uint32_t>(std::min(wanted, fits));
    batch_ = lightBatch(scene_.lightCount());
    const bool shadows = !choice_.shadow.empty();
    const auto buffer = [&](const char* name, std::uint64_t count, std::uint64_t size) {
      return gpu::Buffer(device_, name, count * size, gpu::useStorage | gpu::useUniformTexel);
    };
    raysBuffer_ = buffer("rays", tree ? capacity_ : 1, sizeof(RayRecord));
    nodes_ = buffer("ray nodes", branches_ ? capacity_ : 1, sizeof(RayNode));
    hits_ = buffer("hits", capacity_, sizeof(HitRecord));
    rest_ = gpu::Buffer(device_, "groups that packets gave up",
                        (kRestGroups + capacity_ / kRaysPerGroup + 1) * sizeof(std::uint32_t),
                        gpu::useStorage | gpu::useIndirect);
    const std::uint64_t perClass = classes_.empty() ? 0 : kQueueWords + capacity_;
    queues_ =
        gpu::Buffer(device_, "hit queues", std::max<std::uint64_t>(kHitClasses * perClass, 1) * sizeof(std::uint32_t),
                    gpu::useStorage | gpu::useIndirect);
    hitClasses_ = gpu::Buffer::of(device_, "hit classes", kernels_->classes().ofMaterial, gpu::useUniformTexel);
    visibility_ = buffer("visibility", shadows ? std::uint64_t{capacity_} * batch_ : 1, sizeof(float));
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
                                    capacity_, settings_.maxDepth));
    }
    chunk_ = (count + 1) / 2;
    logVerbose(fmt::format("ray tree store is full: going on with chunks of {} pixels", chunk_));
  }

  // Where a kernel's groups come from: all rays of the level, or a queue of its hits.
  void dispatchGroups(const TracePush& push, bool queued) {
    if (queued)
      commands_.dispatchIndirect(queues_, push.hitClass * kQueueWords * sizeof(std::uint32_t));
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
      commands_.fill(rest_, 0, sizeof(std::uint32_t), 0u);
      commands_.fill(rest_, sizeof(std::uint32_t), 2 * sizeof(std::uint32_t), 1u);
      commands_.barrier();
    }
    dispatch(key, push, span);
    if (rest.empty() || !packetsGiveUp_) return;
    commands_.beginSpan(span);
    commands_.bind(kernels_->get({rest, key.variant | kVariantRest}), set_);
    commands_.push(push);
    commands_.dispatchIndirect(rest_, 0);
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
    reset[kCounterGaveUp] = 0;
    buffers_.counters.write(0, std::as_bytes(std::span(reset)));

    TracePush push{};
    push.firstRow = request.band.firstRow;
    push.bandRows = request.band.rowCount;
    push.firstInTiles = first;
    push.nodeCapacity = capacity_;
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
    for (std::uint32_t first = 0; first == 0 || first < lights; first += batch_) {
      push.firstLight = first;
      push.lightCount = std::min(batch_, lights - first);
      shadeLevel(push, primary && aovs ? kVariantAovs : 0);
    }
    submit(tally);
  }

  void queueHits(const TracePush& push) {
    for (std::uint64_t c = 0; c < kHitClasses; ++c) {  // no group yet, of 1 x 1; none in the queue
      const std::uint64_t at = c * kQueueWords * sizeof(std::uint32_t);
      commands_.fill(queues_, at, sizeof(std::uint32_t), 0u);
      commands_.fill(queues_, at + sizeof(std::uint32_t), 2 * sizeof(std::uint32_t), 1u);
      commands_.fill(queues_, at + 3 * sizeof(std::uint32_t), sizeof(std::uint32_t), 0u);
    }
    commands_.barrier();
    TracePush every = push;
    commands_.beginSpan("classify");
    commands_.bind(kernels_->get({"classify.comp"}), set_);
    commands_.push(every);
    commands_.dispatch((push.nodeCount + kRaysPerClassifyGroup - 1) / kRaysPerClassifyGroup);
    commands_.endSpan();
    commands_.barrier();
  }

  // For one batch of lights: which of them reach the hits, and what the hits look like then.
  void shadeLevel(TracePush push, std::uint32_t variant) {
    if (classes_.empty()) {
      traceShadows(push, 0);
      dispatch({"shade.comp", variant}, push, "shade");
    }
    for (push.hitClass = 0; push.hitClass < classes_.size(); ++push.hitClass) {
      if (classes_[push.hitClass].lit) traceShadows(push, kVariantQueue);
    }
    for (push.hitClass = 0; push.hitClass < classes_.size(); ++push.hitClass) {
      dispatch({"shade.comp", variant | kVariantQueue, push.hitClass}, push, "shade");
    }
  }

  void traceShadows(TracePush push, std::uint32_t variant) {
    for (push.lightInBatch = 0; push.lightInBatch < push.lightCount; ++push.lightInBatch) {
      dispatch({choice_.shadow, variant}, choice_.shadowRest, push, "shadow");
    }
  }

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
    if (counters[kCounterCapped] > 0) {
      logWarning("some rays met the limit of traversal steps; what lies beyond it is missing from the image");
    }
  }

  const gpu::Device& device_;
  GpuScene& scene_;
  const RenderSettings& settings_;
  FilmBuffers& buffers_;
  bool branches_;
  std::shared_ptr<KernelPipelines> kernels_;
  KernelChoice choice_;
  const std::vector<HitClass>& classes_;
  gpu::BindingSet set_;
  gpu::Commands commands_;
  gpu::Buffer raysBuffer_, nodes_, hits_, visibility_, rest_, queues_, hitClasses_;
  bool packetsGiveUp_ = false;  // some do in this scene: what they leave is done again
  std::uint32_t chunk_ = 0, capacity_ = 0, batch_ = 1;
  std::map<std::string, std::uint64_t> rays_;
  std::uint64_t levels_ = 0, repeated_ = 0, capped_ = 0, gaveUp_ = 0;
};

}  // namespace

std::uint32_t cameraRayCount(std::uint32_t width, std::uint32_t height) {
  const auto tiles = [](std::uint32_t pixels) { return (pixels + kTileSize - 1) / kTileSize; };
  return tiles(width) * tiles(height) * kTileSize * kTileSize;
}

std::unique_ptr<Technique> makeWhittedWith(std::shared_ptr<KernelPipelines> kernels, const gpu::Device& device,
                                           GpuScene& scene, const Plan& plan, const RenderSettings& settings,
                                           FilmBuffers& buffers) {
  kernels->wait();
  return std::make_unique<Whitted>(device, scene, plan, settings, buffers, std::move(kernels));
}

std::unique_ptr<Technique> makeWhitted(const gpu::Device& device, GpuScene& scene, const Plan& plan,
                                       const RenderSettings& settings, FilmBuffers& buffers) {
  auto kernels = std::make_shared<KernelPipelines>(device, scene.scene(), plan, settings);
  return makeWhittedWith(std::move(kernels), device, scene, plan, settings, buffers);
}

}  // namespace crosslight

// The host's side of the ray tree: chunks of pixels, levels within a chunk, batches of lights within a level. All loops
// over unbounded counts are here and not in a kernel (a kernel's loops end silently after 65,535 rounds on Mesa 22.3).
#include "trace/whitted.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <future>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/log.h"

namespace crosslight {

using namespace shared;

namespace {

constexpr std::uint32_t kGroupSize = 64;          // local_size_x of the kernels
constexpr std::uint32_t kChunkPixels = 1u << 17;  // ray nodes are 88 bytes: a chunk's first level is 11 MB
constexpr std::uint32_t kNodesPerPixel = 4;       // room for the tree, on average; a fuller chunk is halved
constexpr std::uint32_t kLightBatch = 16;         // lights whose visibility is kept at once

class Whitted final : public Technique {
 public:
  Whitted(const gpu::Device& device, GpuScene& scene, const Plan& plan, const RenderSettings& settings,
          FilmBuffers& buffers)
      : device_(device),
        scene_(scene),
        plan_(plan),
        settings_(settings),
        buffers_(buffers),
        layout_(device,
                sceneBindings({kBindRayNodes, kBindHits, kBindVisibility, kBindCounters, kBindSampleColor, kBindAovs}),
                sizeof(TracePush)),
        set_(device, layout_),
        commands_(device) {
    makePipelines();
    makeBuffers();
    scene_.bind(set_);
    set_.set(kBindRayNodes, nodes_);
    set_.set(kBindHits, hits_);
    set_.set(kBindVisibility, visibility_);
    set_.set(kBindCounters, buffers.counters);
    set_.set(kBindSampleColor, buffers.sampleColor);
    set_.set(kBindAovs, buffers.aovs);
  }

  void renderSample(const SampleRequest& request, Tally& tally) override {
    scene_.setSample(request.offset);
    const std::uint32_t pixels = request.band.rowCount * request.width;
    for (std::uint32_t first = 0; first < pixels;) {
      const std::uint32_t count = std::min(chunk_, pixels - first);
      if (traceChunk(request, first, count, tally)) {
        first += count;
      } else {
        halveChunk(count);
      }
      throwIfInterrupted();
    }
  }

  std::string promise() const override {
    return "E | L[DS_glossy]?S*E: direct light with hard shadows, seen directly or through mirrors and smooth "
           "dielectrics; no light that reaches a surface by way of another";
  }

  std::map<std::string, std::uint64_t> rays() const override { return rays_; }

  std::map<std::string, std::uint64_t> counters() const override {
    return {{"rayLevels", levels_}, {"chunksRepeated", repeated_}, {"traversalsCapped", capped_}};
  }

 private:
  void makePipelines() {
    // Each in a thread of its own: a driver takes 100 ms and more for the larger ones.
    const auto start = [&](const char* name) {
      return std::async(std::launch::async, [this, name] {
        return gpu::ComputePipeline(device_, layout_, gpu::embeddedShader(name), constantsOf(plan_));
      });
    };
    auto intersect = start("intersect.comp");
    auto shade = start("shade.comp");
    auto generate = start("generate.comp");
    auto gather = start("gather.comp");
    if (plan_.has(Effect::shadows)) shadow_ = start("shadow.comp").get();
    generate_ = generate.get();
    intersect_ = intersect.get();
    shade_ = shade.get();
    gather_ = gather.get();
  }

  bool branches() const {
    return plan_.has(Effect::reflection) || plan_.has(Effect::refraction) || plan_.has(Effect::transparency);
  }

  void makeBuffers() {
    const std::uint64_t imagePixels = std::uint64_t{settings_.width} * settings_.height;
    chunk_ = static_cast<std::uint32_t>(std::min<std::uint64_t>(kChunkPixels, imagePixels));
    const std::uint32_t perPixel = branches() && settings_.maxDepth > 0 ? kNodesPerPixel : 1;
    // A small image may still have deep trees: 4096 nodes at least.
    const std::uint64_t fits = device_.info().maxStorageBufferBytes / sizeof(RayNode);
    capacity_ = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(std::max(std::uint64_t{chunk_} * perPixel, std::uint64_t{4096}), fits));
    const std::uint64_t visibilities =
        plan_.has(Effect::shadows) ? std::uint64_t{capacity_} * std::min(kLightBatch, std::max(scene_.lightCount(), 1u))
                                   : 1;
    visibilityBatch_ = std::min(kLightBatch, std::max(scene_.lightCount(), 1u));
    nodes_ = gpu::Buffer(device_, "ray nodes", std::uint64_t{capacity_} * sizeof(RayNode), gpu::useStorage);
    hits_ = gpu::Buffer(device_, "hits", std::uint64_t{capacity_} * sizeof(HitRecord), gpu::useStorage);
    visibility_ = gpu::Buffer(device_, "visibility", visibilities * sizeof(float), gpu::useStorage);
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

  void dispatch(const gpu::ComputePipeline& pipeline, const TracePush& push, const char* span, std::uint32_t rows = 1) {
    commands_.beginSpan(span);
    commands_.bind(pipeline, set_);
    commands_.push(push);
    commands_.dispatch((push.nodeCount + kGroupSize - 1) / kGroupSize, rows);
    commands_.endSpan();
    commands_.barrier();
  }

  void submit(Tally& tally) {
    commands_.submitAndWait();
    tally.add(commands_.spans());
  }

  // False when the store overflowed: nothing counts then.
  bool traceChunk(const SampleRequest& request, std::uint32_t first, std::uint32_t count, Tally& tally) {
    std::array<std::uint32_t, kCounterCount> start{};
    buffers_.counters.read(0, std::as_writable_bytes(std::span(start)));
    std::array<std::uint32_t, kCounterCount> reset = start;
    reset[kCounterRayNodes] = count;
    reset[kCounterOverflow] = reset[kCounterShadowRays] = reset[kCounterReflection] = 0;
    reset[kCounterRefraction] = reset[kCounterPassThrough] = reset[kCounterCapped] = 0;
    buffers_.counters.write(0, std::as_bytes(std::span(reset)));

    TracePush push{};
    push.firstPixel = request.band.firstRow * request.width;
    push.pixelOffset = first;
    push.nodeCapacity = capacity_;
    push.maxDepth = settings_.maxDepth;
    push.writeAovs = request.aovs ? 1u : 0u;
    push.nodeCount = count;
    std::vector<TracePush> levels;
    std::array<std::uint32_t, kCounterCount> now{};
    while (push.nodeCount > 0) {
      traceLevel(push, levels.empty(), tally);
      levels.push_back(push);
      buffers_.counters.read(0, std::as_writable_bytes(std::span(now)));
      if (now[kCounterOverflow] > 0) return false;
      push.firstNode += push.nodeCount;
      push.nodeCount = now[kCounterRayNodes] - push.firstNode;
    }
    gather(levels, tally);
    count_(now, count, levels.size());
    return true;
  }

  void traceLevel(TracePush push, bool primary, Tally& tally) {
    commands_.begin();
    commands_.barrier();
    if (primary) dispatch(generate_, push, "generate");
    dispatch(intersect_, push, "intersect");
    const std::uint32_t lights = scene_.lightCount();
    for (std::uint32_t first = 0; first == 0 || first < lights; first += visibilityBatch_) {
      push.firstLight = first;
      push.lightCount = std::min(visibilityBatch_, lights - first);
      if (shadow_ && push.lightCount > 0) dispatch(shadow_, push, "shadow", push.lightCount);
      dispatch(shade_, push, "shade");
    }
    submit(tally);
  }

  void gather(const std::vector<TracePush>& levels, Tally& tally) {
    commands_.begin();
    commands_.barrier();
    for (auto level = levels.rbegin(); level != levels.rend(); ++level) dispatch(gather_, *level, "gather");
    submit(tally);
  }

  void count_(const std::array<std::uint32_t, kCounterCount>& counters, std::uint32_t pixels, std::size_t levels) {
    rays_["primary"] += pixels;
    rays_["shadow"] += counters[kCounterShadowRays];
    rays_["reflection"] += counters[kCounterReflection];
    rays_["refraction"] += counters[kCounterRefraction];
    rays_["passThrough"] += counters[kCounterPassThrough];
    levels_ = std::max<std::uint64_t>(levels_, levels);
    capped_ += counters[kCounterCapped];
    if (counters[kCounterCapped] > 0) {
      logWarning("some rays met the limit of traversal steps; what lies beyond it is missing from the image");
    }
  }

  const gpu::Device& device_;
  GpuScene& scene_;
  const Plan& plan_;
  const RenderSettings& settings_;
  FilmBuffers& buffers_;
  gpu::BindingLayout layout_;
  gpu::BindingSet set_;
  gpu::Commands commands_;
  gpu::ComputePipeline generate_, intersect_, shadow_, shade_, gather_;
  gpu::Buffer nodes_, hits_, visibility_;
  std::uint32_t chunk_ = 0, capacity_ = 0, visibilityBatch_ = 1;
  std::map<std::string, std::uint64_t> rays_;
  std::uint64_t levels_ = 0, repeated_ = 0, capped_ = 0;
};

}  // namespace

std::unique_ptr<Technique> makeWhitted(const gpu::Device& device, GpuScene& scene, const Plan& plan,
                                       const RenderSettings& settings, FilmBuffers& buffers) {
  return std::make_unique<Whitted>(device, scene, plan, settings, buffers);
}

}  // namespace crosslight

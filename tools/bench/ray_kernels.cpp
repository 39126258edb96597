#include "bench/ray_kernels.h"

#include <fmt/format.h>

#include "base/check.h"

namespace crosslight::bench {

using namespace shared;

namespace {

constexpr std::uint32_t kGroupSize = 64;  // local_size_x of the kernels

template <class Record>
gpu::Buffer storage(const gpu::Device& device, const char* name, std::uint64_t count) {
  return gpu::Buffer(device, name, count * sizeof(Record), gpu::useStorage);
}

}  // namespace

RayKernels::RayKernels(const gpu::Device& device, GpuScene& scene, const Plan& plan, const RenderSettings& settings)
    : device_(device),
      scene_(scene),
      pixels_(settings.width * settings.height),
      nodes_(storage<RayNode>(device, "ray nodes", pixels_)),
      hits_(storage<HitRecord>(device, "hits", pixels_)),
      visibility_(storage<float>(device, "visibility", pixels_)),
      counters_(device, "counters", kCounterCount * sizeof(std::uint32_t), gpu::useStorage | gpu::useReadback),
      layout_(device, sceneBindings({kBindRayNodes, kBindHits, kBindVisibility, kBindCounters}), sizeof(TracePush)),
      set_(device, layout_),
      commands_(device) {
  CL_CHECK_EQ(scene.lightCount(), 1u);
  scene_.setSample(glm::vec2(0.5f));
  bind(set_, nodes_, hits_);
  const auto pipeline = [&](const char* name) {
    return gpu::ComputePipeline(device, layout_, gpu::embeddedShader(name), constantsOf(plan));
  };
  generate_ = pipeline("generate.comp");
  intersect_ = pipeline("intersect.comp");
  shadow_ = pipeline("shadow.comp");
  takeCounts();
}

void RayKernels::bind(gpu::BindingSet& set, const gpu::Buffer& nodes, const gpu::Buffer& hits) {
  scene_.bind(set);
  set.set(kBindRayNodes, nodes);
  set.set(kBindHits, hits);
  set.set(kBindVisibility, visibility_);
  set.set(kBindCounters, counters_);
}

double RayKernels::run(const gpu::ComputePipeline& pipeline, const gpu::BindingSet& set, std::uint32_t rays) {
  TracePush push{};
  push.nodeCount = rays;
  push.nodeCapacity = pixels_;
  push.lightCount = 1;
  const std::uint32_t groups = (rays + kGroupSize - 1) / kGroupSize;
  if (groups > device_.info().maxWorkGroupCountX) {
    throw DeviceError(fmt::format("{} rays at once: '{}' allows {} groups of {}", rays, device_.info().name,
                                  device_.info().maxWorkGroupCountX, kGroupSize));
  }
  commands_.begin();
  commands_.barrier();
  commands_.beginSpan("kernel");
  commands_.bind(pipeline, set);
  commands_.push(push);
  commands_.dispatch(groups);
  commands_.endSpan();
  commands_.barrier();
  commands_.submitAndWait();
  return device_.info().timestampPeriodNs > 0 ? commands_.spans().front().gpuMs : commands_.submitToIdleMs();
}

double RayKernels::generate() { return run(generate_, set_, pixels_); }
double RayKernels::intersect() { return run(intersect_, set_, pixels_); }
double RayKernels::shadow() { return run(shadow_, set_, pixels_); }
double RayKernels::bounce() { return run(intersect_, bounceSet_, bounceCount_); }

void RayKernels::setBounceRays(const std::vector<RayNode>& rays) {
  bounceCount_ = static_cast<std::uint32_t>(rays.size());
  bounceNodes_ = gpu::Buffer::of(device_, "bounce rays", rays, gpu::useStorage);
  bounceHits_ = storage<HitRecord>(device_, "bounce hits", rays.size());
  bounceSet_ = gpu::BindingSet(device_, layout_);
  bind(bounceSet_, bounceNodes_, bounceHits_);
}

RayKernels::Counts RayKernels::takeCounts() {
  const std::vector<std::uint32_t> now = counters_.readAll<std::uint32_t>();
  const std::vector<std::uint32_t> zeros(kCounterCount, 0u);
  counters_.write(0, std::as_bytes(std::span(zeros)));
  return {now[kCounterShadowRays], now[kCounterCapped]};
}

}  // namespace crosslight::bench

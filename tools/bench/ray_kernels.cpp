#include "bench/ray_kernels.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/check.h"
#include "base/error.h"
#include "trace/whitted.h"

namespace crosslight::bench {

using namespace shared;

namespace {

template <class Record>
gpu::Buffer texels(const gpu::Device& device, const char* name, std::uint64_t count) {
  return gpu::Buffer(device, name, count * sizeof(Record), gpu::useStorage | gpu::useUniformTexel);
}

RenderSettings withFamily(RenderSettings settings, KernelFamily family) {
  settings.kernel = family;
  settings.hitQueues = HitQueues::off;                  // each kernel by itself
  settings.maxDepth = std::max(settings.maxDepth, 1u);  // a kernel for secondary rays is wanted too
  return settings;
}

// So that a kernel for secondary rays is among those that the plan runs.
Plan branching(Plan plan) {
  plan.effects |= bitOf(Effect::reflection);
  return plan;
}

}  // namespace

RayKernels::RayKernels(const gpu::Device& device, GpuScene& scene, const Plan& plan, const RenderSettings& settings,
                       KernelFamily family)
    : device_(device),
      scene_(scene),
      count_(cameraRayCount(settings.width, settings.height)),
      rows_(settings.height),
      kernels_(device, scene.scene(), plan, withFamily(settings, family)),
      secondary_(device, scene.scene(), branching(plan), withFamily(settings, family)),
      rays_(texels<RayRecord>(device, "rays", count_)),
      nodes_(texels<RayNode>(device, "ray nodes", 1)),
      hits_(texels<HitRecord>(device, "hits", count_)),
      visibility_(device, "visibility", count_ * sizeof(float), gpu::useStorage),
      counters_(device, "counters", kCounterCount * sizeof(std::uint32_t), gpu::useStorage | gpu::useReadback),
      rest_(device, "rest", (kRestGroups + count_ / kRaysPerGroup + 1) * sizeof(std::uint32_t), gpu::useStorage),
      dummy_(device, "unused", sizeof(AovRecord), gpu::useStorage),
      set_(device, kernels_.layout()),
      commands_(device) {
  CL_CHECK_EQ(scene.lightCount(), 1u);
  scene_.setSample(glm::vec2(0.5f));
  bind(set_, rays_, hits_);
  takeCounts();
}

void RayKernels::bind(gpu::BindingSet& set, const gpu::Buffer& rays, const gpu::Buffer& hits) {
  scene_.bind(set);
  set.set(kBindRays, rays);
  set.set(kBindRayTexels, rays);
  set.set(kBindRayNodes, nodes_);
  set.set(kBindNodeTexels, nodes_);
  set.set(kBindHits, hits);
  set.set(kBindHitTexels, hits);
  set.set(kBindVisibility, visibility_);
  set.set(kBindCounters, counters_);
  set.set(kBindRest, rest_);
  set.set(kBindQueues, dummy_);
  set.set(kBindMedia, dummy_);
  set.set(kBindHitClasses, nodes_);
  set.set(kBindSampleColor, dummy_);
  set.set(kBindAovs, dummy_);
}

double RayKernels::run(KernelPipelines& kernels, const std::string& kernel, const gpu::BindingSet& set,
                       std::uint32_t rays) {
  TracePush push{};
  push.nodeCount = rays;
  push.nodeCapacity = count_;
  push.lightCount = 1;
  push.bandRows = rows_;
  const std::uint32_t groups = (rays + kRaysPerGroup - 1) / kRaysPerGroup;
  if (groups > device_.info().maxWorkGroupCountX) {
    throw DeviceError(fmt::format("{} rays at once: '{}' allows {} groups of {}", rays, device_.info().name,
                                  device_.info().maxWorkGroupCountX, kRaysPerGroup));
  }
  commands_.begin();
  commands_.barrier();
  commands_.beginSpan("kernel");
  commands_.bind(kernels.get({kernel}), set);
  commands_.push(push);
  commands_.dispatch(groups);
  commands_.endSpan();
  commands_.barrier();
  commands_.submitAndWait();
  return device_.info().timestampPeriodNs > 0 ? commands_.spans().front().gpuMs : commands_.submitToIdleMs();
}

double RayKernels::camera() { return run(kernels_, kernels_.choice().camera, set_, count_); }
double RayKernels::shadow() { return run(kernels_, kernels_.choice().shadow, set_, count_); }
double RayKernels::bounce() { return run(secondary_, secondary_.choice().secondary, bounceSet_, bounceCount_); }

void RayKernels::setBounceRays(const std::vector<RayRecord>& rays) {
  bounceCount_ = static_cast<std::uint32_t>(rays.size());
  bounceRays_ = gpu::Buffer::of(device_, "bounce rays", rays, gpu::useStorage | gpu::useUniformTexel);
  bounceHits_ = texels<HitRecord>(device_, "bounce hits", rays.size());
  bounceSet_ = gpu::BindingSet(device_, secondary_.layout());
  bind(bounceSet_, bounceRays_, bounceHits_);
}

RayKernels::Counts RayKernels::takeCounts() {
  const std::vector<std::uint32_t> now = counters_.readAll<std::uint32_t>();
  const std::vector<std::uint32_t> zeros(kCounterCount, 0u);
  counters_.write(0, std::as_bytes(std::span(zeros)));
  return {now[kCounterShadowRays], now[kCounterCapped], now[kCounterGaveUp]};
}

}  // namespace crosslight::bench

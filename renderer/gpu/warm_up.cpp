// llvmpipe compiles within the first dispatch, on the driver's own thread for the queue, before it looks how many
// groups there are: a dispatch of none is enough (Mesa 22.3.6). Its code depends on the formats of texel buffers, and
// on their sizes in ways that makeBuffer keeps from mattering.
#include "gpu/warm_up.h"

#include <chrono>
#include <condition_variable>
#include <list>

#include "gpu/impl.h"

namespace crosslight::gpu {
namespace {

constexpr std::uint64_t kDummyBytes = 48;  // three texels
constexpr double kTimeoutSeconds = 60.0;   // a kernel takes a quarter of a second
constexpr double kCachedSeconds = 0.03;    // from Mesa's cache: 2 to 7 ms, and the machine may be busy

std::uint64_t inNs(double seconds) { return static_cast<std::uint64_t>(seconds * 1e9); }

struct Run {
  vk::raii::CommandBuffer commands{nullptr};
  vk::raii::Fence fence{nullptr};
};

}  // namespace

struct WarmUpImpl {
  WarmUpImpl(const Device& on, const BindingLayout& layout)
      : device(&on.impl()),
        dummy(on, "warm-up", kDummyBytes, useStorage | useUniformTexel | useUniform),
        set(on, layout) {
    for (const Binding& binding : layout.impl().bindings) {
      const bool searches = binding.type == BindingType::boxSearch;
      if (searches && !nothing) nothing = BoxSearch(on, "warm-up", dummy, 0);
      if (searches)
        set.set(binding.slot, nothing);
      else
        set.set(binding.slot, dummy);
    }
    pool = vk::raii::CommandPool(device->device, vk::CommandPoolCreateInfo({}, device->queueFamily));
  }

  DeviceImpl* device;
  Buffer dummy;
  BoxSearch nothing;
  BindingSet set;
  std::mutex mutex;
  vk::raii::CommandPool pool{nullptr};
  std::list<Run> runs;
  std::condition_variable hasRuns;

  // Nothing that a run uses may go before it has ended.
  ~WarmUpImpl() {
    for (const Run& run : runs) {
      try {
        if (device->device.waitForFences(*run.fence, VK_TRUE, inNs(kTimeoutSeconds)) == vk::Result::eSuccess) continue;
      } catch (const vk::SystemError&) {
      }
      device->abandoned = true;
    }
  }
};

WarmUp::WarmUp(const Device& device, const BindingLayout& layout) {
  if (!device.impl().info.isSoftware) return;
  guarded("preparing to compile kernels", [&] { impl_.reset(new WarmUpImpl(device, layout)); });
}

void WarmUp::add(const ComputePipeline& pipeline) {
  if (impl_ == nullptr) return;
  const std::scoped_lock lock(impl_->mutex);
  guarded("compiling a kernel", [&] {
    DeviceImpl& device = *impl_->device;
    Run run;
    const vk::CommandBufferAllocateInfo info(*impl_->pool, vk::CommandBufferLevel::ePrimary, 1);
    run.commands = std::move(device.device.allocateCommandBuffers(info).front());
    run.fence = vk::raii::Fence(device.device, vk::FenceCreateInfo());
    run.commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    run.commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline.impl().pipeline);
    run.commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *pipeline.impl().layout->pipeline, 0,
                                    impl_->set.impl().set, {});
    run.commands.dispatch(0, 1, 1);
    run.commands.end();
    submit(device, *run.commands, *run.fence);
    impl_->runs.push_back(std::move(run));
  });
  impl_->hasRuns.notify_all();
}

bool WarmUp::compiles() {
  if (impl_ == nullptr) return false;
  std::unique_lock lock(impl_->mutex);
  const auto any = [this] { return !impl_->runs.empty(); };
  if (!impl_->hasRuns.wait_for(lock, std::chrono::duration<double>(kTimeoutSeconds), any)) return false;
  const vk::Fence first = *impl_->runs.front().fence;
  lock.unlock();
  return guarded("compiling a kernel", [&] {
    return impl_->device->device.waitForFences(first, VK_TRUE, inNs(kCachedSeconds)) == vk::Result::eTimeout;
  });
}

template struct Release<WarmUpImpl>;

}  // namespace crosslight::gpu

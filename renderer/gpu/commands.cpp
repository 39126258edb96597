#include "gpu/commands.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/check.h"
#include "base/time.h"
#include "gpu/commands_impl.h"

namespace crosslight::gpu {

namespace {

void fillCommands(CommandsImpl& impl) {
  const DeviceImpl& device = *impl.device;
  impl.pool = vk::raii::CommandPool(device.device, vk::CommandPoolCreateInfo({}, device.queueFamily));
  const vk::CommandBufferAllocateInfo info(*impl.pool, vk::CommandBufferLevel::ePrimary, 1);
  impl.commands = std::move(device.device.allocateCommandBuffers(info).front());
  impl.fence = vk::raii::Fence(device.device, vk::FenceCreateInfo());
}

std::size_t windowCount(const BindingLayoutImpl& layout) {
  return static_cast<std::size_t>(std::count_if(layout.bindings.begin(), layout.bindings.end(),
                                                [](const Binding& b) { return b.type == BindingType::uniformWindow; }));
}

void bindPipeline(CommandsImpl& impl, const PipelineImpl& pipeline, const BindingSetImpl& set) {
  CL_CHECK(impl.recording);
  CL_CHECK(pipeline.layout == set.layout);
  for (std::size_t i = 0; i < set.isSet.size(); ++i) {
    if (set.isSet[i]) continue;
    throw InternalError(fmt::format("broken invariant: binding slot {} has no buffer", set.layout->bindings[i].slot));
  }
  impl.commands.bindPipeline(pipeline.point, *pipeline.pipeline);
  const std::vector<std::uint32_t> offsets(windowCount(*set.layout), 0u);
  impl.commands.bindDescriptorSets(pipeline.point, *pipeline.layout->pipeline, 0, set.set, offsets);
  impl.bound = pipeline.layout;
  impl.pipeline = &pipeline;
}

void checkCanDispatch(const CommandsImpl& impl) {
  CL_CHECK(impl.recording && !impl.drawing);
  CL_CHECK(impl.pipeline != nullptr && impl.pipeline->point == vk::PipelineBindPoint::eCompute);
}

}  // namespace

Commands::Commands(const Device& device) : impl_(new CommandsImpl{&device.impl()}) {
  guarded("making a command buffer", [&] { fillCommands(*impl_); });
}

void Commands::begin() {
  guarded("recording commands", [&] {
    impl_->pool.reset();
    impl_->commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    impl_->timer.restart();
    // What earlier batches wrote becomes visible to this one.
    fullBarrier(impl_->commands);
  });
  impl_->layouts.clear();
  impl_->bound.reset();
  impl_->pipeline = nullptr;
  impl_->recording = true;
  impl_->drawing = false;
}

void Commands::bind(const ComputePipeline& pipeline, const BindingSet& set) {
  bindPipeline(*impl_, pipeline.impl(), set.impl());
}

void Commands::bind(const GraphicsPipeline& pipeline, const BindingSet& set) {
  bindPipeline(*impl_, pipeline.impl(), set.impl());
}

void Commands::moveWindows(const BindingSet& set, std::span<const std::uint32_t> offsets) {
  CL_CHECK(impl_->pipeline != nullptr && impl_->bound == set.impl().layout);
  CL_CHECK_EQ(offsets.size(), windowCount(*impl_->bound));
  for (const std::uint32_t offset : offsets) CL_CHECK_EQ(offset % impl_->device->info.uniformWindowAlignment, 0u);
  const vk::ArrayProxy<const std::uint32_t> moved(static_cast<std::uint32_t>(offsets.size()), offsets.data());
  impl_->commands.bindDescriptorSets(impl_->pipeline->point, *impl_->bound->pipeline, 0, set.impl().set, moved);
}

void Commands::push(std::span<const std::byte> bytes) {
  CL_CHECK(impl_->bound != nullptr);
  CL_CHECK_LE(bytes.size(), impl_->bound->pushBytes);
  CL_CHECK_EQ(bytes.size() % 4, 0u);
  const vk::ArrayProxy<const std::byte> values(static_cast<std::uint32_t>(bytes.size()), bytes.data());
  if (!bytes.empty()) impl_->commands.pushConstants<std::byte>(*impl_->bound->pipeline, kAllStages, 0, values);
}

void Commands::dispatch(std::uint32_t groupsX, std::uint32_t groupsY, std::uint32_t groupsZ) {
  checkCanDispatch(*impl_);
  const auto& most = impl_->device->limits.maxComputeWorkGroupCount;
  CL_CHECK_LE(groupsX, most[0]);
  CL_CHECK_LE(groupsY, most[1]);
  CL_CHECK_LE(groupsZ, most[2]);
  impl_->commands.dispatch(groupsX, groupsY, groupsZ);
}

void Commands::dispatchIndirect(const Buffer& arguments, std::uint64_t offset) {
  checkCanDispatch(*impl_);
  checkUse(arguments.impl(), useIndirect);
  checkRange(arguments.impl(), offset, 3 * sizeof(std::uint32_t));
  CL_CHECK_EQ(offset % 4, 0u);
  impl_->commands.dispatchIndirect(*arguments.impl().buffer, offset);
}

void Commands::fill(const Buffer& buffer, std::uint64_t offset, std::uint64_t sizeBytes, std::uint32_t value) {
  CL_CHECK(impl_->recording && !impl_->drawing);
  checkRange(buffer.impl(), offset, sizeBytes);
  CL_CHECK_EQ(offset % 4, 0u);
  CL_CHECK_EQ(sizeBytes % 4, 0u);
  if (sizeBytes > 0) impl_->commands.fillBuffer(*buffer.impl().buffer, offset, sizeBytes, value);
}

void Commands::copy(const Buffer& from, std::uint64_t fromOffset, const Buffer& to, std::uint64_t toOffset,
                    std::uint64_t sizeBytes) {
  CL_CHECK(impl_->recording && !impl_->drawing);
  checkRange(from.impl(), fromOffset, sizeBytes);
  checkRange(to.impl(), toOffset, sizeBytes);
  if (sizeBytes == 0) return;
  impl_->commands.copyBuffer(*from.impl().buffer, *to.impl().buffer, vk::BufferCopy(fromOffset, toOffset, sizeBytes));
}

void Commands::barrier() {
  CL_CHECK(impl_->recording && !impl_->drawing);
  fullBarrier(impl_->commands);
}

void Commands::beginSpan(std::string_view name) {
  CL_CHECK(impl_->recording);
  guarded("timing a span", [&] { impl_->timer.begin(*impl_->device, impl_->commands, name, impl_->drawing); });
}

void Commands::endSpan() {
  CL_CHECK(impl_->recording);
  impl_->timer.end(*impl_->device, impl_->commands, impl_->drawing);
}

void Commands::submitAndWait(double timeoutSeconds) {
  CL_CHECK(impl_->recording && !impl_->drawing);
  DeviceImpl& device = *impl_->device;
  guarded("running commands", [&] {
    fullBarrier(impl_->commands);  // the host may read everything
    impl_->commands.end();
    impl_->recording = false;
    throwOnMessages(device);
    const Stopwatch watch;
    gpu::submitAndWait(device, *impl_->commands, *impl_->fence, timeoutSeconds, "running commands");
    impl_->submitToIdleMs = watch.elapsedMs();
    for (const auto& [image, layout] : impl_->layouts) image->layout = layout;
    impl_->timer.collect(device);
  });
  throwOnMessages(device);
}

const std::vector<TimedSpan>& Commands::spans() const { return impl_->timer.spans(); }
double Commands::submitToIdleMs() const { return impl_->submitToIdleMs; }

template struct Release<CommandsImpl>;

}  // namespace crosslight::gpu

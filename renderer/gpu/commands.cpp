#include "gpu/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/check.h"
#include "base/time.h"
#include "gpu/span_timer.h"

namespace crosslight::gpu {

struct CommandsImpl {
  DeviceImpl* device;
  vk::raii::CommandPool pool{nullptr};
  vk::raii::CommandBuffer commands{nullptr};
  vk::raii::Fence fence{nullptr};
  SpanTimer timer = {};
  // Layouts that images will have once this batch has run; they become the images' own at the submit.
  std::vector<std::pair<ImageImpl*, vk::ImageLayout>> layouts = {};
  SharedLayout bound = nullptr;
  const PipelineImpl* pipeline = nullptr;
  bool recording = false;
  bool drawing = false;  // between beginRendering and endRendering
  vk::Extent2D targetExtent = {};
  std::uint32_t targetSamples = 1;
  bool targetHasColor = false, targetHasDepth = false;
  double submitToIdleMs = 0;
};

namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

void fillCommands(CommandsImpl& impl) {
  const DeviceImpl& device = *impl.device;
  impl.pool = vk::raii::CommandPool(device.device, vk::CommandPoolCreateInfo({}, device.queueFamily));
  const vk::CommandBufferAllocateInfo info(*impl.pool, vk::CommandBufferLevel::ePrimary, 1);
  impl.commands = std::move(device.device.allocateCommandBuffers(info).front());
  impl.fence = vk::raii::Fence(device.device, vk::FenceCreateInfo());
}

vk::ImageLayout& layoutOf(CommandsImpl& impl, ImageImpl& image) {
  for (auto& [known, layout] : impl.layouts) {
    if (known == &image) return layout;
  }
  return impl.layouts.emplace_back(&image, image.layout).second;
}

// Orders all earlier uses of the image before all later ones, in the layout that the later ones need.
void moveTo(CommandsImpl& impl, ImageImpl& image, vk::ImageLayout to, bool keepContents) {
  vk::ImageLayout& layout = layoutOf(impl, image);
  const bool isDepth = image.format == ImageFormat::depth32f;
  const auto aspect = isDepth ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor;
  if (keepContents && layout == vk::ImageLayout::eUndefined) {
    throw InternalError(
        fmt::format("broken invariant: image '{}' is read or drawn over before it has contents", image.name));
  }
  const auto barrier = vk::ImageMemoryBarrier2()
                           .setSrcStageMask(Stage::eAllCommands)
                           .setSrcAccessMask(Access::eMemoryRead | Access::eMemoryWrite)
                           .setDstStageMask(Stage::eAllCommands)
                           .setDstAccessMask(Access::eMemoryRead | Access::eMemoryWrite)
                           .setOldLayout(keepContents ? layout : vk::ImageLayout::eUndefined)
                           .setNewLayout(to)
                           .setImage(*image.image)
                           .setSubresourceRange({aspect, 0, 1, 0, 1});
  impl.commands.pipelineBarrier2(vk::DependencyInfo().setImageMemoryBarriers(barrier));
  layout = to;
}

void checkTargets(const RenderTargets& targets) {
  CL_CHECK(targets.color != nullptr || targets.depth != nullptr);
  CL_CHECK(targets.resolve == nullptr || targets.color != nullptr);
  const ImageImpl& main = targets.color != nullptr ? targets.color->impl() : targets.depth->impl();
  for (const Image* image : {targets.color, targets.resolve, targets.depth}) {
    if (image == nullptr) continue;
    CL_CHECK_EQ(image->width(), main.extent.width);
    CL_CHECK_EQ(image->height(), main.extent.height);
    const bool isDepth = image->impl().format == ImageFormat::depth32f;
    CL_CHECK_EQ(isDepth, image == targets.depth);
    CL_CHECK_EQ(image->samples(), image == targets.resolve ? 1u : main.samples);
  }
  CL_CHECK(targets.resolve == nullptr || main.samples > 1);
}

vk::RenderingAttachmentInfo colorAttachment(CommandsImpl& impl, const RenderTargets& targets) {
  constexpr auto kLayout = vk::ImageLayout::eColorAttachmentOptimal;
  const glm::vec4& clear = targets.clearValue;
  moveTo(impl, targets.color->impl(), kLayout, !targets.clearColor);
  auto info = vk::RenderingAttachmentInfo()
                  .setImageView(*targets.color->impl().view)
                  .setImageLayout(kLayout)
                  .setLoadOp(targets.clearColor ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eLoad)
                  .setStoreOp(vk::AttachmentStoreOp::eStore)
                  .setClearValue(vk::ClearColorValue(std::array{clear.r, clear.g, clear.b, clear.a}));
  if (targets.resolve == nullptr) return info;
  moveTo(impl, targets.resolve->impl(), kLayout, false);
  return info.setResolveMode(vk::ResolveModeFlagBits::eAverage)
      .setResolveImageView(*targets.resolve->impl().view)
      .setResolveImageLayout(kLayout);
}

vk::RenderingAttachmentInfo depthAttachment(CommandsImpl& impl, const RenderTargets& targets) {
  constexpr auto kLayout = vk::ImageLayout::eDepthAttachmentOptimal;
  moveTo(impl, targets.depth->impl(), kLayout, !targets.clearDepth);
  return vk::RenderingAttachmentInfo()
      .setImageView(*targets.depth->impl().view)
      .setImageLayout(kLayout)
      .setLoadOp(targets.clearDepth ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eLoad)
      .setStoreOp(vk::AttachmentStoreOp::eStore)
      .setClearValue(vk::ClearDepthStencilValue(0.0f, 0));
}

// The dynamic state that every pipeline of this room has.
void setDrawDefaults(const vk::raii::CommandBuffer& commands, const vk::Extent2D& extent) {
  commands.setViewport(
      0, vk::Viewport(0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0.0f, 1.0f));
  commands.setScissor(0, vk::Rect2D({0, 0}, extent));
  commands.setCullMode(vk::CullModeFlagBits::eNone);
  commands.setFrontFace(vk::FrontFace::eCounterClockwise);
}

void bindPipeline(CommandsImpl& impl, const PipelineImpl& pipeline, const BindingSetImpl& set) {
  CL_CHECK(impl.recording);
  CL_CHECK(pipeline.layout == set.layout);
  for (std::size_t i = 0; i < set.isSet.size(); ++i) {
    if (set.isSet[i]) continue;
    throw InternalError(fmt::format("broken invariant: binding slot {} has no buffer", set.layout->bindings[i].slot));
  }
  impl.commands.bindPipeline(pipeline.point, *pipeline.pipeline);
  impl.commands.bindDescriptorSets(pipeline.point, *pipeline.layout->pipeline, 0, set.set, {});
  impl.bound = pipeline.layout;
  impl.pipeline = &pipeline;
}

void checkCanDispatch(const CommandsImpl& impl) {
  CL_CHECK(impl.recording && !impl.drawing);
  CL_CHECK(impl.pipeline != nullptr && impl.pipeline->point == vk::PipelineBindPoint::eCompute);
}

void checkRange(const BufferImpl& buffer, std::uint64_t offset, std::uint64_t bytes) {
  CL_CHECK_LE(offset, buffer.sizeBytes);
  CL_CHECK_LE(bytes, buffer.sizeBytes - offset);
}

void checkRows(const vk::Extent2D& extent, std::uint32_t firstRow, std::uint32_t rowCount) {
  CL_CHECK_LE(firstRow, extent.height);
  CL_CHECK_LE(rowCount, extent.height - firstRow);
}

void checkUse(const BufferImpl& buffer, std::uint32_t use) {
  if ((buffer.use & use) != 0) return;
  throw InternalError(fmt::format("broken invariant: buffer '{}' was not made for this use", buffer.name));
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

void Commands::beginRendering(const RenderTargets& targets) {
  CL_CHECK(impl_->recording && !impl_->drawing);
  checkTargets(targets);
  const ImageImpl& main = targets.color != nullptr ? targets.color->impl() : targets.depth->impl();
  auto info = vk::RenderingInfo().setRenderArea({{0, 0}, main.extent}).setLayerCount(1);
  vk::RenderingAttachmentInfo color, depth;
  if (targets.color != nullptr) {
    color = colorAttachment(*impl_, targets);
    info.setColorAttachments(color);
  }
  if (targets.depth != nullptr) {
    depth = depthAttachment(*impl_, targets);
    info.setPDepthAttachment(&depth);
  }
  impl_->commands.beginRendering(info);
  setDrawDefaults(impl_->commands, main.extent);
  impl_->drawing = true;
  impl_->targetExtent = main.extent;
  impl_->targetSamples = main.samples;
  impl_->targetHasColor = targets.color != nullptr;
  impl_->targetHasDepth = targets.depth != nullptr;
}

void Commands::endRendering() {
  CL_CHECK(impl_->drawing);
  impl_->commands.endRendering();
  impl_->drawing = false;
}

void Commands::bindVertexBuffer(std::uint32_t slot, const Buffer& buffer) {
  CL_CHECK(impl_->recording);
  checkUse(buffer.impl(), useVertex);
  impl_->commands.bindVertexBuffers(slot, *buffer.impl().buffer, vk::DeviceSize{0});
}

void Commands::bindIndexBuffer(const Buffer& buffer) {
  CL_CHECK(impl_->recording);
  checkUse(buffer.impl(), useIndex);
  impl_->commands.bindIndexBuffer(*buffer.impl().buffer, 0, vk::IndexType::eUint32);
}

void Commands::cull(Cull mode, bool clockwiseIsFront) {
  CL_CHECK(impl_->recording);
  impl_->commands.setCullMode(mode == Cull::back ? vk::CullModeFlagBits::eBack : vk::CullModeFlagBits::eNone);
  impl_->commands.setFrontFace(clockwiseIsFront ? vk::FrontFace::eClockwise : vk::FrontFace::eCounterClockwise);
}

void Commands::scissorRows(std::uint32_t firstRow, std::uint32_t rowCount) {
  CL_CHECK(impl_->drawing);
  checkRows(impl_->targetExtent, firstRow, rowCount);
  impl_->commands.setScissor(
      0, vk::Rect2D({0, static_cast<std::int32_t>(firstRow)}, {impl_->targetExtent.width, rowCount}));
}

void Commands::drawIndexed(std::uint32_t indexCount, std::uint32_t firstIndex, std::int32_t vertexOffset,
                           std::uint32_t firstInstance) {
  CL_CHECK(impl_->drawing);
  CL_CHECK(impl_->pipeline != nullptr && impl_->pipeline->point == vk::PipelineBindPoint::eGraphics);
  CL_CHECK_EQ(impl_->pipeline->samples, impl_->targetSamples);
  CL_CHECK_EQ(impl_->pipeline->drawsColor, impl_->targetHasColor);
  CL_CHECK_EQ(impl_->pipeline->drawsDepth, impl_->targetHasDepth);
  impl_->commands.drawIndexed(indexCount, 1, firstIndex, vertexOffset, firstInstance);
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

void Commands::copyToBuffer(const Image& from, std::uint32_t firstRow, std::uint32_t rowCount, const Buffer& to) {
  CL_CHECK(impl_->recording && !impl_->drawing);
  ImageImpl& image = from.impl();
  CL_CHECK_EQ(image.samples, 1u);
  CL_CHECK(image.format == ImageFormat::rgba32f);
  checkRows(image.extent, firstRow, rowCount);
  checkRange(to.impl(), 0, std::uint64_t{16} * image.extent.width * rowCount);
  if (rowCount == 0) return;
  moveTo(*impl_, image, vk::ImageLayout::eTransferSrcOptimal, true);
  const auto region = vk::BufferImageCopy()
                          .setImageSubresource({vk::ImageAspectFlagBits::eColor, 0, 0, 1})
                          .setImageOffset({0, static_cast<std::int32_t>(firstRow), 0})
                          .setImageExtent({image.extent.width, rowCount, 1});
  impl_->commands.copyImageToBuffer(*image.image, vk::ImageLayout::eTransferSrcOptimal, *to.impl().buffer, region);
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

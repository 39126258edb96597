// The part of Commands that touches images: rendering passes, their draws, and reading an image back.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/check.h"
#include "gpu/commands_impl.h"

namespace crosslight::gpu {
namespace {

vk::ImageLayout& layoutOf(CommandsImpl& impl, ImageImpl& image) {
  for (auto& [known, layout] : impl.layouts) {
    if (known == &image) return layout;
  }
  return impl.layouts.emplace_back(&image, image.layout).second;
}

// Orders all earlier uses of the image before all later ones, in the layout that the later ones need.
void moveTo(CommandsImpl& impl, ImageImpl& image, vk::ImageLayout to, bool keepContents) {
  using Stage = vk::PipelineStageFlagBits2;
  using Access = vk::AccessFlagBits2;
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

void checkRows(const vk::Extent2D& extent, std::uint32_t firstRow, std::uint32_t rowCount) {
  CL_CHECK_LE(firstRow, extent.height);
  CL_CHECK_LE(rowCount, extent.height - firstRow);
}

void checkTargets(const RenderTargets& targets) {
  CL_CHECK(targets.color != nullptr || targets.depth != nullptr);
  CL_CHECK(targets.resolve == nullptr || targets.color != nullptr);
  CL_CHECK(targets.color == nullptr || targets.colorBefore != ColorBefore::clear ||
           targets.color->impl().format == ImageFormat::rgba32f);  // clearValue is of floats
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

vk::AttachmentLoadOp loadOpOf(ColorBefore before) {
  if (before == ColorBefore::clear) return vk::AttachmentLoadOp::eClear;
  return before == ColorBefore::keep ? vk::AttachmentLoadOp::eLoad : vk::AttachmentLoadOp::eDontCare;
}

vk::ImageLayout colorLayout(const ImageImpl& image) {
  return image.overBuffer ? vk::ImageLayout::eGeneral : vk::ImageLayout::eColorAttachmentOptimal;
}

vk::RenderingAttachmentInfo colorAttachment(CommandsImpl& impl, const RenderTargets& targets) {
  const vk::ImageLayout layout = colorLayout(targets.color->impl());
  const glm::vec4& clear = targets.clearValue;
  const bool keeps = targets.colorBefore == ColorBefore::keep;
  moveTo(impl, targets.color->impl(), layout, keeps);
  auto info = vk::RenderingAttachmentInfo()
                  .setImageView(*targets.color->impl().view)
                  .setImageLayout(layout)
                  .setLoadOp(loadOpOf(targets.colorBefore))
                  .setStoreOp(vk::AttachmentStoreOp::eStore)
                  .setClearValue(vk::ClearColorValue(std::array{clear.r, clear.g, clear.b, clear.a}));
  if (targets.resolve == nullptr) return info;
  const vk::ImageLayout resolveLayout = colorLayout(targets.resolve->impl());
  moveTo(impl, targets.resolve->impl(), resolveLayout, false);
  return info.setResolveMode(vk::ResolveModeFlagBits::eAverage)
      .setResolveImageView(*targets.resolve->impl().view)
      .setResolveImageLayout(resolveLayout);
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

vk::Rect2D areaOf(const RenderTargets& targets, const vk::Extent2D& extent) {
  const std::uint32_t rows = targets.rowCount > 0 ? targets.rowCount : extent.height - targets.firstRow;
  checkRows(extent, targets.firstRow, rows);
  return {{0, static_cast<std::int32_t>(targets.firstRow)}, {extent.width, rows}};
}

// The dynamic state that every pipeline of this room has.
void setDrawDefaults(const vk::raii::CommandBuffer& commands, const vk::Extent2D& extent, const vk::Rect2D& area) {
  commands.setViewport(
      0, vk::Viewport(0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0.0f, 1.0f));
  commands.setScissor(0, area);
  commands.setCullMode(vk::CullModeFlagBits::eNone);
  commands.setFrontFace(vk::FrontFace::eCounterClockwise);
}

// Vulkan bounds both a viewport's size and where it may lie.
void checkViewport(const DeviceImpl& device, std::uint32_t firstRow, std::uint32_t height) {
  CL_CHECK_LT(firstRow, height);
  CL_CHECK_LE(height, device.limits.maxViewportDimensions[1]);
  CL_CHECK_LE(device.limits.viewportBoundsRange[0], -static_cast<float>(firstRow));
}

void checkCanDraw(const CommandsImpl& impl) {
  CL_CHECK(impl.drawing);
  CL_CHECK(impl.pipeline != nullptr && impl.pipeline->point == vk::PipelineBindPoint::eGraphics);
  CL_CHECK_EQ(impl.pipeline->samples, impl.targetSamples);
  CL_CHECK_EQ(impl.pipeline->drawsColor, impl.targetHasColor);
  CL_CHECK(!impl.targetHasColor || impl.pipeline->colorFormat == impl.targetColorFormat);
  CL_CHECK_EQ(impl.pipeline->drawsDepth, impl.targetHasDepth);
}

}  // namespace

void Commands::beginRendering(const RenderTargets& targets) {
  CL_CHECK(impl_->recording && !impl_->drawing);
  checkTargets(targets);
  const ImageImpl& main = targets.color != nullptr ? targets.color->impl() : targets.depth->impl();
  const vk::Rect2D area = areaOf(targets, main.extent);
  auto info = vk::RenderingInfo().setRenderArea(area).setLayerCount(1);
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
  setDrawDefaults(impl_->commands, main.extent, area);
  impl_->drawing = true;
  impl_->targetExtent = main.extent;
  impl_->targetSamples = main.samples;
  impl_->targetHasColor = targets.color != nullptr;
  if (targets.color != nullptr) impl_->targetColorFormat = targets.color->impl().format;
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

void Commands::viewportRows(std::uint32_t firstRow, std::uint32_t height) {
  CL_CHECK(impl_->drawing);
  checkViewport(*impl_->device, firstRow, height);
  impl_->commands.setViewport(
      0, vk::Viewport(0, -static_cast<float>(firstRow), static_cast<float>(impl_->targetExtent.width),
                      static_cast<float>(height), 0.0f, 1.0f));
}

void Commands::drawIndexed(std::uint32_t indexCount, std::uint32_t firstIndex, std::int32_t vertexOffset,
                           std::uint32_t firstInstance) {
  checkCanDraw(*impl_);
  impl_->commands.drawIndexed(indexCount, 1, firstIndex, vertexOffset, firstInstance);
}

void Commands::draw(std::uint32_t vertexCount) {
  checkCanDraw(*impl_);
  impl_->commands.draw(vertexCount, 1, 0, 0);
}

void Commands::copyToBuffer(const Image& from, std::uint32_t firstRow, std::uint32_t rowCount, const Buffer& to,
                            std::uint64_t toOffset) {
  CL_CHECK(impl_->recording && !impl_->drawing);
  ImageImpl& image = from.impl();
  CL_CHECK_EQ(image.samples, 1u);
  CL_CHECK(image.format != ImageFormat::depth32f);
  checkRows(image.extent, firstRow, rowCount);
  checkRange(to.impl(), toOffset, std::uint64_t{pixelBytesOf(image.format)} * image.extent.width * rowCount);
  if (rowCount == 0) return;
  moveTo(*impl_, image, vk::ImageLayout::eTransferSrcOptimal, true);
  const auto region = vk::BufferImageCopy()
                          .setBufferOffset(toOffset)
                          .setImageSubresource({vk::ImageAspectFlagBits::eColor, 0, 0, 1})
                          .setImageOffset({0, static_cast<std::int32_t>(firstRow), 0})
                          .setImageExtent({image.extent.width, rowCount, 1});
  impl_->commands.copyImageToBuffer(*image.image, vk::ImageLayout::eTransferSrcOptimal, *to.impl().buffer, region);
}

}  // namespace crosslight::gpu

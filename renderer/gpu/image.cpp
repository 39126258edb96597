// Render targets.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/check.h"
#include "base/error.h"
#include "gpu/impl.h"

namespace crosslight::gpu {
namespace {

vk::ImageUsageFlags usageOf(ImageFormat format) {
  using Usage = vk::ImageUsageFlagBits;
  if (format == ImageFormat::depth32f) return Usage::eDepthStencilAttachment;
  return Usage::eColorAttachment | Usage::eTransferSrc;
}

vk::ImageAspectFlags aspectOf(ImageFormat format) {
  return format == ImageFormat::depth32f ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor;
}

void checkExtent(const DeviceImpl& device, const std::string& what, std::uint32_t width, std::uint32_t height) {
  CL_CHECK_LT(0u, width);
  CL_CHECK_LT(0u, height);
  if (std::max(width, height) <= device.info.maxImageSize) return;
  throw DeviceError(fmt::format("{} is {} x {} pixels, the limit of {} is {} x {}; render it in parts or smaller", what,
                                width, height, device.info.name, device.info.maxImageSize, device.info.maxImageSize));
}

vk::ImageCreateInfo imageInfo(const ImageImpl& image) {
  return vk::ImageCreateInfo()
      .setImageType(vk::ImageType::e2D)
      .setFormat(formatOf(image.format))
      .setExtent(vk::Extent3D(image.extent, 1))
      .setMipLevels(1)
      .setArrayLayers(1)
      .setSamples(sampleFlag(image.samples))
      .setUsage(usageOf(image.format));
}

void makeView(ImageImpl& image) {
  const auto view = vk::ImageViewCreateInfo()
                        .setImage(*image.image)
                        .setViewType(vk::ImageViewType::e2D)
                        .setFormat(formatOf(image.format))
                        .setSubresourceRange({aspectOf(image.format), 0, 1, 0, 1});
  image.view = vk::raii::ImageView(image.device->device, view);
  nameObject(*image.device, image.image, image.name);
}

void fillImage(ImageImpl& image, const std::string& what) {
  static constexpr std::array<MemoryWish, 2> kWishes{MemoryWish{vk::MemoryPropertyFlagBits::eDeviceLocal},
                                                     MemoryWish{}};
  image.image = vk::raii::Image(image.device->device, imageInfo(image));
  image.memory =
      std::make_unique<Allocation>(allocate(*image.device, what, image.image.getMemoryRequirements(), kWishes));
  image.image.bindMemory(image.memory->handle(), 0);
  makeView(image);
}

// Integers are never blended.
vk::FormatFeatureFlags needsOf(vk::Format format) {
  using Flag = vk::FormatFeatureFlagBits;
  if (format == vk::Format::eR32Uint) return Flag::eColorAttachment;
  return Flag::eColorAttachment | Flag::eColorAttachmentBlend;
}

bool canDrawLinear(const DeviceImpl& device, const vk::ImageCreateInfo& info) {
  const vk::FormatFeatureFlags needs = needsOf(info.format);
  if ((device.physical.getFormatProperties(info.format).linearTilingFeatures & needs) != needs) return false;
  try {
    const auto most = device.physical.getImageFormatProperties(info.format, info.imageType, info.tiling, info.usage);
    return info.extent.width <= most.maxExtent.width && info.extent.height <= most.maxExtent.height;
  } catch (const vk::FormatNotSupportedError&) {
    return false;
  }
}

// Whether the image's rows lie in the buffer's memory as they would in the buffer itself.
bool fitsOver(const ImageImpl& image, const BufferImpl& buffer) {
  const vk::MemoryRequirements needs = image.image.getMemoryRequirements();
  const vk::SubresourceLayout layout = image.image.getSubresourceLayout({vk::ImageAspectFlagBits::eColor, 0, 0});
  return (needs.memoryTypeBits >> buffer.memory.type() & 1u) != 0 && needs.size <= buffer.memory.sizeBytes() &&
         layout.offset == 0 && layout.rowPitch == std::uint64_t{pixelBytesOf(image.format)} * image.extent.width;
}

}  // namespace

vk::Format formatOf(ImageFormat format) {
  switch (format) {
    case ImageFormat::rgba32f:
      return vk::Format::eR32G32B32A32Sfloat;
    case ImageFormat::r32ui:
      return vk::Format::eR32Uint;
    case ImageFormat::depth32f:
      return vk::Format::eD32Sfloat;
  }
  throw InternalError("broken invariant: unknown image format");
}

std::uint32_t pixelBytesOf(ImageFormat format) { return format == ImageFormat::rgba32f ? 16 : 4; }

vk::SampleCountFlagBits sampleFlag(std::uint32_t samples) {
  // Vulkan's flag of a count is the count itself.
  return static_cast<vk::SampleCountFlagBits>(samples);
}

void checkSamples(const DeviceImpl& device, const std::string& what, std::uint32_t samples) {
  const std::vector<std::uint32_t>& counts = device.info.msaaCounts;
  if (std::find(counts.begin(), counts.end(), samples) != counts.end()) return;
  throw DeviceError(fmt::format("{} asks for {} samples per pixel; {} can do {}", what, samples, device.info.name,
                                fmt::join(counts, ", ")));
}

Image::Image(const Device& device, std::string name, ImageFormat format, std::uint32_t width, std::uint32_t height,
             std::uint32_t samples)
    : impl_(new ImageImpl{&device.impl(), std::move(name), format, {width, height}, samples}) {
  const std::string what = fmt::format("image '{}'", impl_->name);
  checkExtent(*impl_->device, what, width, height);
  checkSamples(*impl_->device, what, samples);
  guarded("making " + what, [&] { fillImage(*impl_, what); });
}

Image Image::over(const Device& device, std::string name, ImageFormat format, const Buffer& buffer, std::uint32_t width,
                  std::uint32_t height) {
  Image image;
  if (!device.info().isSoftware) return image;
  CL_CHECK_LE(std::uint64_t{pixelBytesOf(format)} * width * height, buffer.sizeBytes());
  const std::string what = fmt::format("image '{}'", name);
  Owned<ImageImpl> impl(new ImageImpl{&device.impl(), std::move(name), format, {width, height}, 1, true});
  guarded("making " + what, [&] {
    const vk::ImageCreateInfo info = imageInfo(*impl).setTiling(vk::ImageTiling::eLinear);
    if (!canDrawLinear(*impl->device, info)) return;
    impl->image = vk::raii::Image(impl->device->device, info);
    if (!fitsOver(*impl, buffer.impl())) return;
    impl->image.bindMemory(buffer.impl().memory.handle(), 0);
    makeView(*impl);
    image.impl_ = std::move(impl);
  });
  return image;
}

std::uint32_t Image::width() const { return impl_->extent.width; }
std::uint32_t Image::height() const { return impl_->extent.height; }
std::uint32_t Image::samples() const { return impl_->samples; }

template struct Release<ImageImpl>;

}  // namespace crosslight::gpu

#include "gpu/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "base/check.h"
#include "base/error.h"
#include "gpu/impl.h"

namespace crosslight::gpu {
namespace {

using Flag = vk::MemoryPropertyFlagBits;

constexpr std::uint64_t kGranularityBytes = 16;  // of a float4 texel
// Staging copies go in pieces, so that a large upload does not need its size twice.
constexpr std::uint64_t kStagingBytes = std::uint64_t{64} << 20;

vk::BufferUsageFlags usageOf(std::uint32_t use) {
  using Usage = vk::BufferUsageFlagBits;
  vk::BufferUsageFlags flags = Usage::eTransferSrc | Usage::eTransferDst;
  if (use & useStorage) flags |= Usage::eStorageBuffer;
  if (use & useUniformTexel) flags |= Usage::eUniformTexelBuffer;
  if (use & (useUniform | useUniformWindows)) flags |= Usage::eUniformBuffer;
  if (use & useVertex) flags |= Usage::eVertexBuffer;
  if (use & useIndex) flags |= Usage::eIndexBuffer;
  if (use & useIndirect) flags |= Usage::eIndirectBuffer;
  if (use & useBoxes) flags |= Usage::eAccelerationStructureBuildInputReadOnlyKHR | Usage::eShaderDeviceAddress;
  if (use & useBoxSearch)
    flags |= Usage::eAccelerationStructureStorageKHR | Usage::eStorageBuffer | Usage::eShaderDeviceAddress;
  return flags;
}

std::vector<MemoryWish> wishesOf(const DeviceImpl& device, std::uint32_t use) {
  const vk::MemoryPropertyFlags visible = Flag::eHostVisible;
  if (use & useReadback) {
    return {{visible | Flag::eHostCached | Flag::eHostCoherent}, {visible | Flag::eHostCached}, {visible}};
  }
  if (use & useHostWrite)
    return {{visible | Flag::eHostCoherent | Flag::eDeviceLocal}, {visible | Flag::eHostCoherent}};
  if (device.neverMap) return {{Flag::eDeviceLocal}, {}};
  return {{visible | Flag::eHostCoherent | Flag::eDeviceLocal, true}, {Flag::eDeviceLocal}, {}};
}

void checkSize(const DeviceImpl& device, const std::string& name, std::uint64_t bytes, std::uint32_t use) {
  const auto limit = [&](bool applies, std::uint64_t most, const char* rule) {
    if (!applies || bytes <= most) return;
    throw DeviceError(fmt::format("buffer '{}' needs {} bytes, the limit of {} is {} bytes ({})", name, bytes,
                                  device.info.name, most, rule));
  };
  const std::uint64_t texelBytes = std::uint64_t{device.limits.maxTexelBufferElements} * kGranularityBytes;
  limit((use & useStorage) != 0, device.limits.maxStorageBufferRange, "maxStorageBufferRange");
  limit((use & useUniform) != 0, device.limits.maxUniformBufferRange, "maxUniformBufferRange");
  limit((use & useUniformTexel) != 0, texelBytes, "maxTexelBufferElements of 16 bytes");
  limit(true, device.maxAllocationBytes, "maxMemoryAllocationSize");
}

// llvmpipe compiles a shader once more for texel buffers whose size is a power of two, and for those whose size has no
// bit of the second byte set, which it takes for the number of mip levels (Mesa 22.3.6, `level_zero_only`). None has
// such a size here: that of a picture or a scene does not decide whether a kernel is compiled again.
std::uint64_t blocksFor(const DeviceImpl& device, std::uint64_t sizeBytes, std::uint32_t use) {
  const std::uint64_t blocks = std::max<std::uint64_t>(1, (sizeBytes + kGranularityBytes - 1) / kGranularityBytes);
  constexpr std::uint64_t kSecondByte = 0xff00 / kGranularityBytes, kLowestOfIt = 0x100 / kGranularityBytes;
  const std::uint64_t grown = (blocks & kSecondByte) == 0 ? blocks + kLowestOfIt : blocks;
  const std::uint64_t odd = std::has_single_bit(grown) ? grown + 1 : grown;
  return (use & useUniformTexel) != 0 && odd <= device.limits.maxTexelBufferElements ? odd : blocks;
}

Owned<BufferImpl> makeBuffer(DeviceImpl& device, std::string name, std::uint64_t sizeBytes, std::uint32_t use) {
  checkSize(device, name, sizeBytes, use);
  const std::uint64_t blocks = blocksFor(device, sizeBytes, use);
  const std::string what = fmt::format("buffer '{}'", name);
  return guarded("making " + what, [&] {
    const vk::BufferCreateInfo info({}, blocks * kGranularityBytes, usageOf(use), vk::SharingMode::eExclusive);
    vk::raii::Buffer buffer(device.device, info);
    const bool hasAddress = (use & (useBoxes | useBoxSearch)) != 0;
    Allocation memory = allocate(device, what, buffer.getMemoryRequirements(), wishesOf(device, use), hasAddress);
    buffer.bindMemory(memory.handle(), 0);
    nameObject(device, buffer, name);
    return Owned<BufferImpl>(
        new BufferImpl{&device, std::move(name), sizeBytes, info.size, use, std::move(memory), std::move(buffer)});
  });
}

Owned<BufferImpl> makeStaging(const BufferImpl& target, std::uint64_t bytes, std::uint32_t use) {
  return makeBuffer(*target.device, target.name + " (staging)", std::min(bytes, kStagingBytes), use);
}

void copyNow(const BufferImpl& from, std::uint64_t fromOffset, const BufferImpl& to, std::uint64_t toOffset,
             std::uint64_t bytes) {
  runOnce(*from.device, fmt::format("copying '{}' to '{}'", from.name, to.name), [&](const auto& commands) {
    commands.copyBuffer(*from.buffer, *to.buffer, vk::BufferCopy(fromOffset, toOffset, bytes));
  });
}

void writeStaged(const BufferImpl& buffer, std::uint64_t offset, std::span<const std::byte> bytes) {
  const Owned<BufferImpl> staging = makeStaging(buffer, bytes.size(), useHostWrite);
  for (std::uint64_t done = 0; done < bytes.size(); done += staging->sizeBytes) {
    const std::uint64_t piece = std::min<std::uint64_t>(staging->sizeBytes, bytes.size() - done);
    std::memcpy(staging->memory.mapped(), bytes.data() + done, piece);
    staging->memory.flush();
    copyNow(*staging, 0, buffer, offset + done, piece);
  }
}

void readStaged(const BufferImpl& buffer, std::uint64_t offset, std::span<std::byte> bytes) {
  const Owned<BufferImpl> staging = makeStaging(buffer, bytes.size(), useReadback);
  for (std::uint64_t done = 0; done < bytes.size(); done += staging->sizeBytes) {
    const std::uint64_t piece = std::min<std::uint64_t>(staging->sizeBytes, bytes.size() - done);
    copyNow(buffer, offset + done, *staging, 0, piece);
    staging->memory.invalidate();
    std::memcpy(bytes.data() + done, staging->memory.mapped(), piece);
  }
}

}  // namespace

Buffer::Buffer(const Device& device, std::string name, std::uint64_t sizeBytes, std::uint32_t use)
    : impl_(makeBuffer(device.impl(), std::move(name), sizeBytes, use)) {}

Buffer::Buffer(const Device& device, std::string name, std::span<const std::byte> contents, std::uint32_t use)
    : Buffer(device, std::move(name), contents.size(), use) {
  write(0, contents);
}

std::uint64_t Buffer::sizeBytes() const { return impl_->sizeBytes; }

void Buffer::write(std::uint64_t offset, std::span<const std::byte> bytes) {
  checkRange(*impl_, offset, bytes.size());
  if (bytes.empty()) return;
  guarded("writing buffer '" + impl_->name + "'", [&] {
    if (impl_->memory.mapped() == nullptr) return writeStaged(*impl_, offset, bytes);
    std::memcpy(impl_->memory.mapped() + offset, bytes.data(), bytes.size());
    impl_->memory.flush();
  });
}

void Buffer::read(std::uint64_t offset, std::span<std::byte> bytes) const {
  checkRange(*impl_, offset, bytes.size());
  if (bytes.empty()) return;
  guarded("reading buffer '" + impl_->name + "'", [&] {
    // Without a host cache every load crosses the bus by itself; one copy to cached memory costs less.
    if (impl_->memory.mapped() == nullptr || !impl_->memory.cached()) return readStaged(*impl_, offset, bytes);
    impl_->memory.invalidate();
    std::memcpy(bytes.data(), impl_->memory.mapped() + offset, bytes.size());
  });
}

template struct Release<BufferImpl>;

}  // namespace crosslight::gpu

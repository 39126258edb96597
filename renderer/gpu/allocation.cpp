// Device memory: which type a resource gets, and the count of what is allocated.
#include <fmt/format.h>

#include <algorithm>

#include "base/check.h"
#include "base/error.h"
#include "gpu/impl.h"

namespace crosslight::gpu {
namespace {

std::uint64_t largestLocalHeap(const vk::PhysicalDeviceMemoryProperties& memory) {
  std::uint64_t largest = 0;
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal) {
      largest = std::max<std::uint64_t>(largest, memory.memoryHeaps[i].size);
    }
  }
  return largest;
}

bool fits(const DeviceImpl& device, std::uint32_t type, const vk::MemoryRequirements& needs, const MemoryWish& wish) {
  const vk::MemoryType& offered = device.memory.memoryTypes[type];
  const std::uint64_t heapBytes = device.memory.memoryHeaps[offered.heapIndex].size;
  if ((needs.memoryTypeBits & (1u << type)) == 0 || (offered.propertyFlags & wish.flags) != wish.flags) return false;
  if (needs.size > heapBytes) return false;
  // Without resizable BAR the window into device memory is a 256 MiB heap of its own: too small for scenes.
  return !wish.largeHeapOnly || 2 * heapBytes >= largestLocalHeap(device.memory);
}

std::uint64_t largestHeap(const DeviceImpl& device) {
  std::uint64_t largest = 0;
  for (std::uint32_t i = 0; i < device.memory.memoryHeapCount; ++i) {
    largest = std::max<std::uint64_t>(largest, device.memory.memoryHeaps[i].size);
  }
  return largest;
}

}  // namespace

Allocation allocate(DeviceImpl& device, const std::string& what, const vk::MemoryRequirements& needs,
                    std::span<const MemoryWish> wishes, bool hasAddress) {
  if (needs.size > device.maxAllocationBytes || needs.size > largestHeap(device)) {
    throw DeviceError(fmt::format("{} needs {} bytes of memory, the limit of {} is {} bytes", what, needs.size,
                                  device.info.name, std::min(device.maxAllocationBytes, largestHeap(device))));
  }
  for (const MemoryWish& wish : wishes) {
    for (std::uint32_t type = 0; type < device.memory.memoryTypeCount; ++type) {
      if (!fits(device, type, needs, wish)) continue;
      try {
        const vk::MemoryAllocateFlagsInfo addressed(vk::MemoryAllocateFlagBits::eDeviceAddress);
        const vk::MemoryAllocateInfo info(needs.size, type, hasAddress ? &addressed : nullptr);
        vk::raii::DeviceMemory memory(device.device, info);
        return Allocation(device, std::move(memory), needs.size, type,
                          bool(wish.flags & vk::MemoryPropertyFlagBits::eHostVisible));
      } catch (const vk::OutOfDeviceMemoryError&) {
        continue;  // another heap may still have room
      } catch (const vk::OutOfHostMemoryError&) {
        continue;
      }
    }
  }
  throw DeviceError(
      fmt::format("{} needs {} bytes of memory, and {} has not enough left ({} bytes of it are in use here)", what,
                  needs.size, device.info.name, device.allocatedBytes));
}

Allocation::Allocation(DeviceImpl& device, vk::raii::DeviceMemory memory, std::uint64_t sizeBytes, std::uint32_t type,
                       bool map)
    : device_(&device),
      memory_(std::move(memory)),
      sizeBytes_(sizeBytes),
      type_(type),
      flags_(device.memory.memoryTypes[type].propertyFlags) {
  if (map) mapped_ = static_cast<std::byte*>(memory_.mapMemory(0, VK_WHOLE_SIZE));
  device.allocatedBytes += sizeBytes;
  device.peakAllocatedBytes = std::max(device.peakAllocatedBytes, device.allocatedBytes);
}

Allocation::Allocation(Allocation&& other) noexcept
    : device_(std::exchange(other.device_, nullptr)),
      memory_(std::move(other.memory_)),
      sizeBytes_(other.sizeBytes_),
      type_(other.type_),
      flags_(other.flags_),
      mapped_(other.mapped_) {}

Allocation::~Allocation() {
  if (device_ != nullptr) device_->allocatedBytes -= sizeBytes_;
}

void Allocation::flush() const {
  if (coherent()) return;
  device_->device.flushMappedMemoryRanges(vk::MappedMemoryRange(*memory_, 0, VK_WHOLE_SIZE));
}

void Allocation::invalidate() const {
  if (coherent()) return;
  device_->device.invalidateMappedMemoryRanges(vk::MappedMemoryRange(*memory_, 0, VK_WHOLE_SIZE));
}

}  // namespace crosslight::gpu

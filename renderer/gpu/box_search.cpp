#include "gpu/box_search.h"

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "gpu/impl.h"

namespace crosslight::gpu {
namespace {

using Level = BoxSearchImpl::Level;
using Sizes = vk::AccelerationStructureBuildSizesInfoKHR;

constexpr std::uint64_t kInstanceAlignment = 16;  // of VkAccelerationStructureInstanceKHR (Vulkan 1.3, VUID 03715)

vk::DeviceAddress addressOf(const Device& device, const Buffer& buffer) {
  return device.impl().device.getBufferAddress(vk::BufferDeviceAddressInfo(*buffer.impl().buffer));
}

struct DeviceLimits {
  std::uint64_t boxes;
  std::uint64_t scratchAlignment;
};
DeviceLimits limitsOf(const DeviceImpl& device) {
  const auto chain =
      device.physical
          .getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceAccelerationStructurePropertiesKHR>();
  const auto& p = chain.get<vk::PhysicalDeviceAccelerationStructurePropertiesKHR>();
  return {p.maxPrimitiveCount, p.minAccelerationStructureScratchOffsetAlignment};
}

// Makes a level and fills it: from the geometry, `count` of what that holds.
Level build(const Device& device, const std::string& name, vk::AccelerationStructureTypeKHR type,
            const vk::AccelerationStructureGeometryKHR& geometry, std::uint32_t count) {
  DeviceImpl& impl = device.impl();
  auto info = vk::AccelerationStructureBuildGeometryInfoKHR()
                  .setType(type)
                  .setFlags(vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace)
                  .setMode(vk::BuildAccelerationStructureModeKHR::eBuild)
                  .setGeometries(geometry);
  const Sizes sizes =
      impl.device.getAccelerationStructureBuildSizesKHR(vk::AccelerationStructureBuildTypeKHR::eDevice, info, count);
  Level level;
  level.memory = Buffer(device, name, sizes.accelerationStructureSize, useBoxSearch);
  const vk::AccelerationStructureCreateInfoKHR made({}, *level.memory.impl().buffer, 0, sizes.accelerationStructureSize,
                                                    type);
  level.structure = vk::raii::AccelerationStructureKHR(impl.device, made);
  nameObject(impl, level.structure, name);
  const std::uint64_t alignment = limitsOf(impl).scratchAlignment;
  const Buffer scratch(device, name + " (while it is built)", sizes.buildScratchSize + alignment, useBoxSearch);
  const vk::DeviceAddress begin = (addressOf(device, scratch) + alignment - 1) / alignment * alignment;
  info.setDstAccelerationStructure(*level.structure).setScratchData(begin);
  const vk::AccelerationStructureBuildRangeInfoKHR range(count);
  runOnce(impl, "building " + name,
          [&](const vk::raii::CommandBuffer& commands) { commands.buildAccelerationStructuresKHR(info, &range); });
  return level;
}

Level buildBoxes(const Device& device, const std::string& name, const Buffer& boxes, std::uint32_t count) {
  const vk::AccelerationStructureGeometryAabbsDataKHR data(addressOf(device, boxes), sizeof(SearchBox));
  // Light is multiplied by what each surface lets pass: each may be asked but once.
  const vk::AccelerationStructureGeometryKHR geometry(vk::GeometryTypeKHR::eAabbs, data,
                                                      vk::GeometryFlagBitsKHR::eNoDuplicateAnyHitInvocation);
  return build(device, name, vk::AccelerationStructureTypeKHR::eBottomLevel, geometry, count);
}

Level buildTop(const Device& device, const std::string& name, const Level& boxes) {
  vk::AccelerationStructureInstanceKHR instance;
  instance.transform.matrix[0][0] = instance.transform.matrix[1][1] = instance.transform.matrix[2][2] = 1.0f;
  instance.mask = 0xff;
  const bool any = *boxes.structure != vk::AccelerationStructureKHR();
  if (any) {
    instance.accelerationStructureReference = device.impl().device.getAccelerationStructureAddressKHR(
        vk::AccelerationStructureDeviceAddressInfoKHR(*boxes.structure));
  }
  const Buffer instances(device, name + " (instance)", std::as_bytes(std::span(&instance, 1)), useBoxes);
  CL_CHECK_EQ(addressOf(device, instances) % kInstanceAlignment, 0u);
  const vk::AccelerationStructureGeometryInstancesDataKHR data(VK_FALSE, addressOf(device, instances));
  const vk::AccelerationStructureGeometryKHR geometry(vk::GeometryTypeKHR::eInstances, data);
  return build(device, name, vk::AccelerationStructureTypeKHR::eTopLevel, geometry, any ? 1u : 0u);
}

}  // namespace

BoxSearch::BoxSearch(const Device& device, const std::string& name, const Buffer& boxes, std::uint32_t count)
    : impl_(new BoxSearchImpl{&device.impl(), {}, {}}) {
  const DeviceInfo& info = device.info();
  if (!info.rayQueryLacks.empty())
    throw DeviceError(fmt::format("'{}' cannot search boxes itself: it lacks {}", info.name, info.rayQueryLacks));
  const std::uint64_t most = limitsOf(device.impl()).boxes;
  if (count > most) {
    throw DeviceError(
        fmt::format("{} has {} boxes, '{}' searches at most {} (maxPrimitiveCount)", name, count, info.name, most));
  }
  CL_CHECK_LE(std::uint64_t{count} * sizeof(SearchBox), boxes.sizeBytes());
  guarded("building " + name, [&] {
    if (count > 0) impl_->boxes = buildBoxes(device, name, boxes, count);
    impl_->top = buildTop(device, name + " (top)", impl_->boxes);
  });
}

std::uint64_t BoxSearch::sizeBytes() const {
  const std::uint64_t boxes = impl_->boxes.memory ? impl_->boxes.memory.sizeBytes() : 0;
  return boxes + impl_->top.memory.sizeBytes();
}

template struct Release<BoxSearchImpl>;

}  // namespace crosslight::gpu

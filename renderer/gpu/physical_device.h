// What the driver says about each device, and whether this renderer can run on it. Private to this room.
#pragma once

#include <vector>

#include "gpu/impl.h"

namespace crosslight::gpu {

struct Candidate {
  vk::raii::PhysicalDevice physical;
  DeviceReport report;
  std::uint32_t queueFamily = 0;  // graphics and compute; only for a usable device
  std::uint32_t timestampBits = 0;
};

std::vector<Candidate> candidatesOf(const vk::raii::Instance& instance);

// Every feature that a usable device must have, for vkCreateDevice, and the optional ones that DeviceInfo says it has.
using FeatureChain =
    vk::StructureChain<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                       vk::PhysicalDeviceVulkan13Features, vk::PhysicalDeviceAccelerationStructureFeaturesKHR,
                       vk::PhysicalDeviceRayQueryFeaturesKHR>;
FeatureChain wantedFeatures(const DeviceInfo& info);
std::vector<const char*> wantedExtensions(const DeviceInfo& info);

}  // namespace crosslight::gpu

// Which of the listed devices a selector means. Private to this room; knows no Vulkan, so that it can be tested
// anywhere.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "gpu/device.h"

namespace crosslight::gpu {

// Position in `reports`; DeviceError that lists all devices, or the refusals of those that match. See DeviceOptions.
std::size_t chooseDevice(std::span<const DeviceReport> reports, const std::string& selector);

}  // namespace crosslight::gpu

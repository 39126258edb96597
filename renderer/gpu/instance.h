// The Vulkan instance, with or without validation. Private to this room.
#pragma once

#include "gpu/impl.h"

namespace crosslight::gpu {

// False when there is no Vulkan driver at all. DeviceError when validation is asked for and its layer is missing.
bool createInstance(DeviceImpl& device);

}  // namespace crosslight::gpu

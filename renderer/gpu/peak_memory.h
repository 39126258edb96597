// For measurements of several renders on one device: what each takes by itself.
#pragma once

#include "gpu/device.h"

namespace crosslight::gpu {

// Device::peakAllocatedBytes() begins anew, at what is allocated now.
void forgetPeakMemory(const Device& device);

}  // namespace crosslight::gpu

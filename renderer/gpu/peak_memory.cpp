#include "gpu/peak_memory.h"

#include "gpu/impl.h"

namespace crosslight::gpu {

void forgetPeakMemory(const Device& device) { device.impl().peakAllocatedBytes = device.impl().allocatedBytes; }

}  // namespace crosslight::gpu

// Boxes that shaders search along a ray by the device's own means: an acceleration structure of Vulkan with procedural
// geometry. Which of the boxes that a ray meets counts, the shader decides (VK_KHR_ray_query).
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "gpu/memory.h"

namespace crosslight::gpu {

// As Vulkan has it: VkAabbPositionsKHR.
struct SearchBox {
  float lower[3];
  float upper[3];
};

struct BoxSearchImpl;
class BoxSearch {
 public:
  BoxSearch() = default;
  // `boxes`: SearchBox[count] with useBoxes; may go afterwards. A box's number is its place in it. DeviceError where
  // the device has no ray queries (DeviceInfo::rayQueryLacks), or not for so many.
  BoxSearch(const Device& device, const std::string& name, const Buffer& boxes, std::uint32_t count);
  explicit operator bool() const { return impl_ != nullptr; }
  std::uint64_t sizeBytes() const;
  BoxSearchImpl& impl() const { return *impl_; }

 private:
  Owned<BoxSearchImpl> impl_;
};

}  // namespace crosslight::gpu

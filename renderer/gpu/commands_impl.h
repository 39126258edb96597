// What one batch of commands keeps while it is recorded and run. Private to this room.
#pragma once

#include <utility>
#include <vector>

#include "gpu/span_timer.h"

namespace crosslight::gpu {

struct CommandsImpl {
  DeviceImpl* device;
  vk::raii::CommandPool pool{nullptr};
  vk::raii::CommandBuffer commands{nullptr};
  vk::raii::Fence fence{nullptr};
  SpanTimer timer = {};
  // Layouts that images will have once this batch has run; they become the images' own at the submit.
  std::vector<std::pair<ImageImpl*, vk::ImageLayout>> layouts = {};
  SharedLayout bound = nullptr;
  const PipelineImpl* pipeline = nullptr;
  bool recording = false;
  bool drawing = false;  // between beginRendering and endRendering
  vk::Extent2D targetExtent = {};
  std::uint32_t targetSamples = 1;
  bool targetHasColor = false, targetHasDepth = false;
  ImageFormat targetColorFormat = ImageFormat::rgba32f;
  double submitToIdleMs = 0;
};

}  // namespace crosslight::gpu

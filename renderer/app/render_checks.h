// What is refused before anything is allocated: settings that make no sense, a device that lacks what they need, and
// pictures that do not fit into memory.
#pragma once

#include <cstdint>
#include <string>

#include "app/render_session.h"

namespace crosslight {

void checkSettings(const Scene& scene, const RenderSettings& settings);
void checkAgainstDevice(const gpu::DeviceInfo& info, const RenderSettings& settings);

// Bytes that a render takes beyond those of its loaded scene. Those of the picture shrink with the rows that are drawn.
struct MemoryNeed {
  std::uint64_t hostPictureBytes = 0;    // the image, and its file while that is made
  std::uint64_t hostSceneBytes = 0;      // flattened scene and trees; where memory is shared, beyond the device's
  std::uint64_t devicePictureBytes = 0;  // film, render targets, ray store
  std::uint64_t deviceSceneBytes = 0;
};
// `trianglesSaved`: those that need no place in a tree because instances share one.
MemoryNeed memoryNeedOf(const gpu::DeviceInfo& info, const RenderRequest& request, std::uint64_t trianglesSaved = 0);

// DeviceError with the figures where a list of the scene is longer than shaders of the device can read.
void checkLists(const gpu::DeviceInfo& info, const RenderRequest& request, std::uint64_t trianglesSaved = 0);

struct MemoryLimits {
  std::uint64_t hostBytes = 0;    // that can be had now
  std::uint64_t deviceBytes = 0;  // of the device's largest heap
  bool shared = false;            // the device computes on the CPU: its memory is the host's
};
MemoryLimits memoryLimitsOf(const gpu::DeviceInfo& info);

// DeviceError with the figures and what to do.
void checkMemory(const MemoryNeed& need, const MemoryLimits& limits, const RenderSettings& settings);

// "3.2 GiB"
std::string inGiB(std::uint64_t bytes);
// What /proc/meminfo says is available, or less where the process is confined; the largest number if nobody tells.
std::uint64_t availableHostBytes();

}  // namespace crosslight

// SPIR-V of a fragment shader whose inputs are interpolated where each sample lies. Private to this room.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace crosslight::gpu {

// The module with the decoration Sample on every interpolated input. Vulkan has inputs taken at the samples wherever
// sample shading is on; Mesa 22.3's lavapipe does so only for inputs that say it themselves.
std::vector<std::uint32_t> withSampleInputs(std::span<const std::uint32_t> module);

}  // namespace crosslight::gpu

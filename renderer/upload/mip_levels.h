// Smaller levels of a texture: means over areas, in linear light.
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

namespace crosslight {

// Appends levels 1 and on of the level that `texels` holds from `first` on, down to one texel. A level is half as wide
// and high as the one before, rounded down, at least 1; a texel is the mean of what it covers, parts of texels
// included.
void appendMipLevels(std::vector<glm::vec4>& texels, std::size_t first, std::uint32_t width, std::uint32_t height);

}  // namespace crosslight

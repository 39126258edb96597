// PNG without compression: the same bytes with every version of every library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace crosslight::scenegen {

// 8 bits per channel, `channels` 1 (gray), 3 (RGB) or 4 (RGBA); `pixel` fills one pixel's channels.
std::vector<std::byte> makePng(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
                               const std::function<void(std::uint32_t x, std::uint32_t y, std::uint8_t* out)>& pixel);

}  // namespace crosslight::scenegen

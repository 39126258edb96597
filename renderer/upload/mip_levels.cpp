#include "upload/mip_levels.h"

#include <algorithm>
#include <cmath>

namespace crosslight {
namespace {

// What one of `count` equal parts of a row of `length` texels covers: two or three of them, or the only one.
struct Cover {
  std::uint32_t begin = 0, count = 0;
  double weights[3] = {};
};

Cover coverOf(std::uint32_t part, std::uint32_t count, std::uint32_t length) {
  const double width = static_cast<double>(length) / count;
  const double low = part * width, high = low + width;
  Cover cover{.begin = static_cast<std::uint32_t>(low)};
  for (std::uint32_t i = cover.begin; i < length && i < high && cover.count < 3; ++i) {
    const double overlap = std::min(high, i + 1.0) - std::max(low, static_cast<double>(i));
    cover.weights[cover.count++] = overlap / width;
  }
  return cover;
}

struct Level {
  std::size_t first;
  std::uint32_t width, height;
};

glm::vec4 meanOf(const std::vector<glm::vec4>& texels, const Level& level, const Cover& x, const Cover& y) {
  glm::dvec4 sum(0.0);
  for (std::uint32_t j = 0; j < y.count; ++j) {
    const std::size_t row = level.first + std::size_t{y.begin + j} * level.width + x.begin;
    for (std::uint32_t i = 0; i < x.count; ++i) sum += glm::dvec4(texels[row + i]) * (y.weights[j] * x.weights[i]);
  }
  return glm::vec4(sum);
}

}  // namespace

void appendMipLevels(std::vector<glm::vec4>& texels, std::size_t first, std::uint32_t width, std::uint32_t height) {
  Level level{first, width, height};
  while (level.width > 1 || level.height > 1) {
    const Level next{texels.size(), std::max(level.width / 2, 1u), std::max(level.height / 2, 1u)};
    for (std::uint32_t y = 0; y < next.height; ++y) {
      const Cover rows = coverOf(y, next.height, level.height);
      for (std::uint32_t x = 0; x < next.width; ++x)
        texels.push_back(meanOf(texels, level, coverOf(x, next.width, level.width), rows));
    }
    level = next;
  }
}

}  // namespace crosslight

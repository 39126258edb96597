#include "scenegen/radiance_picture.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace crosslight::scenegen {

std::vector<std::byte> radiancePicture(int width, int height, const std::function<glm::dvec3(int x, int y)>& pixel) {
  const std::string head =
      "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
  std::vector<std::byte> bytes;
  for (const char c : head) bytes.push_back(static_cast<std::byte>(c));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::dvec3 c = pixel(x, y);
      int exponent = 0;
      std::frexp(std::max({c.r, c.g, c.b, 1e-30}), &exponent);
      for (int i = 0; i < 3; ++i)
        bytes.push_back(static_cast<std::byte>(static_cast<int>(std::ldexp(c[i], 8 - exponent))));
      bytes.push_back(static_cast<std::byte>(exponent + 128));
    }
  }
  return bytes;
}

}  // namespace crosslight::scenegen

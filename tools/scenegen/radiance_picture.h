// Environment maps as .hdr files.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

namespace crosslight::scenegen {

// Radiance's RGBE (Ward 1991, "Real Pixels"), pixels as they are.
std::vector<std::byte> radiancePicture(int width, int height, const std::function<glm::dvec3(int x, int y)>& pixel);

}  // namespace crosslight::scenegen

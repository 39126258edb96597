// Draws a scene with POV-Ray 3.7 as an oracle that shares no line with ours: its objects, lights, finishes, media and
// fog. Scenes of analytic shapes and flat triangles, classic materials and lights, as far as POV-Ray can say the same.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "scene/scene.h"

namespace crosslight::testing {

struct PovraySettings {
  std::uint32_t width = 0, height = 0;
  std::uint32_t maxDepth = 5;  // generations of secondary rays
  bool shadows = true;
};

bool havePovray();

// Camera 0 looks. Linear colors, rows from the top. Throws std::runtime_error where the scene holds what POV-Ray has no
// word for, or POV-Ray fails.
std::vector<std::array<float, 3>> drawPovray(const Scene& scene, const PovraySettings& settings,
                                             const std::filesystem::path& scratch);

}  // namespace crosslight::testing

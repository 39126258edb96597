// Draws a scene's triangles with OpenGL 1.x's own lighting (OSMesa), as an oracle that shares no line with ours: its
// transforms, lights, clamping and interpolation are Mesa's. Classic materials and lights only.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace crosslight::testing {

struct FixedFunctionSettings {
  std::uint32_t width = 0, height = 0;
  bool flat = false;         // GL_FLAT, the color of the last vertex; else GL_SMOOTH
  bool localViewer = true;   // GL_LIGHT_MODEL_LOCAL_VIEWER
  bool clampColors = false;  // GL_CLAMP_VERTEX_COLOR and GL_CLAMP_FRAGMENT_COLOR
};

// Rows from the top. Triangles are numbered in the order of the scene's instances and their primitives.
struct FixedFunctionImage {
  std::vector<std::array<float, 4>> color;
  std::vector<std::uint32_t> triangle;  // kNoTriangle where nothing was drawn
};
constexpr std::uint32_t kNoTriangle = 0xffffffu;  // 24 bits are what three color bytes hold

// Camera 0 looks, through the scene's fog. Throws std::runtime_error when OSMesa cannot do it or reports an error.
FixedFunctionImage drawFixedFunction(const Scene& scene, const FixedFunctionSettings& settings);

}  // namespace crosslight::testing

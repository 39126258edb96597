// Which shaders a raster method is made of.
#pragma once

#include <string_view>

#include "scene/settings.h"

namespace crosslight {

struct MethodShaders {
  std::string_view vertex;
  std::string_view fragment;
  std::string_view aovFragment;  // records AOVs instead of a color
};

MethodShaders shadersOf(const RenderSettings& settings);

}  // namespace crosslight

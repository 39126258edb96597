// Which shaders a raster method is made of, and what its stages pass on.
#pragma once

#include <cstdint>
#include <string_view>

#include "effects/effects.h"
#include "scene/settings.h"

namespace crosslight {

struct MethodShaders {
  std::string_view vertex;
  std::string_view fragment;
  std::string_view aovFragment;     // records AOVs instead of a color
  std::string_view layersFragment;  // keeps the color in a list; none: everything is opaque
};

// `codes`: as a display's codes (canDrawCodes).
MethodShaders shadersOf(const RenderSettings& settings, bool codes);
std::string_view backgroundShader(bool codes);

// Bits shared::kVarying* that the method's picture needs; its AOVs need all.
std::uint32_t varyingsOf(const RenderSettings& settings, const Plan& plan);
// Those of a depth pass: what an alpha mask reads.
std::uint32_t depthVaryingsOf(const Plan& plan);

}  // namespace crosslight

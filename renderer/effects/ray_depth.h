// How many segments a ray tree of this scene can have at all: what was asked for beyond that changes nothing.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "effects/uses.h"

namespace crosslight {

struct RayDepth {
  std::uint32_t most = 0;  // at most RenderSettings::maxDepth
  std::string reason;
};

RayDepth usableDepth(const Scene& scene, const RenderSettings& settings, const std::vector<SurfaceUse>& uses);

}  // namespace crosslight

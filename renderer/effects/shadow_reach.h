// Lights whose shadow rays can find nothing: no obstacle lies between them and any surface that they light.
#pragma once

#include <vector>

#include "effects/effects.h"
#include "effects/uses.h"

namespace crosslight {

// Per light of the scene. Of methods that send shadow rays; others have their own reasons.
std::vector<LightVerdict> shadowsOfLights(const Scene& scene, const RenderSettings& settings,
                                          const std::vector<SurfaceUse>& uses);

}  // namespace crosslight

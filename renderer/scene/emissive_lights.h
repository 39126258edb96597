// Surfaces that glow as lights: each of their triangles is one.
#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace crosslight {

// More cost too much time at every point: each is integrated at each.
inline constexpr std::size_t kMostEmissiveLights = 64;

// Appends lights of type areaTriangle, those of the largest power if there are more than `most`; what is left out is
// said in a warning. Materials of one side radiate from their front. How many were added.
std::size_t addEmissiveLights(Scene& scene, std::size_t most = kMostEmissiveLights);

}  // namespace crosslight

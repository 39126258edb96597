// What a method does not show of a scene's materials, named: sentences for warnings.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/settings.h"

namespace crosslight {

std::vector<std::string> approximationsOf(const Scene& scene, const RenderSettings& settings);

}  // namespace crosslight

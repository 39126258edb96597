// Tables of what microfacet lobes reflect in all, for energy compensation and sheen: layout in
// shaders/illum/albedo.glsl.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "scene/scene.h"
#include "scene/settings.h"

namespace crosslight {

// Somebody reads them.
bool needsAlbedoTables(const Scene& scene, const RenderSettings& settings);

// size * size texels. Integrated by every process that needs them: no file to keep, no fit to trust.
std::vector<glm::vec4> makeAlbedoTables(int size);

}  // namespace crosslight

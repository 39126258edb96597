// The classic material table of OpenGL's teapots (Mark Kilgard 1994, "teapots.c"; Red Book plate 17), as the lecture
// has it. Alpha is left out: all are opaque.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "scene/scene.h"

namespace crosslight {

struct MaterialPreset {
  std::string_view name;  // camelCase: brass, polishedGold, ...
  glm::vec3 ambient, diffuse, specular;
  float shininess;
};

std::span<const MaterialPreset> materialPresets();
std::optional<MaterialPreset> findMaterialPreset(std::string_view name);

}  // namespace crosslight

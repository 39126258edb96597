// Lights of all types, and what fills the scene: ambient light, an environment, fog, smoke.
#pragma once

#include <string>
#include "scenegen/dice.h"

#include "scenegen/gltf_builder.h"

namespace crosslight::scenegen {

// None to three, or twenty.
void addRandomLights(GltfBuilder& gltf, Dice& dice, bool many);
void addRandomAir(GltfBuilder& gltf, Dice& dice, const std::string& name);

}  // namespace crosslight::scenegen

// The figures of a material that make it call for an effect.
#pragma once

#include <string>

#include "bindings.h"
#include "scene/scene.h"

namespace crosslight {

// "transmission 1, ior 1.5"; empty where the effect's name says all.
std::string detailsOf(Effect effect, const Material& material);

}  // namespace crosslight

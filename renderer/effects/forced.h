// Effects that the user forces, by the names of the lists in shaders/shared/: compiled in though nothing calls for
// them, or left out though something does.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/settings.h"

namespace crosslight {

// Every name that a plan has a verdict on: models, light types, shape kinds, effects; in the order of the lists.
std::vector<std::string> effectNames();

// What the settings say of one of them; the last word counts.
std::optional<bool> forcedState(const RenderSettings& settings, const std::string& name);

// Bits of Plan::effects that the settings force on.
std::uint64_t forcedOnEffects(const RenderSettings& settings);

// With the switches off that stand for effects forced off. What has no switch the plan leaves out by itself.
RenderSettings withForcedSwitches(RenderSettings settings);

}  // namespace crosslight

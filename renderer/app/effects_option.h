// The words of --effects: what is compiled and run.
#pragma once

#include <string>

#include "scene/settings.h"

namespace crosslight {

// "auto", "all", or a list such as "-fog,+shadows" or "all,-fog". UsageError names what is meant by a misspelled one.
void applyEffects(const std::string& text, RenderSettings& settings);

// For help and completion.
std::string effectsExplained();

// "-fog", as it was forced.
std::string wordOf(const ForcedEffect& forced);

}  // namespace crosslight

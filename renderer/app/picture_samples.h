// From what the user asks for to where a picture's samples lie, and that in words.
#pragma once

#include <string>
#include <vector>

#include "film/sample_pattern.h"
#include "scene/settings.h"

namespace crosslight {

std::vector<PixelSample> samplesOf(const RenderSettings& settings);
std::string describeSamples(const RenderSettings& settings);
// A grid of so many samples is far from square: what would be better. Empty where it is not.
std::string adviceOnSamples(const RenderSettings& settings);

}  // namespace crosslight

// The classic material table as data. The eight metals carry the lecture's numbers; its exponent column is the
// original's shininess times 128.
#include "scene/material_table.h"

#include <algorithm>
#include <array>

namespace crosslight {
namespace {

constexpr glm::vec3 grey(float value) { return glm::vec3(value); }

const std::array<MaterialPreset, 29> kPresets = {{
    // The lecture's metals.
    {"brass",
     {0.329412f, 0.223529f, 0.027451f},
     {0.780392f, 0.568627f, 0.113725f},
     {0.992157f, 0.941176f, 0.807843f},
     27.8974f},
    {"bronze", {0.2125f, 0.1275f, 0.054f}, {0.714f, 0.4284f, 0.18144f}, {0.393548f, 0.271906f, 0.166721f}, 25.6f},
    {"polishedBronze", {0.25f, 0.148f, 0.06475f}, {0.4f, 0.2368f, 0.1036f}, {0.774597f, 0.458561f, 0.200621f}, 76.8f},
    {"chrome", grey(0.25f), grey(0.4f), grey(0.774597f), 76.8f},
    {"copper", {0.19125f, 0.0735f, 0.0225f}, {0.7038f, 0.27048f, 0.0828f}, {0.256777f, 0.137622f, 0.086014f}, 12.8f},
    {"polishedCopper",
     {0.2295f, 0.08825f, 0.0275f},
     {0.5508f, 0.2118f, 0.066f},
     {0.580594f, 0.223257f, 0.0695701f},
     51.2f},
    {"gold", {0.24725f, 0.1995f, 0.0745f}, {0.75164f, 0.60648f, 0.22648f}, {0.628281f, 0.555802f, 0.366065f}, 51.2f},
    {"polishedGold",
     {0.24725f, 0.2245f, 0.0645f},
     {0.34615f, 0.3143f, 0.0903f},
     {0.797357f, 0.723991f, 0.208006f},
     83.2f},
    // Further metals of the original.
    {"silver", grey(0.19225f), grey(0.50754f), grey(0.508273f), 51.2f},
    {"polishedSilver", grey(0.23125f), grey(0.2775f), grey(0.773911f), 89.6f},
    {"pewter",
     {0.105882f, 0.058824f, 0.113725f},
     {0.427451f, 0.470588f, 0.541176f},
     {0.333333f, 0.333333f, 0.521569f},
     9.84615f},
    // Stones.
    {"emerald", {0.0215f, 0.1745f, 0.0215f}, {0.07568f, 0.61424f, 0.07568f}, {0.633f, 0.727811f, 0.633f}, 76.8f},
    {"jade", {0.135f, 0.2225f, 0.1575f}, {0.54f, 0.89f, 0.63f}, grey(0.316228f), 12.8f},
    {"obsidian", {0.05375f, 0.05f, 0.06625f}, {0.18275f, 0.17f, 0.22525f}, {0.332741f, 0.328634f, 0.346435f}, 38.4f},
    {"pearl", {0.25f, 0.20725f, 0.20725f}, {1.0f, 0.829f, 0.829f}, grey(0.296648f), 11.264f},
    {"ruby", {0.1745f, 0.01175f, 0.01175f}, {0.61424f, 0.04136f, 0.04136f}, {0.727811f, 0.626959f, 0.626959f}, 76.8f},
    {"turquoise", {0.1f, 0.18725f, 0.1745f}, {0.396f, 0.74151f, 0.69102f}, {0.297254f, 0.30829f, 0.306678f}, 12.8f},
    // Plastics: shininess 0.25.
    {"blackPlastic", grey(0.0f), grey(0.01f), grey(0.5f), 32.0f},
    {"cyanPlastic", {0.0f, 0.1f, 0.06f}, {0.0f, 0.50980392f, 0.50980392f}, grey(0.50196078f), 32.0f},
    {"greenPlastic", grey(0.0f), {0.1f, 0.35f, 0.1f}, {0.45f, 0.55f, 0.45f}, 32.0f},
    {"redPlastic", grey(0.0f), {0.5f, 0.0f, 0.0f}, {0.7f, 0.6f, 0.6f}, 32.0f},
    {"whitePlastic", grey(0.0f), grey(0.55f), grey(0.7f), 32.0f},
    {"yellowPlastic", grey(0.0f), {0.5f, 0.5f, 0.0f}, {0.6f, 0.6f, 0.5f}, 32.0f},
    // Rubbers: shininess 0.078125.
    {"blackRubber", grey(0.02f), grey(0.01f), grey(0.4f), 10.0f},
    {"cyanRubber", {0.0f, 0.05f, 0.05f}, {0.4f, 0.5f, 0.5f}, {0.04f, 0.7f, 0.7f}, 10.0f},
    {"greenRubber", {0.0f, 0.05f, 0.0f}, {0.4f, 0.5f, 0.4f}, {0.04f, 0.7f, 0.04f}, 10.0f},
    {"redRubber", {0.05f, 0.0f, 0.0f}, {0.5f, 0.4f, 0.4f}, {0.7f, 0.04f, 0.04f}, 10.0f},
    {"whiteRubber", grey(0.05f), grey(0.5f), grey(0.7f), 10.0f},
    {"yellowRubber", {0.05f, 0.05f, 0.0f}, {0.5f, 0.5f, 0.4f}, {0.7f, 0.7f, 0.04f}, 10.0f},
}};

}  // namespace

std::span<const MaterialPreset> materialPresets() { return kPresets; }

std::optional<MaterialPreset> findMaterialPreset(std::string_view name) {
  const auto it =
      std::find_if(kPresets.begin(), kPresets.end(), [&](const auto& preset) { return preset.name == name; });
  if (it == kPresets.end()) return std::nullopt;
  return *it;
}

}  // namespace crosslight

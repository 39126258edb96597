// What a material asks of the light transport: one place that the analysis and the upload both ask.
#pragma once

#include <span>

#include "bindings.h"
#include "scene/scene.h"

namespace crosslight {

bool isClassic(const Material& material);
// Sends a mirrored ray: a classic reflectionFactor, or a metallic-roughness surface so smooth that its lobe is a line.
bool isMirror(const Material& material);
// Lets light pass without being cut away: KHR_materials_transmission or the classic kt.
float transmissionOf(const Material& material);
// The transmitted ray bends: light passes, the surface bounds a body, and its index is not that of its surroundings.
bool refracts(const Material& material);
// Something shows through: blending, kt or transmission.
bool isTransparent(const Material& material);
bool absorbs(const Material& material);
// Light is scattered on its way through the body.
bool scatters(const Material& material);
bool anyScatters(const Scene& scene);
// Share of the extinction that is scattering, as single scattering needs it, of `multiscatterColor`; 0: it does not
// scatter.
glm::vec3 scatteringAlbedo(const Material& material);
// A classic highlight whose coefficient follows the angle of incidence.
bool hasAngularSpecular(const Material& material);
// The clear coat is so smooth that it sends a mirrored ray.
bool coatMirrors(const Material& material);
// Light that falls on it from outside may come back: else no shadow ray is worth sending.
bool isLit(const Material& material);

// An effect that a material calls for by itself.
struct MaterialRule {
  Effect effect;
  const char* name;
  const char* what;  // "has a normal map": follows the material's name, or "no material in use"
  bool (*test)(const Material&);
};
std::span<const MaterialRule> surfaceRules();  // for all methods
std::span<const MaterialRule> rayRules();      // for rays alone
// Bits of all rules that a material passes.
std::uint64_t effectsOf(const Material& material);

}  // namespace crosslight

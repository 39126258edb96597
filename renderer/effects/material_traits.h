// What a material asks of the light transport: one place that the analysis and the upload both ask.
#pragma once

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

}  // namespace crosslight

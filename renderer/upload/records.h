// Materials, textures, lights and cameras as the device's records.
#pragma once

#include <vector>

#include "effects/effects.h"
#include "scene/scene.h"
#include "scene/settings.h"
#include "structs.h"

namespace crosslight {

// All textures in use, linear RGBA, one after the other, and the materials that refer to them.
struct MaterialRecords {
  std::vector<shared::MaterialRecord> materials;  // at least one
  std::vector<glm::vec4> texels;                  // at least one
};
MaterialRecords makeMaterialRecords(const Scene& scene);

// Relative to the render origin.
std::vector<shared::LightRecord> makeLightRecords(const Scene& scene, const glm::dvec3& origin);

// World position that becomes zero: the camera's own.
glm::dvec3 renderOrigin(const Camera& camera);

// What is seen where nothing is: fog that goes by the way of the light covers the background, however thin it is.
glm::vec3 seenBackground(const Atmosphere& atmosphere, const RenderSettings& settings);

// `sampleOffset` within the pixel, (0.5, 0.5) its center; may leave [0,1) for filters wider than a pixel.
shared::FrameRecord makeFrameRecord(const Scene& scene, const RenderSettings& settings, const glm::vec2& sampleOffset);

}  // namespace crosslight

// Asks the shaders' illumination models, on the device, for single values: what a surface sends towards wo of a white
// light of unit intensity from wi.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "gpu/device.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace crosslight::study {

struct ModelQuestion {
  glm::vec4 normal{0, 0, 1, 0};  // w: bits of the material's index
  glm::vec4 tangent{1, 0, 0, 1};
  glm::vec4 wo{0, 0, 1, 0};  // w: u
  glm::vec4 wi{0, 0, 1, 0};  // w: v
};

// Without ambient light; its diffuse and specular colors are gray.
Material classicOf(IlluminationModel model, float kd, float ks, float shininess);

// Unit, about z; rounded to floats, which is what both sides then compute with.
glm::vec3 directionAt(double thetaDegrees, double phiDegrees);
ModelQuestion questionOf(const glm::vec3& wo, const glm::vec3& wi);

// A scene of one triangle that nobody looks at, which carries the material.
Scene carrierOf(const Material& material);

// Direct light only; the settings decide which effects count.
std::vector<glm::dvec3> askModel(const gpu::Device& device, const Material& material,
                                 const std::vector<ModelQuestion>& questions, const RenderSettings& settings = {},
                                 std::vector<TextureImage> images = {});

}  // namespace crosslight::study

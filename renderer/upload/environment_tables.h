// What shaders read of an environment, computed once from its map: what it brings to diffuse and glossy surfaces, and
// the distribution that rays are sent by. Rotation and intensity are the frame's and not in here.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "environment_layout.h"
#include "scene/scene.h"

namespace crosslight {

// One list of texels in the order of shaders/shared/environment_layout.h.
std::vector<glm::vec4> environmentTexels(const EnvironmentMap& map);

// Unit direction of a place in the map, u and v in [0,1]: see EnvironmentMap.
glm::dvec3 environmentDirection(double u, double v);

// Over all directions.
glm::vec3 meanRadiance(const EnvironmentMap& map);

// Of a row's texels, each.
double texelSolidAngle(const EnvironmentMap& map, std::uint32_t row);

}  // namespace crosslight

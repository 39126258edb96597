// Which refracting bodies a point lies in: where the camera's rays begin. Bodies are the closed surfaces of a material
// on one object; meshes by their winding number, analytic shapes by their equations.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/settings.h"

namespace crosslight {

// Bounds a body that bends light, and so may lie in or around another.
bool isBody(const Material& material);

// Materials of the bodies, from the largest to the smallest.
std::vector<int> bodiesAt(const Scene& scene, const glm::dvec3& worldPoint);

// The bodies that rays begin in: none by raster methods and without refraction.
std::vector<int> cameraMedia(const Scene& scene, const RenderSettings& settings);

// Why bodies of this scene are to be kept apart by priority; empty: no ray is in two at once, or nobody said which
// counts.
std::string reasonForNestedMedia(const Scene& scene, const RenderSettings& settings);

}  // namespace crosslight

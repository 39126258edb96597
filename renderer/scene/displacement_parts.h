// The steps of displacement that know neither scene nor camera. Internal to the scene room.
#pragma once

#include <functional>

#include "scene/scene.h"

namespace crosslight {

// Splits in the middle each edge that `splits` names; a triangle becomes two, three or four. Attributes are means of
// the ends', normals and tangents made unit. Whether there was one.
using EdgeTest = std::function<bool(const glm::vec3&, const glm::vec3&)>;
bool splitEdges(Primitive& primitive, const EdgeTest& splits);

// Red channel at uv: wrapped and filtered as shaders/material/texture.glsl does at level 0, in double, as stored.
double sampleRed(const TextureImage& image, const TextureUse& use, const glm::dvec2& uv);

}  // namespace crosslight

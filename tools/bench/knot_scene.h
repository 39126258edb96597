// The benchmarks' mesh: a torus knot over a plane, of any number of triangles, as a glTF file and loaded from it.
#pragma once

#include <cstdint>
#include <filesystem>

#include "scene/scene.h"
#include "scene/settings.h"

namespace crosslight::bench {

// About `triangles` of them, 98 % in the knot; one point light, one camera, classic Blinn-Phong, no texture. The knot
// is one primitive, the plane another, with one material.
std::filesystem::path writeKnotScene(const std::filesystem::path& folder, std::uint32_t triangles);

// "10k", "100k", "1M"
std::string shortCount(std::uint32_t count);

// Every side of every surface counts, as for the peers, which know no materials.
RenderSettings knotSettings(Method method, std::uint32_t width, std::uint32_t height);

}  // namespace crosslight::bench

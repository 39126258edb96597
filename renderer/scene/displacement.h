// CROSSLIGHT_materials_displacement: meshes are split finely and their vertices moved along the normal by the heights
// of a texture, once, at load: raster and rays then draw the same triangles.
#pragma once

#include <cstdint>
#include <string>

#include "scene/scene.h"

namespace crosslight {

struct DisplacementOptions {
  std::uint32_t level = 4;  // every edge becomes 2^level
  // Above 0, instead of the level: edges are split until none is longer than this on the screen, at most seven times.
  float edgePixels = 0.0f;
  std::string camera{};  // name or index; empty: the first
  std::uint32_t width = 512, height = 512;

  bool operator==(const DisplacementOptions&) const = default;
};

// Whether anything was displaced. An analytic shape with such a material gives way to its mesh. InputError where the
// triangles would be more than memory can be expected to hold.
//
// No cracks: an edge is split or not by its two ends alone, at its middle, so that both sides agree; and vertices at
// the same place move to the same place, along the mean of their normals by the mean of their heights (at a seam of
// texture coordinates the two sides may read different ones). That holds within a mesh, across its primitives. Normals
// are made anew; where the mesh had an edge (several normals at one place) it keeps it.
bool displaceMeshes(Scene& scene, const DisplacementOptions& options);

}  // namespace crosslight

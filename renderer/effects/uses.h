// Who draws which material: the uses that the rules look at.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/scene.h"
#include "scene/settings.h"

namespace crosslight {

// A material on a mesh's instance, or on an analytic shape.
struct SurfaceUse {
  int material = 0;
  bool shape = false;
  std::size_t index = 0;      // into Scene::instances or Scene::shapes
  std::size_t primitive = 0;  // of the mesh
};

// By material, and for one material in the order of the scene. Rays draw analytic shapes as such, raster the meshes in
// their place.
std::vector<SurfaceUse> usesOf(const Scene& scene, const RenderSettings& settings);

}  // namespace crosslight

// Who draws which material, and whether the picture can ask for it: the uses that the rules look at.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "effects/effects.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace crosslight {

// A material on a mesh's instance, or on an analytic shape.
struct SurfaceUse {
  int material = 0;
  bool shape = false;
  std::size_t index = 0;      // into Scene::instances or Scene::shapes
  std::size_t primitive = 0;  // of the mesh
  DBounds box = {};           // object space; of an unbounded shape empty
  bool inView = true;
  bool met = true;  // it may be shaded, or asked how much light it lets pass; else it is a mere obstacle to light
  const char* why = "in view";  // or by what it is met though out of view
};

// By material, and for one material in the order of the scene. Rays draw analytic shapes as such, raster the meshes in
// their place. What is out of view is met by mirrored and refracted rays, and where it lets light pass by shadow rays.
std::vector<SurfaceUse> usesOf(const Scene& scene, const RenderSettings& settings, InView inView = InView::ofCamera);

// "on mesh 'ball'", "on sphere 'lens'"
std::string placeOf(const Scene& scene, const SurfaceUse& use);

}  // namespace crosslight

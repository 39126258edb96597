#include "effects/uses.h"

#include <algorithm>

namespace crosslight {

std::vector<SurfaceUse> usesOf(const Scene& scene, const RenderSettings& settings) {
  const bool traced = settings.method == Method::whitted;
  std::vector<SurfaceUse> uses;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const MeshInstance& instance = scene.instances[i];
    if (instance.replacedByShape && traced) continue;
    const std::vector<Primitive>& primitives = scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p) uses.push_back({primitives[p].material, false, i, p});
  }
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) uses.push_back({scene.shapes[i].material, true, i, 0});
  const auto byMaterial = [](const SurfaceUse& a, const SurfaceUse& b) { return a.material < b.material; };
  std::stable_sort(uses.begin(), uses.end(), byMaterial);
  return uses;
}

}  // namespace crosslight

#include "effects/uses.h"

#include <fmt/format.h>

#include <algorithm>

#include "effects/material_traits.h"
#include "effects/view.h"
#include "scene/shape_mesh.h"

namespace crosslight {
namespace {

bool bendsRays(const Material& m, const RenderSettings& s) {
  return s.maxDepth > 0 && ((s.reflection && isMirror(m)) || (s.refraction && refracts(m)));
}

bool letsLightPass(const Material& m) { return m.alphaMode == AlphaMode::mask || isTransparent(m); }

void addMeshes(const Scene& scene, const View& view, bool traced, std::vector<SurfaceUse>& uses) {
  std::vector<std::vector<DBounds>> boxes(scene.meshes.size());  // of primitives, each looked at once
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const MeshInstance& instance = scene.instances[i];
    if (instance.replacedByShape && traced) continue;
    const auto mesh = static_cast<std::size_t>(instance.mesh);
    const std::vector<Primitive>& primitives = scene.meshes[mesh].primitives;
    for (std::size_t p = boxes[mesh].size(); p < primitives.size(); ++p) {
      boxes[mesh].emplace_back();
      for (const glm::vec3& position : primitives[p].positions) boxes[mesh][p].add(glm::dvec3(position));
    }
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      SurfaceUse use{primitives[p].material, false, i, p, boxes[mesh][p]};
      use.inView = view.mayShow(use.box, instance.worldFromObject);
      uses.push_back(use);
    }
  }
}

void addShapes(const Scene& scene, const View& view, std::vector<SurfaceUse>& uses) {
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    const ShapeInstance& shape = scene.shapes[i];
    const auto box = shapeBounds(shape.kind, shape.params);
    SurfaceUse use{shape.material, true, i, 0, box.value_or(DBounds())};
    use.inView = !box || view.mayShow(*box, shape.worldFromObject);
    uses.push_back(use);
  }
}

// Rays that leave the lines of sight may go anywhere.
void markMet(const Scene& scene, const RenderSettings& s, bool traced, std::vector<SurfaceUse>& uses) {
  const auto materialOf = [&](const SurfaceUse& use) -> const Material& {
    return scene.materials[static_cast<std::size_t>(use.material)];
  };
  const bool bends = traced && std::any_of(uses.begin(), uses.end(), [&](const SurfaceUse& use) {
                       return use.inView && bendsRays(materialOf(use), s);
                     });
  const bool elsewhere = traced ? bends : s.rasterReflections != RasterReflections::off;
  const bool shadows = traced ? s.shadows : s.rasterShadows != RasterShadows::off;
  for (SurfaceUse& use : uses) {
    if (use.inView) continue;
    const bool shades = shadows && letsLightPass(materialOf(use));
    use.met = elsewhere || shades;
    use.why = elsewhere ? "out of view, but mirrored or refracted rays may meet it"
              : shades  ? "out of view, but light may pass through it"
                        : "out of view";
  }
}

}  // namespace

std::vector<SurfaceUse> usesOf(const Scene& scene, const RenderSettings& settings, InView inView) {
  const bool traced = settings.method == Method::whitted;
  const Camera& camera = scene.cameras[static_cast<std::size_t>(settings.camera)];
  const View view = inView == InView::all ? View() : View(camera, settings);
  std::vector<SurfaceUse> uses;
  addMeshes(scene, view, traced, uses);
  addShapes(scene, view, uses);
  markMet(scene, settings, traced, uses);
  const auto byMaterial = [](const SurfaceUse& a, const SurfaceUse& b) { return a.material < b.material; };
  std::stable_sort(uses.begin(), uses.end(), byMaterial);
  return uses;
}

std::string placeOf(const Scene& scene, const SurfaceUse& use) {
  if (use.shape) {
    const ShapeInstance& shape = scene.shapes[use.index];
    return shape.name.empty() ? fmt::format("on {} {}", nameOf(shape.kind), use.index)
                              : fmt::format("on {} '{}'", nameOf(shape.kind), shape.name);
  }
  const MeshInstance& instance = scene.instances[use.index];
  const std::string& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)].name;
  const std::string& name = instance.name.empty() ? mesh : instance.name;
  return name.empty() ? fmt::format("on mesh {}", use.index) : fmt::format("on mesh '{}'", name);
}

}  // namespace crosslight

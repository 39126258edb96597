#include "effects/ray_depth.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "effects/material_traits.h"

namespace crosslight {
namespace {

// How often a straight line may cross a surface.
std::uint64_t crossingsOf(const Scene& scene, const SurfaceUse& use) {
  if (!use.shape) {
    const MeshInstance& instance = scene.instances[use.index];
    return scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives[use.primitive].indices.size() / 3;
  }
  switch (scene.shapes[use.index].kind) {
    case ShapeKind::plane:
    case ShapeKind::disk:
      return 1;
    case ShapeKind::torus:
      return 4;
    default:
      return 2;
  }
}

// A mirrored ray leaves a convex surface for good, if it came from outside: single-sided ones are not seen from
// inside by rays that go straight, and other rays are what is to be ruled out. Meshes turn their normals, so that a ray
// may leave into the surface.
bool mirrorsOnce(const Scene& scene, const RenderSettings& s, const SurfaceUse& use, const Material& m) {
  if (!use.shape || m.normalTexture.present() || m.bumpTexture.present() || isTransparent(m)) return false;
  if (m.layers.clearcoatNormalTexture.present()) return false;
  const ShapeKind kind = scene.shapes[use.index].kind;
  if (kind == ShapeKind::plane || kind == ShapeKind::disk) return true;
  return kind != ShapeKind::torus && !m.doubleSided && s.twoSided == TwoSided::material;
}

}  // namespace

RayDepth usableDepth(const Scene& scene, const RenderSettings& s, const std::vector<SurfaceUse>& uses) {
  if (s.method != Method::whitted) return {s.maxDepth, "raster methods send no such rays"};
  if (s.maxDepth == 0) return {0, "direct light only was asked for"};
  std::uint64_t straight = 0, bending = 0;
  bool once = true;
  std::string who;
  for (const SurfaceUse& use : uses) {
    const Material& m = scene.materials[static_cast<std::size_t>(use.material)];
    if (!use.met) continue;
    const bool mirror = s.reflection && isMirror(m), bends = s.refraction && refracts(m);
    if (mirror || bends) {
      ++bending;
      once = once && !bends && mirrorsOnce(scene, s, use, m);
      if (who.empty()) who = fmt::format("material '{}' {}", m.name, placeOf(scene, use));
    } else if (isTransparent(m)) {
      straight += crossingsOf(scene, use);
    }
  }
  const auto capped = [&](std::uint64_t depth, const std::string& reason) -> RayDepth {
    if (depth >= s.maxDepth) return {s.maxDepth, "as asked for: " + reason};
    return {static_cast<std::uint32_t>(depth), reason};
  };
  const std::string crossed = straight == 0 ? "" : fmt::format("; a line crosses {} transparent surfaces", straight);
  if (bending == 0 && straight == 0) return capped(0, "no surface that is met sends rays on");
  if (bending == 0) return capped(straight, fmt::format("rays only go straight on, through {} surfaces", straight));
  // Before the mirror and after it a ray goes straight on, through each surface as often as a line crosses it.
  if (bending == 1 && once)
    return capped(2 * straight + 1, "only " + who + " mirrors, and never its own rays" + crossed);
  return {s.maxDepth, fmt::format("as asked for: rays may go on and on between surfaces such as {}", who)};
}

}  // namespace crosslight

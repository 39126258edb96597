#include "effects/shadow_reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "effects/analysis.h"
#include "effects/material_traits.h"
#include "effects/view.h"

namespace crosslight {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Of the largest coordinate: positions are rounded to floats, and shadow rays begin a little off the surface.
constexpr double kRounding = 0x1p-16;
// Pairs of surfaces that are looked at per light; scenes with more have shadows.
constexpr std::size_t kMostPairs = 4096;

DBounds worldBoxOf(const Scene& scene, const SurfaceUse& use) {
  DBounds box;
  const glm::dmat4& world =
      use.shape ? scene.shapes[use.index].worldFromObject : scene.instances[use.index].worldFromObject;
  for (const glm::dvec3& corner : cornersOf(use.box, world)) box.add(corner);
  return box;
}

// A mesh in a plane across one of the world's axes, to the last bit, whose normals are the plane's: a ray that leaves
// it towards its lit side moves away from every triangle of it. (A closed surface meets its own rays where the
// interpolated normal still sees a light that the triangle does not.)
bool isFlat(const Scene& scene, const SurfaceUse& use, const DBounds& world) {
  const Material& m = scene.materials[static_cast<std::size_t>(use.material)];
  if (use.shape || m.normalTexture.present() || m.bumpTexture.present() || m.layers.clearcoatNormalTexture.present())
    return false;
  const MeshInstance& instance = scene.instances[use.index];
  const Primitive& p = scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives[use.primitive];
  for (int axis = 0; axis < 3; ++axis) {
    if (world.lower[axis] != world.upper[axis]) continue;
    const glm::dmat3 linear(instance.worldFromObject);
    const double determinant = glm::determinant(linear);
    if (determinant == 0.0) return false;
    const glm::dmat3 normals = glm::transpose(glm::inverse(linear));
    return std::all_of(p.normals.begin(), p.normals.end(), [&](const glm::vec3& n) {
      const glm::dvec3 world_ = normals * glm::dvec3(n);
      return world_[axis] != 0.0 && world_[(axis + 1) % 3] == 0.0 && world_[(axis + 2) % 3] == 0.0;
    });
  }
  return false;
}

// Where shadow rays from a box to a light may run.
DBounds reachOf(DBounds box, const Light& light) {
  if (light.type != LightType::directional) {
    box.add(light.worldPosition);
    return box;
  }
  for (int i = 0; i < 3; ++i) {
    if (light.worldDirection[i] < 0) box.upper[i] = kInfinity;
    if (light.worldDirection[i] > 0) box.lower[i] = -kInfinity;
  }
  return box;
}

double sizeOf(const DBounds& b) {
  double size = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (const double v : {b.lower[i], b.upper[i]}) size = std::isfinite(v) ? std::max(size, std::abs(v)) : size;
  }
  return size;
}

bool apart(const DBounds& a, const DBounds& b, double gap) {
  for (int i = 0; i < 3; ++i) {
    if (a.lower[i] > b.upper[i] + gap || b.lower[i] > a.upper[i] + gap) return true;
  }
  return false;
}

// Flat ones that lie in one plane across an axis: of two the same, and of one with itself.
bool inOnePlane(const DBounds& a, const DBounds& b) {
  for (int i = 0; i < 3; ++i) {
    if (a.lower[i] == a.upper[i] && a.lower[i] == b.lower[i] && a.lower[i] == b.upper[i]) return true;
  }
  return false;
}

class Obstacles {
 public:
  Obstacles(const Scene& scene, const std::vector<SurfaceUse>& uses) : scene_(scene) {
    for (const SurfaceUse& use : uses) {
      const bool unbounded = use.shape && use.box.empty();
      if (use.box.empty() && !unbounded) continue;  // no triangles
      surfaces_.push_back({&use, unbounded ? everywhere() : worldBoxOf(scene, use), false, false});
      const Material& m = scene.materials[static_cast<std::size_t>(use.material)];
      Surface& s = surfaces_.back();
      s.lit = use.met && isLit(m);
      s.flat = !unbounded && m.layers.diffuseTransmission == 0.0f && isFlat(scene, use, s.box);
    }
  }

  // What may stand in the way, in words; nothing: no ray is stopped.
  std::optional<std::string> between(const Light& light) const {
    const auto lit = std::count_if(surfaces_.begin(), surfaces_.end(), [](const Surface& s) { return s.lit; });
    if (static_cast<std::size_t>(lit) * surfaces_.size() > kMostPairs) return "there are many surfaces";
    for (const Surface& receiver : surfaces_) {
      if (!receiver.lit) continue;
      const DBounds reach = reachOf(receiver.box, light);
      for (const Surface& caster : surfaces_) {
        const bool itself = &caster == &receiver;
        const bool samePlane = caster.flat && receiver.flat && inOnePlane(caster.box, receiver.box);
        if (samePlane || apart(reach, caster.box, kRounding * std::max(sizeOf(reach), sizeOf(caster.box)))) continue;
        const std::string who = "the surface " + placeOf(scene_, *caster.use);
        return itself ? who + " may shade itself" : who + " may shade the one " + placeOf(scene_, *receiver.use);
      }
    }
    return std::nullopt;
  }

 private:
  struct Surface {
    const SurfaceUse* use;
    DBounds box;
    bool lit, flat;
  };
  static DBounds everywhere() { return {glm::dvec3(-kInfinity), glm::dvec3(kInfinity)}; }

  const Scene& scene_;
  std::vector<Surface> surfaces_;
};

}  // namespace

std::vector<LightVerdict> shadowsOfLights(const Scene& scene, const RenderSettings& s,
                                          const std::vector<SurfaceUse>& uses) {
  const bool rays = s.method == Method::whitted || s.rasterShadows == RasterShadows::rays;
  const Obstacles obstacles(scene, uses);
  std::vector<LightVerdict> verdicts;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    const std::string name = quoted("light", light.name, i);
    const std::optional<std::string> why = !rays                              ? "they come from depth maps"
                                           : hasSmoke(scene.atmosphere.smoke) ? "smoke shows them in the air"
                                           : anyScatters(scene)               ? "bodies that scatter show them"
                                           : isArea(light)                    ? "it has an area"
                                                                              : obstacles.between(light);
    verdicts.push_back({light.name, why.has_value(),
                        why ? name + " may cast shadows: " + *why
                            : "shadows off for " + name + ": no caster between it and any surface that it lights"});
  }
  return verdicts;
}

}  // namespace crosslight

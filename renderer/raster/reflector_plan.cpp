#include "raster/reflector_plan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "effects/material_traits.h"

namespace crosslight {
namespace {

using glm::dvec3;

// Vertices were rounded to floats once, at the size of the largest coordinate: a triangle's plane is off by a few of
// those roundings where the others lie.
constexpr double kFlat = 1.0 / (1 << 20);
// Unit normals in floats; a shading normal that leaves the plane's by more bends the mirror image.
constexpr double kSameNormal = 1.0 / (1 << 18);

class Planner {
 public:
  Planner(const FlatScene& flat, const Scene& scene, const RenderSettings& settings, const std::optional<dvec3>& view)
      : flat_(flat), scene_(scene), settings_(settings), view_(view) {}

  ReflectorPlan run() {
    plan_.ofDraw.resize(flat_.draws.size());
    for (std::uint32_t d = 0; d < flat_.meshDrawCount; ++d) {
      if (isMirror(scene_.materials[flat_.draws[d].materialId])) add(d);
    }
    keepLargest(plan_.planes, kMostPlanes, &ReflectorPlan::Choice::plane);
    keepLargest(plan_.probes, kMostProbes, &ReflectorPlan::Choice::probe);
    return std::move(plan_);
  }

 private:
  dvec3 corner(std::uint32_t triangle, std::uint32_t k) const {
    return dvec3(flat_.positions[flat_.indices[3 * std::size_t{triangle} + k]]);
  }

  void add(std::uint32_t d) {
    const shared::DrawRecord& draw = flat_.draws[d];
    dvec3 lower = corner(draw.firstTriangle, 0), upper = lower, largest(0.0);
    double area = 0, reach = 0;
    std::uint32_t widest = draw.firstTriangle;
    for (std::uint32_t t = draw.firstTriangle; t < draw.firstTriangle + draw.triangleCount; ++t) {
      const dvec3 n = 0.5 * glm::cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
      area += glm::length(n);
      if (glm::length(n) > glm::length(largest)) largest = n, widest = t;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const dvec3 p = corner(t, k);
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
        reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      }
    }
    if (!(area > 0)) return;
    if (settings_.rasterReflections == RasterReflections::mirrors) {
      const dvec3 n = glm::normalize(largest);
      if (isFlat(draw, n, glm::dot(n, corner(widest, 0)), reach)) {
        addPlane(d, n, glm::dot(n, corner(widest, 0)), area, reach);
        return;
      }
    }
    if (settings_.rasterReflections != RasterReflections::environment) addProbe(d, 0.5 * (lower + upper), area);
  }

  bool isFlat(const shared::DrawRecord& draw, const dvec3& n, double offset, double reach) const {
    if (scene_.materials[draw.materialId].normalTexture.present()) return false;
    for (std::uint32_t i = 3 * draw.firstTriangle; i < 3 * (draw.firstTriangle + draw.triangleCount); ++i) {
      const std::uint32_t v = flat_.indices[i];
      if (std::abs(glm::dot(n, dvec3(flat_.positions[v])) - offset) > kFlat * reach) return false;
      const dvec3 shading = glm::normalize(dvec3(flat_.attributes[v].renderNormal));
      if (!(std::min(glm::length(shading - n), glm::length(shading + n)) <= kSameNormal)) return false;
    }
    return true;
  }

  void addPlane(std::uint32_t d, dvec3 n, double offset, double area, double reach) {
    const double side = view_ ? -glm::dot(n, *view_) : -offset;
    if (side < 0) n = -n, offset = -offset;
    if (side == 0) return;  // seen from its edge
    const auto isSame = [&](const MirrorPlane& p) {
      return glm::length(p.normal - n) <= kSameNormal && std::abs(p.offset - offset) <= kFlat * reach;
    };
    const auto found = std::find_if(plan_.planes.begin(), plan_.planes.end(), isSame);
    plan_.ofDraw[d].plane = static_cast<std::size_t>(found - plan_.planes.begin());
    if (found == plan_.planes.end())
      plan_.planes.push_back({n, offset, 2 * kFlat * reach, area});
    else
      found->area += area;
  }

  void addProbe(std::uint32_t d, const dvec3& center, double area) {
    const std::uint32_t id = flat_.draws[d].instanceId;
    const auto found =
        std::find_if(plan_.probes.begin(), plan_.probes.end(), [&](const ProbePlace& p) { return p.instanceId == id; });
    plan_.ofDraw[d].probe = static_cast<std::size_t>(found - plan_.probes.begin());
    if (found == plan_.probes.end()) {
      plan_.probes.push_back({center, id, area});
    } else if (area > found->area) {
      *found = {center, id, area};
    }
  }

  template <class T>
  void keepLargest(std::vector<T>& all, std::size_t most, std::optional<std::size_t> ReflectorPlan::Choice::*which) {
    if (all.size() <= most) return;
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return all[a].area > all[b].area; });
    std::vector<T> kept;
    for (std::size_t i = 0; i < most; ++i) kept.push_back(all[order[i]]);
    plan_.leftOut += all.size() - most;
    for (ReflectorPlan::Choice& choice : plan_.ofDraw) {
      if (!(choice.*which)) continue;
      const auto place =
          static_cast<std::size_t>(std::find(order.begin(), order.end(), *(choice.*which)) - order.begin());
      choice.*which = place < most ? std::optional(place) : std::nullopt;
    }
    all = std::move(kept);
  }

  const FlatScene& flat_;
  const Scene& scene_;
  const RenderSettings& settings_;
  std::optional<dvec3> view_;
  ReflectorPlan plan_;
};

}  // namespace

ReflectorPlan planReflectors(const FlatScene& flat, const Scene& scene, const RenderSettings& settings,
                             const std::optional<glm::dvec3>& orthographicView) {
  return Planner(flat, scene, settings, orthographicView).run();
}

}  // namespace crosslight

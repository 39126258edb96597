#include "raster/draw_list.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "effects/material_traits.h"

namespace crosslight {
namespace {

struct SortedTriangle {
  std::uint32_t triangle, drawId;
  float distance;  // squared
};

DrawCall callOf(const FlatScene& flat, const Scene& scene, const RenderSettings& settings, std::uint32_t drawId) {
  const shared::DrawRecord& draw = flat.draws[drawId];
  const bool both = scene.materials[draw.materialId].doubleSided || settings.twoSided == TwoSided::always ||
                    settings.method == Method::wireframe;
  return {draw.firstTriangle, draw.triangleCount, drawId, draw.materialId, draw.flags, !both};
}

bool sharesState(const DrawCall& a, const DrawCall& b) {
  return a.materialId == b.materialId && a.flags == b.flags && a.cullsBackFaces == b.cullsBackFaces;
}

// Neighbours only: the order of triangles stays, and with it which of two coincident surfaces is seen.
void append(std::vector<DrawCall>& calls, const DrawCall& next) {
  if (!calls.empty() && sharesState(calls.back(), next) &&
      calls.back().firstTriangle + calls.back().triangleCount == next.firstTriangle) {
    calls.back().triangleCount += next.triangleCount;
  } else {
    calls.push_back(next);
  }
}

// From far to near by their centroid: exact unless triangles intersect or overlap cyclically.
std::vector<SortedTriangle> sortedTriangles(const FlatScene& flat, const std::vector<DrawCall>& draws) {
  std::vector<SortedTriangle> sorted;
  for (const DrawCall& draw : draws) {
    for (std::uint32_t t = 0; t < draw.triangleCount; ++t)
      sorted.push_back({draw.firstTriangle + t, draw.drawId, 0.0f});
  }
  for (SortedTriangle& s : sorted) {
    const auto corner = [&](std::uint32_t k) { return flat.positions[flat.indices[3 * s.triangle + k]]; };
    const glm::vec3 centroid = (corner(0) + corner(1) + corner(2)) / 3.0f;
    s.distance = glm::dot(centroid, centroid);
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const SortedTriangle& a, const SortedTriangle& b) { return a.distance > b.distance; });
  return sorted;
}

}  // namespace

DrawLists makeDrawLists(const FlatScene& flat, const Scene& scene, const Plan& plan, const RenderSettings& settings) {
  DrawLists lists;
  std::vector<DrawCall> transparent;
  const bool mayBlend = plan.has(Effect::transparency) && settings.method != Method::wireframe;
  for (std::uint32_t d = 0; d < flat.meshDrawCount; ++d) {
    const DrawCall call = callOf(flat, scene, settings, d);
    lists.records.push_back(call);
    if (mayBlend && isTransparent(scene.materials[call.materialId])) {
      transparent.push_back(call);
    } else {
      append(lists.opaque, call);
    }
  }
  for (const SortedTriangle& s : sortedTriangles(flat, transparent)) {
    DrawCall call = lists.records[s.drawId];
    call.firstTriangle = s.triangle;
    call.triangleCount = 1;
    append(lists.blended, call);
  }
  return lists;
}

}  // namespace crosslight

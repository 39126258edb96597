#include "raster/draw_list.h"

#include "effects/material_traits.h"

namespace crosslight {
namespace {

DrawCall callOf(const FlatScene& flat, const Scene& scene, const RenderSettings& settings, std::uint32_t drawId) {
  const shared::DrawRecord& draw = flat.draws[drawId];
  const bool both = scene.materials[draw.materialId].doubleSided || settings.twoSided == TwoSided::always ||
                    settings.method == Method::wireframe;
  return {draw.firstTriangle, draw.triangleCount, drawId, draw.materialId, draw.flags, !both};
}

bool sharesState(const DrawCall& a, const DrawCall& b) {
  return a.materialId == b.materialId && a.flags == b.flags && a.cullsBackFaces == b.cullsBackFaces;
}

// Neighbours only: the order of triangles stays, and with it which of two coincident surfaces is seen. Mirrors stay
// apart: each has its own picture.
void append(std::vector<DrawCall>& calls, const DrawCall& next, bool isMirrorDraw = false) {
  if (!calls.empty() && !isMirrorDraw && sharesState(calls.back(), next) &&
      calls.back().firstTriangle + calls.back().triangleCount == next.firstTriangle) {
    calls.back().triangleCount += next.triangleCount;
  } else {
    calls.push_back(next);
  }
}

}  // namespace

DrawLists makeDrawLists(const FlatScene& flat, const Scene& scene, const Plan& plan, const RenderSettings& settings) {
  DrawLists lists;
  const bool mirrors = settings.rasterReflections != RasterReflections::off && plan.has(Effect::reflection);
  const bool mayBlend = plan.has(Effect::transparency) && settings.method != Method::wireframe;
  for (std::uint32_t d = 0; d < flat.meshDrawCount; ++d) {
    const DrawCall call = callOf(flat, scene, settings, d);
    lists.records.push_back(call);
    const Material& material = scene.materials[call.materialId];
    const bool blends = mayBlend && isTransparent(material);
    append(blends ? lists.transparent : lists.opaque, call, mirrors && isMirror(material));
  }
  return lists;
}

}  // namespace crosslight

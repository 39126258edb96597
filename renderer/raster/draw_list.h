// Which triangles are drawn in which order with which state: plain data, made once per scene.
#pragma once

#include <cstdint>
#include <vector>

#include "effects/effects.h"
#include "scene/settings.h"
#include "upload/flatten.h"

namespace crosslight {

// Triangles that lie one behind the other in the flat list and share all state: one call to the device.
struct DrawCall {
  std::uint32_t firstTriangle = 0, triangleCount = 0;
  std::uint32_t drawId = 0;  // of the first triangle
  std::uint32_t materialId = 0;
  std::uint32_t flags = 0;  // shared::kDraw*
  bool cullsBackFaces = false;
};

struct DrawLists {
  std::vector<DrawCall> opaque;       // in scene order: of coincident surfaces the first one stays
  std::vector<DrawCall> transparent;  // in scene order
  std::vector<DrawCall> records;      // everything in scene order, one call per DrawRecord: the AOVs need its ids
};

DrawLists makeDrawLists(const FlatScene& flat, const Scene& scene, const Plan& plan, const RenderSettings& settings);

}  // namespace crosslight

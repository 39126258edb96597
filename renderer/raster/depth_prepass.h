// Does a pass of depth alone, before the one that lights, pay? It spares the fragments of surfaces that others hide,
// and costs all triangles once more. Which way it goes changes no bit of the picture.
#pragma once

#include "raster/draw_list.h"
#include "structs.h"

namespace crosslight {

struct PrepassVerdict {
  bool pays = false;
  double lit = 0;      // fragments that are lit without it, estimated
  double visible = 0;  // those of them that are seen at last
};

// From a sample of the opaque triangles, in the order in which they are drawn, over a coarse grid of the picture.
PrepassVerdict planPrepass(const FlatScene& flat, const DrawLists& lists, const shared::FrameRecord& frame,
                           const RenderSettings& settings, std::uint32_t lightCount);

}  // namespace crosslight

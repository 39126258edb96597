// A split of space between bins: Stich, Friedrich, Dietrich 2009, "Spatial Splits in Bounding Volume Hierarchies".
// Private to the room.
#pragma once

#include "accel/bvh_builder.h"
#include "accel/bvh_clip.h"

namespace crosslight::accel {

// References of a range that spatial splits may add to: each owns its own.
struct SpatialRange {
  std::vector<Reference> references;
  Box bounds, centers;
  std::uint32_t depth = 0;
  std::uint32_t budget = 0;  // references that its subtree may add

  std::uint32_t count() const { return static_cast<std::uint32_t>(references.size()); }
};

struct SpatialSplit {
  bool found = false;
  int axis = 0;
  float position = 0;
  double cost = 0;  // as Split::cost
  Box sides[2];     // of both sides' parts
  std::uint32_t counts[2] = {0, 0};
};

// Cheapest plane between equal bins of space, within the range's budget.
SpatialSplit chooseSpatialSplit(const BvhTriangles& triangles, const SpatialRange& range);

// Puts each reference on one side or its parts on both, whichever costs less. False, and children of no use, where that
// leaves a side empty or one as large as the whole.
bool splitSpatially(const BvhTriangles& triangles, const SpatialRange& range, const SpatialSplit& split,
                    SpatialRange (&children)[2]);

}  // namespace crosslight::accel

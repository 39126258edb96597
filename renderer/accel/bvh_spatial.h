// The builder of quality high: binned splits, and spatial splits that cut triangles in two. Private to the room.
#pragma once

#include <memory>

#include "accel/bvh_builder.h"

namespace crosslight::accel {

// The nodes and primitives of one piece; a spatial split makes more references, so that their number is known late.
struct SpatialPiece {
  RawArray<shared::BvhNode> nodes;
  RawArray<std::uint32_t> order;
  std::size_t room = 0;  // of both
  std::uint32_t orderCount = 0;
};

struct SpatialParts {
  Parts parts;
  std::vector<SpatialPiece> pieces;  // parts.pieces lie in them
};

// `references` are those of `root`. Leaves count from 0 in each piece's own order: parts.pieces say where that starts
// in the order that is all pieces' one behind the other.
SpatialParts buildSpatial(const Plan& plan, const BvhTriangles& triangles, std::span<const Reference> references,
                          const Work& root, Team& team);

}  // namespace crosslight::accel

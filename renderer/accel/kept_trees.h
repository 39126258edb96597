// Trees kept from one frame to the next: where triangles only move, their tree moves with them.
#pragma once

#include <cstdint>
#include <map>
#include <memory>

#include "accel/bvh.h"

namespace crosslight {

// A tree is built anew when a ray through the moved one would cost this many times what it did when it was built.
// Building takes about four times as long as moving, so that a worse tree pays for one or two frames, not for many.
inline constexpr double kMostGrowth = 1.5;

class KeptTrees {
 public:
  KeptTrees();
  ~KeptTrees();
  struct Counts {
    std::uint32_t built = 0, moved = 0, unchanged = 0;
  };

  // The tree over these triangles, of medium quality; `key` says which of several trees of a frame. The same vertices
  // of the same triangles as the last time under this key: its tree, refitted where they have moved. It is valid until
  // the next call under this key.
  const Bvh& over(int key, const BvhTriangles& triangles);
  // Since the last time that this was asked for.
  Counts takeCounts();

 private:
  struct Kept;
  std::map<int, std::unique_ptr<Kept>> kept_;
  Counts counts_;
};

}  // namespace crosslight

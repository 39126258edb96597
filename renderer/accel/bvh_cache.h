// Trees of large scenes, kept on disk under a hash of what they were built from. A render never fails because of it:
// whatever is missing, damaged or of another version counts as not there. Several processes may share a folder.
#pragma once

#include <compare>
#include <filesystem>
#include <optional>

#include "accel/bvh.h"

namespace crosslight {

struct BvhCache {
  std::filesystem::path folder;                     // empty: nothing is kept
  std::uint64_t maxBytes = std::uint64_t{4} << 30;  // beyond it the trees that were not used longest are removed
};

// $XDG_CACHE_HOME/crosslight/bvh, or ~/.cache/crosslight/bvh; an empty folder where neither variable says where.
BvhCache defaultBvhCache();

// Names a tree: a hash of all that decides its bits. 128 bits: two scenes of a folder never share one by accident.
struct BvhKey {
  std::uint64_t high = 0, low = 0;
  auto operator<=>(const BvhKey&) const = default;
};
BvhKey bvhKey(std::span<const Bounds> primitives, const BvhOptions& options);
BvhKey bvhKey(const BvhTriangles& triangles, const BvhOptions& options);

// The tree, proved whole: its own hash, and every reference from node to node and to primitives, of which there are
// `primitives`. stats.buildMs is the time of loading.
std::optional<Bvh> loadBvh(const BvhCache& cache, const BvhKey& key, std::size_t primitives, std::uint32_t threads = 0);

// False, said in the verbose log only, where it cannot be kept. A tree larger than the whole folder may be is not kept.
bool storeBvh(const BvhCache& cache, const BvhKey& key, const Bvh& bvh, std::uint32_t threads = 0) noexcept;

// Loading takes a fourteenth to a thirtieth of building, key included; below this a tree is built while the kernels
// compile, and a file would save nothing.
inline constexpr std::size_t kBvhCachePrimitives = 200'000;

}  // namespace crosslight

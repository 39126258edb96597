// The file of one tree: a header that proves itself and the rest, then nodes and order. Private to the room.
#pragma once

#include <filesystem>
#include <optional>

#include "accel/bvh_cache.h"
#include "accel/bvh_team.h"

namespace crosslight::accel {

// Rises with every change of the format or of the trees that are built: older files are then of no use.
inline constexpr std::uint32_t kBvhFileVersion = 1;

void writeBvhFile(const std::filesystem::path& path, const BvhKey& key, const Bvh& bvh, Team& team);
std::optional<Bvh> readBvhFile(const std::filesystem::path& path, const BvhKey& key, std::size_t primitives,
                               Team& team);

// Whether nodes are in depth-first order, no path is deeper than the shaders' stack, and all that they refer to is
// there.
bool isSoundTree(const Bvh& bvh, std::size_t primitives, Team& team);

}  // namespace crosslight::accel

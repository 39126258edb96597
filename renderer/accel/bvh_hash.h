// A hash at the speed of memory, for files and keys of many megabytes. Not for hostile input. Private to the room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "accel/bvh_team.h"

namespace crosslight::accel {

struct Digest {
  std::uint64_t a = 0, b = 0;
  bool operator==(const Digest&) const = default;
};

// A change of a single aligned word always changes the four lanes that this is mixed from.
Digest digestOf(std::span<const std::byte> bytes);

// Pieces of this size are hashed by different threads; the digest is that of their digests.
inline constexpr std::size_t kHashPiece = std::size_t{1} << 20;
Digest digestOfPieces(std::span<const std::byte> bytes, Team& team);

}  // namespace crosslight::accel

// The pipeline cache's file: a header that proves the driver's blob whole, then the blob. A driver may crash on a
// damaged blob, so anything doubtful counts as no cache. Private to this room.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace crosslight::gpu {

std::vector<std::byte> packCache(std::span<const std::byte> blob);
std::optional<std::vector<std::byte>> unpackCache(std::span<const std::byte> file);

// Trouble with the file is told in the verbose log only: a run never fails because of its cache.
std::optional<std::vector<std::byte>> loadCache(const std::filesystem::path& path);
bool saveCache(const std::filesystem::path& path, std::span<const std::byte> blob) noexcept;

}  // namespace crosslight::gpu

// Files in and out. An output file is written whole or not at all: a temporary file beside it, then a rename.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace crosslight {

// Whole file; InputError when it cannot be read or is larger than `maxBytes`.
std::vector<std::byte> readFile(const std::filesystem::path& path, std::uint64_t maxBytes = std::uint64_t{1} << 36);

// Calls `write` with the path of a temporary file in the same folder, flushes it to the disk and renames it to
// `path`. On an exception, or after Ctrl-C, the temporary file is removed and `path` is as it was.
void writeFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path& temporary)>& write);
void writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void writeFileAtomically(const std::filesystem::path& path, const std::string& text);

// Where what can be made again is kept: $XDG_CACHE_HOME/crosslight, or ~/.cache/crosslight; empty where neither
// variable says where.
std::filesystem::path cacheFolder();

}  // namespace crosslight

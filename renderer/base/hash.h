// FNV-1a, 64 bits: names cache entries and compares outputs. Not for hostile input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace crosslight {

inline constexpr std::uint64_t kHashSeed = 14695981039346656037ull;

inline std::uint64_t hashBytes(std::span<const std::byte> bytes, std::uint64_t hash = kHashSeed) {
  for (const std::byte b : bytes) {
    hash ^= static_cast<std::uint64_t>(b);
    hash *= 1099511628211ull;
  }
  return hash;
}

std::string hexOf(std::uint64_t hash);  // 16 lower-case digits

}  // namespace crosslight

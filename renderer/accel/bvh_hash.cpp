#include "accel/bvh_hash.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <vector>

namespace crosslight::accel {
namespace {

// Odd, so that multiplying is reversible; their bits are those of fractions of sqrt(2), sqrt(3), sqrt(5) and sqrt(7).
constexpr std::uint64_t kFactors[4] = {0x6a09e667f3bcc909ull, 0xbb67ae8584caa73bull, 0x3c6ef372fe94f82bull,
                                       0xa54ff53a5f1d36f1ull};

struct Lanes {
  std::uint64_t lane[4] = {kFactors[3], kFactors[2], kFactors[1], kFactors[0]};

  void add(const std::byte* bytes) {
    std::uint64_t words[4];
    std::memcpy(words, bytes, sizeof(words));
    for (int i = 0; i < 4; ++i) lane[i] = (std::rotl(lane[i], 29) ^ words[i]) * kFactors[i];
  }
};

std::uint64_t mixed(std::uint64_t x, std::uint64_t factor) {
  x ^= x >> 32;
  x *= factor;
  x ^= x >> 29;
  x *= kFactors[0];
  return x ^ x >> 32;
}

}  // namespace

Digest digestOf(std::span<const std::byte> bytes) {
  constexpr std::size_t kStep = 4 * sizeof(std::uint64_t);
  Lanes lanes;
  std::size_t at = 0;
  for (; at + kStep <= bytes.size(); at += kStep) lanes.add(bytes.data() + at);
  if (at < bytes.size()) {
    std::byte rest[kStep] = {};
    std::memcpy(rest, bytes.data() + at, bytes.size() - at);
    lanes.add(rest);
  }
  Digest digest{bytes.size() * kFactors[1], ~bytes.size() * kFactors[2]};
  for (const std::uint64_t lane : lanes.lane) {
    digest.a = mixed(digest.a ^ lane, kFactors[1]);
    digest.b = mixed(digest.b + std::rotl(lane, 32), kFactors[3]);
  }
  return digest;
}

Digest digestOfPieces(std::span<const std::byte> bytes, Team& team) {
  std::vector<Digest> digests((bytes.size() + kHashPiece - 1) / kHashPiece);
  team.forEach(static_cast<std::uint32_t>(digests.size()), [&](std::uint32_t i) {
    const std::size_t begin = i * kHashPiece;
    digests[i] = digestOf(bytes.subspan(begin, std::min(kHashPiece, bytes.size() - begin)));
  });
  return digestOf(std::as_bytes(std::span(digests)));
}

}  // namespace crosslight::accel

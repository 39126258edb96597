// The segments of a JPEG file, as far as they are needed to keep the decoder inside its tables.
#include "scene/gltf_jpeg.h"

#include <algorithm>

namespace crosslight::gltf {
namespace {

constexpr unsigned char kStartOfScan = 0xDA;
constexpr unsigned char kHuffmanTables = 0xC4;
constexpr unsigned char kComment = 0xFE;
constexpr unsigned char kJfif = 0xE0;   // APP0
constexpr unsigned char kAdobe = 0xEE;  // APP14

std::size_t word(const Bytes& bytes, std::size_t at) {
  return at + 1 < bytes.size() ? std::size_t{bytes[at]} * 256 + bytes[at + 1] : 0;
}

bool isMetadata(unsigned char marker) {
  return (marker >= 0xE0 && marker <= 0xEF && marker != kJfif && marker != kAdobe) || marker == kComment;
}

// The tables of one segment; `at` is behind its marker.
bool tablesFit(const Bytes& jpeg, std::size_t at) {
  const std::size_t end = std::min(at + word(jpeg, at), jpeg.size());
  at += 2;
  while (at + 17 <= end) {
    std::size_t symbols = 0;
    for (std::size_t i = 1; i <= 16; ++i) symbols += jpeg[at + i];
    if (symbols > 256) return false;
    at += 17 + symbols;
  }
  // A table that its segment cuts off would be read from what follows.
  return at >= end;
}

}  // namespace

Bytes withoutMetadata(const Bytes& jpeg) {
  Bytes kept(jpeg.begin(), jpeg.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(2, jpeg.size())));
  std::size_t at = 2;
  while (at + 4 <= jpeg.size() && jpeg[at] == 0xFF) {
    const unsigned char marker = jpeg[at + 1];
    if (marker == kStartOfScan) break;
    const std::size_t next = at + 2 + word(jpeg, at + 2);
    // Fill bytes, broken lengths: the decoder gets the rest as it is.
    if (marker == 0xFF || word(jpeg, at + 2) < 2 || next > jpeg.size()) break;
    if (!isMetadata(marker))
      kept.insert(kept.end(), jpeg.begin() + static_cast<std::ptrdiff_t>(at),
                  jpeg.begin() + static_cast<std::ptrdiff_t>(next));
    at = next;
  }
  kept.insert(kept.end(), jpeg.begin() + static_cast<std::ptrdiff_t>(std::min(at, jpeg.size())), jpeg.end());
  return kept;
}

bool huffmanTablesFit(const Bytes& jpeg) {
  for (std::size_t i = 0; i + 1 < jpeg.size(); ++i) {
    if (jpeg[i] == 0xFF && jpeg[i + 1] == kHuffmanTables && !tablesFit(jpeg, i + 2)) return false;
  }
  return true;
}

}  // namespace crosslight::gltf

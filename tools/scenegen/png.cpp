// Stored deflate blocks (RFC 1951, 3.2.4) in a zlib stream (RFC 1950) in IDAT (PNG specification, 3rd edition).
#include "scenegen/png.h"

#include <algorithm>
#include <span>
#include <string_view>

#include "base/check.h"

namespace crosslight::scenegen {
namespace {

using Bytes = std::vector<std::uint8_t>;

void appendBig32(Bytes& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::uint8_t>(value >> shift));
}

void appendLittle16(Bytes& out, std::uint32_t value) {
  out.push_back(static_cast<std::uint8_t>(value));
  out.push_back(static_cast<std::uint8_t>(value >> 8));
}

std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) ? 0xedb88320u : 0u);
  }
  return ~crc;
}

std::uint32_t adler32(std::span<const std::uint8_t> bytes) {
  std::uint32_t a = 1, b = 0;
  for (const std::uint8_t byte : bytes) {
    a = (a + byte) % 65521u;
    b = (b + a) % 65521u;
  }
  return (b << 16) | a;
}

Bytes storedZlib(const Bytes& data) {
  constexpr std::size_t kMostPerBlock = 65535;
  Bytes out = {0x78, 0x01};
  for (std::size_t at = 0; at < data.size(); at += kMostPerBlock) {
    const std::size_t size = std::min(kMostPerBlock, data.size() - at);
    out.push_back(at + size == data.size() ? 1 : 0);
    appendLittle16(out, static_cast<std::uint32_t>(size));
    appendLittle16(out, ~static_cast<std::uint32_t>(size));
    const auto from = data.begin() + static_cast<std::ptrdiff_t>(at);
    out.insert(out.end(), from, from + static_cast<std::ptrdiff_t>(size));
  }
  appendBig32(out, adler32(data));
  return out;
}

void appendChunk(Bytes& out, std::string_view type, const Bytes& data) {
  appendBig32(out, static_cast<std::uint32_t>(data.size()));
  const auto start = static_cast<std::ptrdiff_t>(out.size());
  out.insert(out.end(), type.begin(), type.end());
  out.insert(out.end(), data.begin(), data.end());
  appendBig32(out, crc32(std::span(out.begin() + start, out.end())));
}

}  // namespace

std::vector<std::byte> makePng(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
                               const std::function<void(std::uint32_t x, std::uint32_t y, std::uint8_t* out)>& pixel) {
  CL_CHECK(channels == 1 || channels == 3 || channels == 4);
  Bytes rows;
  for (std::uint32_t y = 0; y < height; ++y) {
    rows.push_back(0);  // no filter
    for (std::uint32_t x = 0; x < width; ++x) {
      std::uint8_t values[4] = {};
      pixel(x, y, values);
      rows.insert(rows.end(), values, values + channels);
    }
  }
  Bytes header;
  appendBig32(header, width);
  appendBig32(header, height);
  const std::uint8_t colorType = channels == 1 ? 0 : (channels == 3 ? 2 : 6);
  header.insert(header.end(), {8, colorType, 0, 0, 0});
  Bytes out = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  appendChunk(out, "IHDR", header);
  appendChunk(out, "IDAT", storedZlib(rows));
  appendChunk(out, "IEND", {});
  std::vector<std::byte> bytes(out.size());
  std::transform(out.begin(), out.end(), bytes.begin(), [](std::uint8_t b) { return std::byte{b}; });
  return bytes;
}

}  // namespace crosslight::scenegen

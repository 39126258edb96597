#include "image/png_chunks.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "base/check.h"
#include "base/error.h"

namespace crosslight::codec {
namespace {

constexpr std::array<unsigned char, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::size_t kHeaderLength = 13;
constexpr std::size_t kChunkOverhead = 12;  // length, type, checksum

std::uint32_t bigEndian(const std::byte* b) {
  return std::to_integer<std::uint32_t>(b[0]) << 24 | std::to_integer<std::uint32_t>(b[1]) << 16 |
         std::to_integer<std::uint32_t>(b[2]) << 8 | std::to_integer<std::uint32_t>(b[3]);
}

void putBigEndian(Bytes& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::byte>(value >> shift));
}

void putChunk(Bytes& bytes, const std::string& type, View data) {
  putBigEndian(bytes, static_cast<std::uint32_t>(data.size()));
  const std::size_t start = bytes.size();
  append(bytes, type);
  bytes.insert(bytes.end(), data.begin(), data.end());
  putBigEndian(bytes, libdeflate_crc32(0, bytes.data() + start, bytes.size() - start));
}

void putChunk(Bytes& bytes, const std::string& type, const std::string& data) {
  putChunk(bytes, type, std::as_bytes(std::span(data)));
}

bool isAscii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return (c >= ' ' && c <= '~') || c == '\n'; });
}

// tEXt holds Latin-1, iTXt (uncompressed, no language) UTF-8.
void putText(Bytes& bytes, const std::string& key, const std::string& value) {
  CL_CHECK(!key.empty() && key.size() <= 79 && isAscii(key));
  const std::string nul(1, '\0');
  if (isAscii(value)) {
    putChunk(bytes, "tEXt", key + nul + value);
  } else {
    putChunk(bytes, "iTXt", key + nul + std::string(4, '\0') + value);
  }
}

struct Chunk {
  std::string type;
  View data;
};

Chunk chunkAt(View file, std::size_t at, const std::string& where) {
  if (file.size() - at < kChunkOverhead) throw InputError(where, "ends early: its IEND chunk is missing");
  const std::size_t length = bigEndian(file.data() + at);
  if (length > file.size() - at - kChunkOverhead) throw InputError(where, "ends early, within a chunk");
  Chunk chunk{std::string(reinterpret_cast<const char*>(file.data()) + at + 4, 4), file.subspan(at + 8, length)};
  const std::uint32_t checksum = libdeflate_crc32(0, file.data() + at + 4, length + 4);
  if (checksum != bigEndian(chunk.data.data() + length)) {
    throw InputError(where, "is damaged: the checksum of a chunk at byte " + std::to_string(at) + " is wrong");
  }
  return chunk;
}

// A deflate stream expands at most 1032 times (258 bytes from two bits); a row has a filter byte more than its samples.
void checkSize(const PngInfo& info, std::uint32_t colorType, std::size_t compressed, const std::string& where) {
  const std::uint64_t channels = colorType == 2 ? 3 : colorType == 4 ? 2 : colorType == 6 ? 4 : 1;
  const std::uint64_t rowBytes = (std::uint64_t{info.width} * channels * info.bitDepth + 7) / 8 + 1;
  constexpr std::uint64_t kMaxExpansion = 1032;
  if (rowBytes * info.height > kMaxExpansion * compressed) {
    throw InputError(where, "is too short for the size that its header gives");
  }
}

}  // namespace

PngInfo checkPng(View file, const std::string& where) {
  if (file.size() < kSignature.size() || std::memcmp(file.data(), kSignature.data(), kSignature.size()) != 0) {
    throw InputError(where, "is not a PNG file");
  }
  PngInfo info;
  std::uint32_t colorType = 0;
  std::size_t compressed = 0;
  for (std::size_t at = kSignature.size();;) {
    const Chunk chunk = chunkAt(file, at, where);
    const bool first = at == kSignature.size();
    if (first != (chunk.type == "IHDR") || (first && chunk.data.size() != kHeaderLength)) {
      throw InputError(where, "has a broken IHDR chunk");
    }
    if (first) {
      info = {bigEndian(chunk.data.data()), bigEndian(chunk.data.data() + 4),
              std::to_integer<std::uint32_t>(chunk.data[8])};
      colorType = std::to_integer<std::uint32_t>(chunk.data[9]);
      checkSides(info.width, info.height, where);
    }
    if (chunk.type == "IDAT") compressed += chunk.data.size();
    if (chunk.type == "IEND") break;
    at += kChunkOverhead + chunk.data.size();
  }
  checkSize(info, colorType, compressed, where);
  return info;
}

Bytes pngFile(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
              const std::map<std::string, std::string>& metadata, View zlibStream) {
  constexpr std::size_t kLongestChunk = std::size_t{1} << 30;  // the format allows 2^31 - 1
  Bytes bytes;
  bytes.reserve(zlibStream.size() + zlibStream.size() / kLongestChunk * kChunkOverhead + 4096);
  for (const unsigned char byte : kSignature) bytes.push_back(static_cast<std::byte>(byte));
  Bytes header;
  putBigEndian(header, width);
  putBigEndian(header, height);
  // 8 bits, RGB or RGBA; deflate, the standard's filters, not interlaced.
  append(header, std::string{8, static_cast<char>(channels == 4 ? 6 : 2), 0, 0, 0});
  CL_CHECK_EQ(header.size(), kHeaderLength);
  putChunk(bytes, "IHDR", View(header));
  putChunk(bytes, "sRGB", std::string(1, '\1'));  // rendering intent: relative colorimetric
  for (const auto& [key, value] : metadata) putText(bytes, key, value);
  for (std::size_t at = 0; at < zlibStream.size(); at += kLongestChunk) {
    putChunk(bytes, "IDAT", zlibStream.subspan(at, std::min(kLongestChunk, zlibStream.size() - at)));
  }
  putChunk(bytes, "IEND", View());
  return bytes;
}

}  // namespace crosslight::codec

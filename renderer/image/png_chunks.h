// PNG's chunk structure (ISO/IEC 15948:2003): check a file's before it is decoded, make those of a new file. Private to
// the room.
#pragma once

#include <map>
#include <string>

#include "image/codecs.h"

namespace crosslight::codec {

struct PngInfo {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t bitDepth = 0;
};

// Signature, lengths, checksums, and that the compressed data can hold an image of the stated size. InputError if not.
PngInfo checkPng(View file, const std::string& where);

// A whole file: header, that the samples are 8-bit sRGB with 3 or 4 channels, the metadata as text, and the zlib stream
// of the filtered rows.
Bytes pngFile(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
              const std::map<std::string, std::string>& metadata, View zlibStream);

}  // namespace crosslight::codec

// PNG's chunk structure (ISO/IEC 15948:2003): check a file's before it is decoded, add to a file's after it is encoded.
// Private to the room.
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

// Says that the samples are sRGB and adds the metadata as text, in front of the image data.
Bytes withPngInfo(View file, const std::map<std::string, std::string>& metadata);

}  // namespace crosslight::codec

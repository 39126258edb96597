// One pair of functions per file format; private to the room. `where` names the file in messages.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "image/image.h"
#include "image/image_io.h"

namespace crosslight::codec {

using Bytes = std::vector<std::byte>;
using View = std::span<const std::byte>;

Bytes encodePng(const Image& image, const DisplayTransform& display, const std::string& where);
Image decodePng(View file, const std::string& where);

Bytes encodeHdr(const Image& image, float gain, const std::string& where);
Image decodeHdr(View file, const std::string& where);

Bytes encodePfm(const Image& image, float gain);
Image decodePfm(View file, const std::string& where);

Bytes encodeExr(const Image& image, float gain, const std::string& where);
Image decodeExr(View file, const std::string& where);

// InputError unless both sides are 1 .. kMaxImageSide.
void checkSides(std::uint64_t width, std::uint64_t height, const std::string& where);

// The picture as R, G, B and nothing else, multiplied by `gain`.
std::vector<float> pictureRgb(const Image& image, float gain);

void append(Bytes& bytes, const std::string& text);

}  // namespace crosslight::codec

// Images from and to files. The format follows the file's extension.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "image/image.h"

namespace crosslight {

enum class ToneMap { none, clamp, reinhard, neutral };

// How linear radiance becomes a display picture (PNG); HDR, PFM and EXR stay linear and ignore all but `exposure`.
struct DisplayTransform {
  ToneMap toneMap = ToneMap::clamp;
  float exposureStops = 0.0f;  // the picture is multiplied by 2^stops before tone mapping
  bool withAlpha = false;      // PNG: write RGBA instead of RGB

  bool operator==(const DisplayTransform&) const = default;
};

// Formats that writeImage knows, from the extension: png, exr, hdr, pfm (any case). UsageError on others.
enum class ImageFormat { png, exr, hdr, pfm };
ImageFormat imageFormatOf(const std::filesystem::path& path);

// Written whole or not at all. EXR carries every layer and the metadata; the others carry the picture only. An image of
// shownCodes becomes a PNG of just these, whatever `display` says.
void writeImage(const std::filesystem::path& path, const Image& image, const DisplayTransform& display = {});

// The PNG file that writeImage would write.
std::vector<std::byte> pngOf(const Image& image, const DisplayTransform& display = {});

// Reads png (sRGB decoded to linear), exr (all layers), hdr, pfm. InputError names file and cause.
Image readImage(const std::filesystem::path& path);

// The picture as the display shows it: 8-bit sRGB, 3 or 4 values per pixel, rows from top to bottom. NaN becomes 0 and
// infinities the largest float before tone mapping; `nonFinite` counts both.
struct DisplayPicture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t channels = 3;
  std::vector<std::uint8_t> codes;
  std::size_t nonFinite = 0;
};
DisplayPicture displayPicture(const Image& image, const DisplayTransform& display);

// The transform for devices to follow bit for bit. What is shown is x = min(max(2^stops * linear, 0), 1), 0 for NaN;
// the word at the upper 16 bits of x is a code << 17 | a bound, and the code of x is one more where the lower 16 bits
// of x are not below the bound.
bool hasCodeTable(const DisplayTransform& display);  // tone maps that do nothing but clamp, without alpha
std::vector<std::uint32_t> displayCodeTable();
float gainOf(const DisplayTransform& display);

// Linear to sRGB and back (IEC 61966-2-1), unclamped, per value.
float srgbFromLinear(float linear);
float linearFromSrgb(float srgb);

// floor(255 srgbFromLinear(linear) + 1/2), by table; values outside [0,1] are clamped, NaN gives 0.
std::uint8_t srgbCodeFromLinear(float linear);

// One pixel's display value in [0,1] for clamp, reinhard and neutral; `none` may exceed it and is clamped by the
// encoder.
struct Rgb {
  float r, g, b;
};
Rgb applyToneMap(Rgb linear, ToneMap toneMap);

}  // namespace crosslight

// Pictures side by side with captions, as one picture: how a person compares methods at a glance.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "image/image_io.h"

namespace crosslight {

struct SheetEntry {
  std::string caption;             // printed below the picture; characters beyond ASCII become "?"
  std::string note{};              // second, paler line; may be empty
  const Image* picture = nullptr;  // of any size
  DisplayTransform display;        // how this picture is shown (alpha is ignored)
};

struct SheetOptions {
  std::string title{};               // on top; may be empty
  std::uint32_t columns = 0;         // 0: chosen so that the sheet is about as wide as a screen
  std::uint32_t maxPictureSide = 0;  // pixels; larger pictures are averaged down by a whole number; 0: no limit
  std::uint32_t textScale = 2;       // pixels per dot of the font, >= 1
};

// At least one entry. Written with ToneMap::none or ToneMap::clamp, the PNG shows every picture's own display codes.
Image makeContactSheet(std::span<const SheetEntry> entries, const SheetOptions& options = {});

}  // namespace crosslight

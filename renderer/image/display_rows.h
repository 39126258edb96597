// The display transform row by row, for encoders that need no whole picture of codes. Private to the room.
#pragma once

#include <optional>
#include <span>

#include "image/image_io.h"

namespace crosslight {

class DisplayRows {
 public:
  DisplayRows(const Image& image, const DisplayTransform& display);  // the image must outlive it
  std::uint32_t channels() const { return withAlpha_ && shownCodes_.empty() ? 4 : 3; }
  // width * channels() codes of one row; returns how many of its values are not finite.
  std::size_t operator()(std::uint32_t row, std::uint8_t* codes) const;

 private:
  std::size_t showRow(std::size_t firstPixel, std::uint8_t* codes) const;

  std::span<const std::uint8_t> shownCodes_;
  std::optional<PixelReader> read_;  // unless there are codes
  std::uint32_t width_;
  float gain_;
  ToneMap toneMap_;
  bool withAlpha_;
};

}  // namespace crosslight

// How far one image is from another, as numbers with a witness: every error names the pixel that is worst. Not a number
// anywhere makes every metric NaN, so that `!(error <= bound)` fails.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "image/image.h"

namespace crosslight {

struct WorstPixel {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  std::string channel;
  float got = 0;
  float reference = 0;
};

struct Metrics {
  static constexpr double kInvalid = std::numeric_limits<double>::quiet_NaN();

  std::size_t values = 0;     // compared: pixels times channels
  std::size_t nonFinite = 0;  // pairs with a NaN or an infinity on either side
  double rmse = kInvalid;
  double mae = kInvalid;  // mean absolute error (not squared)
  double maxAbs = kInvalid;
  double relMse = kInvalid;  // mean of (x - r)^2 / (r^2 + 1e-2)
  double psnrDb = kInvalid;  // 10 log10(peak^2 / mse); infinite for equal images
  WorstPixel worst;          // largest absolute error; the first non-finite pair if there is one

  bool valid() const { return values > 0 && nonFinite == 0; }
};

struct MetricOptions {
  std::string layer{};                   // "" is the picture
  bool withAlpha = false;                // compare the channel A too
  double peak = 1;                       // of the PSNR
  std::span<const std::uint8_t> mask{};  // one per pixel, 0 leaves it out; empty: all pixels
};

// Channels are paired by name. InputError if a layer is missing in one image, holds ids, or the sizes or channels
// differ.
Metrics measureImages(const Image& got, const Image& reference, const MetricOptions& options = {});

// One line for a log: the metrics and the worst pixel with both values.
std::string describe(const Metrics& metrics);

// Agreement of ids at interior pixels: those where each image has one and the same id in the 3 x 3 pixels around them.
// There no edge is near, so that two renderers that differ by a fraction of a pixel must agree. Pixels of the image's
// border have no 3 x 3 pixels and do not count.
struct IdAgreement {
  struct Disagreement {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t got = 0;
    std::uint32_t reference = 0;
  };

  std::size_t interior = 0;
  std::size_t agreeing = 0;
  std::optional<Disagreement> first;  // in reading order

  // NaN without an interior pixel: `!(share >= bound)` fails.
  double share() const { return static_cast<double>(agreeing) / static_cast<double>(interior); }
};

// InputError if the layer or the channel is missing in one image or holds no ids, or if the sizes differ.
IdAgreement idAgreement(const Image& got, const Image& reference, const std::string& layer, const std::string& channel);

}  // namespace crosslight

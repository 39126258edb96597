// From linear radiance to what a display shows: exposure, tone map, sRGB transfer, 8-bit codes.
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "image/display_rows.h"
#include "image/row_threads.h"

namespace crosslight {

// IEC 61966-2-1:1999, "Colour management - Default RGB colour space - sRGB". In double, so that the result is the
// formula's value rounded once.
float srgbFromLinear(float linear) {
  const double x = linear;
  return static_cast<float>(x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055);
}

float linearFromSrgb(float srgb) {
  const double x = srgb;
  return static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
}

namespace {

// codeFirst[b] is the code of the smallest float whose upper 16 bits are b; threshold[k] the smallest float that gets
// a code >= k. A bucket spans 1/128 of its value at most, over which the code grows by 112 x^(1/2.4) / 128 < 1: a
// lookup and at most one step.
struct CodeTable {
  static constexpr std::uint32_t kOne = std::bit_cast<std::uint32_t>(1.0f);
  static constexpr std::uint32_t kShift = 16;
  std::array<float, 257> threshold;
  std::array<std::uint8_t, (kOne >> kShift) + 1> codeFirst;

  static int codeOf(float linear) { return static_cast<int>(std::floor(255.0 * srgbFromLinear(linear) + 0.5)); }

  CodeTable() {
    threshold[0] = 0;
    threshold[256] = std::numeric_limits<float>::infinity();
    for (int code = 1; code < 256; ++code) {
      // Bit patterns of floats >= 0 are in the order of their values. The inverse is off by a few of them at most.
      const float guess = linearFromSrgb(static_cast<float>((code - 0.5) / 255.0));
      std::uint32_t below = std::bit_cast<std::uint32_t>(guess), above = below, step = 1;
      while (codeOf(std::bit_cast<float>(below)) >= code) below -= step *= 2;
      while (codeOf(std::bit_cast<float>(above)) < code) above += step *= 2;
      while (above - below > 1) {
        const std::uint32_t middle = below + (above - below) / 2;
        (codeOf(std::bit_cast<float>(middle)) >= code ? above : below) = middle;
      }
      threshold[static_cast<std::size_t>(code)] = std::bit_cast<float>(above);
    }
    std::size_t code = 0;
    for (std::size_t b = 0; b < codeFirst.size(); ++b) {
      while (std::bit_cast<float>(static_cast<std::uint32_t>(b) << kShift) >= threshold[code + 1]) ++code;
      codeFirst[b] = static_cast<std::uint8_t>(code);
    }
  }

  std::vector<std::uint32_t> words() const {
    std::vector<std::uint32_t> all;
    for (std::uint32_t b = 0; b < codeFirst.size(); ++b) {
      const auto next = std::bit_cast<std::uint32_t>(threshold[std::size_t{codeFirst[b]} + 1]);
      const std::uint32_t none = 1u << kShift;  // above all lower bits
      all.push_back(std::uint32_t{codeFirst[b]} << 17 | (next >> kShift == b ? next & (none - 1) : none));
    }
    return all;
  }

  // For 0 <= x <= 1.
  std::uint8_t operator()(float x) const {
    const std::size_t code = codeFirst[std::bit_cast<std::uint32_t>(x) >> kShift];
    return static_cast<std::uint8_t>(code + (x >= threshold[code + 1] ? 1 : 0));
  }
};

// Khronos PBR Neutral Tone Mapper, specification 1.0 (Khronos Group 2024): below the start of compression the color
// only loses the 4 % that a dielectric's reflection adds, above it the peak approaches 1 and the color white.
Rgb toneMapNeutral(Rgb c) {
  constexpr float kF90 = 0.04f, kStart = 0.8f - kF90, kDesaturation = 0.15f;
  const float least = std::min({c.r, c.g, c.b});
  const float offset = least < 2 * kF90 ? least - least * least / (4 * kF90) : kF90;
  const Rgb shifted{c.r - offset, c.g - offset, c.b - offset};
  const float peak = std::max({shifted.r, shifted.g, shifted.b});
  if (peak <= kStart) return shifted;
  const float room = 1 - kStart;
  const float newPeak = 1 - room * room / (peak + room - kStart);
  const float scale = newPeak / peak;
  const float kept = 1 / (kDesaturation * (peak - newPeak) + 1);
  const auto mix = [&](float x) { return newPeak + (x * scale - newPeak) * kept; };
  return {mix(shifted.r), mix(shifted.g), mix(shifted.b)};
}

const CodeTable& codeTable() {
  static const CodeTable table;
  return table;
}

// Not below 0, not above 1, and never NaN.
float clamp01(float x) { return x > 0 ? std::min(x, 1.0f) : 0.0f; }
Rgb clamp01(Rgb c) { return {clamp01(c.r), clamp01(c.g), clamp01(c.b)}; }

// Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images", Eq. 3, on each channel.
float reinhard(float x) { return x > 0 ? x / (1 + x) : 0.0f; }

}  // namespace

bool hasCodeTable(const DisplayTransform& display) {
  return !display.withAlpha && (display.toneMap == ToneMap::none || display.toneMap == ToneMap::clamp);
}
std::vector<std::uint32_t> displayCodeTable() { return codeTable().words(); }
float gainOf(const DisplayTransform& display) { return std::exp2(display.exposureStops); }

std::uint8_t srgbCodeFromLinear(float linear) { return codeTable()(clamp01(linear)); }

Rgb applyToneMap(Rgb linear, ToneMap toneMap) {
  switch (toneMap) {
    case ToneMap::none:
      return linear;
    case ToneMap::clamp:
      return clamp01(linear);
    case ToneMap::reinhard:
      return clamp01(Rgb{reinhard(linear.r), reinhard(linear.g), reinhard(linear.b)});
    case ToneMap::neutral:
      return clamp01(toneMapNeutral({std::max(linear.r, 0.0f), std::max(linear.g, 0.0f), std::max(linear.b, 0.0f)}));
  }
  return linear;
}

DisplayRows::DisplayRows(const Image& image, const DisplayTransform& display)
    : shownCodes_(image.shownCodes),
      width_(image.width),
      gain_(gainOf(display)),
      toneMap_(display.toneMap),
      withAlpha_(display.withAlpha) {
  if (shownCodes_.empty()) read_.emplace(image, image.picture());
}

namespace {

// Adds what is not finite to `count` and replaces NaN by 0.
void replaceNonFinite(float (&p)[4], int channels, std::size_t& count) {
  for (int c = 0; c < channels; ++c) {
    if (std::isfinite(p[c])) continue;
    ++count;
    if (std::isnan(p[c])) p[c] = 0;
  }
}

}  // namespace

std::size_t DisplayRows::operator()(std::uint32_t row, std::uint8_t* codes) const {
  const std::size_t first = std::size_t{row} * width_;
  if (shownCodes_.empty()) return showRow(first, codes);
  const std::size_t count = std::size_t{3} * width_;
  std::memcpy(codes, shownCodes_.data() + 3 * first, count);
  return 0;
}

std::size_t DisplayRows::showRow(std::size_t first, std::uint8_t* codes) const {
  static constexpr float kLargest = std::numeric_limits<float>::max();
  const CodeTable& table = codeTable();
  const bool maps = toneMap_ == ToneMap::reinhard || toneMap_ == ToneMap::neutral;
  std::size_t nonFinite = 0;
  for (std::size_t i = first; i < first + width_; ++i) {
    float p[4];
    (*read_)(i, p);
    // A sum that is finite has finite terms.
    if (!std::isfinite(p[0] + p[1] + p[2] + p[3])) replaceNonFinite(p, withAlpha_ ? 4 : 3, nonFinite);
    Rgb shown{p[0] * gain_, p[1] * gain_, p[2] * gain_};
    if (maps) {
      const auto bound = [](float x) { return std::clamp(x, -kLargest, kLargest); };
      shown = applyToneMap({bound(shown.r), bound(shown.g), bound(shown.b)}, toneMap_);
    }
    *codes++ = table(clamp01(shown.r));
    *codes++ = table(clamp01(shown.g));
    *codes++ = table(clamp01(shown.b));
    if (withAlpha_) *codes++ = static_cast<std::uint8_t>(std::floor(255.0 * clamp01(p[3]) + 0.5));
  }
  return nonFinite;
}

DisplayPicture displayPicture(const Image& image, const DisplayTransform& display) {
  DisplayPicture result;
  result.width = image.width;
  result.height = image.height;
  const DisplayRows rows(image, display);
  result.channels = rows.channels();
  result.codes.resize(image.pixels() * result.channels);
  const std::size_t rowCodes = std::size_t{image.width} * result.channels;
  std::atomic<std::size_t> nonFinite{0};
  forRowRanges(image.height, rowCodes, [&](std::uint32_t first, std::uint32_t end) {
    std::size_t found = 0;
    for (std::uint32_t row = first; row < end; ++row) found += rows(row, result.codes.data() + row * rowCodes);
    nonFinite += found;
  });
  result.nonFinite = nonFinite;
  return result;
}

}  // namespace crosslight

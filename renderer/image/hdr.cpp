// Radiance RGBE pictures (Ward 1991, "Real Pixels", Graphics Gems II; Radiance's ray/src/common/color.c for the run
// lengths). Not stb's: its writer truncates mantissas (twice the error), its reader takes a cut file for black pixels.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "base/error.h"
#include "base/log.h"
#include "image/codecs.h"

namespace crosslight::codec {
namespace {

constexpr std::size_t kMinRun = 4, kMaxRun = 127, kMaxLiteral = 128;
// Widths outside this range have no run lengths: the marker holds 15 bits, and short lines would not profit.
constexpr std::size_t kMinRunWidth = 8, kMaxRunWidth = 32767;
constexpr int kExponentBias = 128, kMantissaBits = 8;

using Rgbe = std::array<std::uint8_t, 4>;

// The largest component's mantissa lies in [128, 255] after rounding, so every component is within half a unit of it:
// at most 1/256 of the largest.
Rgbe rgbeOf(const float* rgb) {
  const float largest = std::max({rgb[0], rgb[1], rgb[2]});
  if (!(largest > 0)) return {};
  int exponent = 0;
  std::frexp(largest, &exponent);
  if (std::lround(std::ldexp(largest, kMantissaBits - exponent)) > 255) ++exponent;
  if (exponent + kExponentBias < 1) return {};  // below 2^-128: half a unit of the smallest scale
  exponent = std::min(exponent, 255 - kExponentBias);
  Rgbe pixel{};
  for (std::size_t c = 0; c < 3; ++c) {
    const long mantissa = std::lround(std::ldexp(std::max(rgb[c], 0.0f), kMantissaBits - exponent));
    pixel[c] = static_cast<std::uint8_t>(std::min(mantissa, 255L));
  }
  pixel[3] = static_cast<std::uint8_t>(exponent + kExponentBias);
  return pixel;
}

void put(Bytes& bytes, std::size_t value) { bytes.push_back(static_cast<std::byte>(value)); }

void encodeRuns(Bytes& out, const std::vector<Rgbe>& row, std::size_t component) {
  const auto runAt = [&](std::size_t x) {
    std::size_t end = x + 1;
    while (end < row.size() && end - x < kMaxRun && row[end][component] == row[x][component]) ++end;
    return end - x;
  };
  for (std::size_t x = 0; x < row.size();) {
    const std::size_t run = runAt(x);
    if (run >= kMinRun) {
      put(out, 128 + run);
      put(out, row[x][component]);
      x += run;
      continue;
    }
    std::size_t end = x;
    while (end < row.size() && end - x < kMaxLiteral) {
      const std::size_t next = runAt(end);
      if (next >= kMinRun) break;
      end += next;
    }
    end = std::min(end, x + kMaxLiteral);
    put(out, end - x);
    for (; x < end; ++x) put(out, row[x][component]);
  }
}

// NaN and what is below 0 cannot be stored; infinity becomes the largest value.
std::size_t makeStorable(std::vector<float>& rgb) {
  std::size_t changed = 0;
  for (float& value : rgb) {
    if (std::isfinite(value) && value >= 0) continue;
    ++changed;
    value = value > 0 ? std::numeric_limits<float>::max() : 0.0f;
  }
  return changed;
}

class Reader {
 public:
  Reader(View file, const std::string& where) : file_(file), where_(where) {}

  [[noreturn]] void fail(const std::string& what) const { throw InputError(where_, what); }
  std::size_t left() const { return file_.size() - at_; }
  std::uint8_t byte() {
    if (at_ >= file_.size()) fail("ends early: pixels are missing");
    return static_cast<std::uint8_t>(file_[at_++]);
  }
  std::string line() {
    constexpr std::size_t kLongest = 4096;
    std::string text;
    while (true) {
      if (at_ >= file_.size() || text.size() > kLongest)
        fail("has a broken header: no end of line, or none of the header");
      const char c = static_cast<char>(file_[at_++]);
      if (c == '\n') return text;
      if (c != '\r') text += c;
    }
  }
  void row(std::vector<Rgbe>& pixels);

 private:
  void runs(std::vector<Rgbe>& pixels);

  View file_;
  const std::string& where_;
  std::size_t at_ = 0;
};

void Reader::runs(std::vector<Rgbe>& pixels) {
  for (std::size_t component = 0; component < 4; ++component) {
    for (std::size_t x = 0; x < pixels.size();) {
      const std::size_t code = byte();
      const bool repeats = code > 128;
      const std::size_t count = repeats ? code - 128 : code;
      if (count == 0 || count > pixels.size() - x) fail("has a broken run length");
      std::uint8_t value = repeats ? byte() : std::uint8_t{0};
      for (std::size_t i = 0; i < count; ++i) {
        if (!repeats) value = byte();
        pixels[x++][component] = value;
      }
    }
  }
}

void Reader::row(std::vector<Rgbe>& pixels) {
  for (std::size_t x = 0; x < pixels.size(); ++x) {
    Rgbe& p = pixels[x];
    for (std::uint8_t& value : p) value = byte();
    const bool marker = p[0] == 2 && p[1] == 2 && p[2] < 128;
    if (x == 0 && marker && pixels.size() >= kMinRunWidth && pixels.size() <= kMaxRunWidth) {
      if (std::size_t{p[2]} * 256 + p[3] != pixels.size())
        fail("has a scan line of another width than its header says");
      return runs(pixels);
    }
    if (p[0] == 1 && p[1] == 1 && p[2] == 1)
      fail("uses the run lengths of before 1991; convert it with Radiance's ra_rgbe");
  }
}

template <class T>
bool parse(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

// "-Y height +X width": rows from top to bottom, as every common writer has it.
void parseSize(const Reader& reader, std::string_view line, std::uint32_t& width, std::uint32_t& height) {
  constexpr std::string_view kY = "-Y ", kX = " +X ";
  const std::size_t x = line.find(kX);
  if (!line.starts_with(kY) || x == std::string_view::npos || !parse(line.substr(kY.size(), x - kY.size()), height) ||
      !parse(line.substr(x + kX.size()), width)) {
    reader.fail("has the size \"" + std::string(line) + "\"; only \"-Y height +X width\" is supported");
  }
}

// Product of the EXPOSURE lines: the file's values are radiance times it.
double parseLines(Reader& reader) {
  if (!reader.line().starts_with("#?")) reader.fail("is not a Radiance picture: it must start with #?");
  double exposure = 1;
  bool rgbe = false;
  for (std::string line = reader.line(); !line.empty(); line = reader.line()) {
    if (line == "FORMAT=32-bit_rle_rgbe") rgbe = true;
    double factor = 0;
    constexpr std::string_view kExposure = "EXPOSURE=";
    if (!line.starts_with(kExposure)) continue;
    const std::size_t number = std::min(line.find_first_not_of(' ', kExposure.size()), line.size());
    if (!parse(std::string_view(line).substr(number), factor) || !std::isfinite(factor) || !(factor > 0)) {
      reader.fail("has the broken line \"" + line + "\"");
    }
    exposure *= factor;
  }
  if (!rgbe) reader.fail("is not in the format 32-bit_rle_rgbe (XYZE is not supported)");
  return exposure;
}

}  // namespace

Bytes encodeHdr(const Image& image, float gain, const std::string& where) {
  std::vector<float> rgb = pictureRgb(image, gain);
  if (const std::size_t changed = makeStorable(rgb); changed > 0) {
    logWarning(where + ": " + std::to_string(changed) +
               " values are negative or not finite and cannot be stored as RGBE (written as 0, +infinity as the "
               "largest value)");
  }
  Bytes bytes;
  append(bytes, "#?RADIANCE\nSOFTWARE=crosslight\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(image.height) +
                    " +X " + std::to_string(image.width) + "\n");
  std::vector<Rgbe> row(image.width);
  for (std::size_t y = 0; y < image.height; ++y) {
    for (std::size_t x = 0; x < row.size(); ++x) row[x] = rgbeOf(rgb.data() + 3 * (y * row.size() + x));
    if (row.size() < kMinRunWidth || row.size() > kMaxRunWidth) {
      for (const Rgbe& p : row) {
        for (const std::uint8_t value : p) put(bytes, value);
      }
      continue;
    }
    for (const std::size_t value : {std::size_t{2}, std::size_t{2}, row.size() / 256, row.size() % 256})
      put(bytes, value);
    for (std::size_t component = 0; component < 4; ++component) encodeRuns(bytes, row, component);
  }
  return bytes;
}

Image decodeHdr(View file, const std::string& where) {
  Reader reader(file, where);
  const double exposure = parseLines(reader);
  Image image;
  parseSize(reader, reader.line(), image.width, image.height);
  checkSides(image.width, image.height, where);
  // Two bytes make at most a run of 127, so a pixel's four components take at least 8/127 of a byte.
  if (reader.left() < image.pixels() * 8 / 127) reader.fail("is too short for the size that its header gives");
  Layer& layer = addLayer(image, "", {"R", "G", "B"});
  std::vector<Rgbe> row(image.width);
  float* out = layer.samples.data();
  for (std::uint32_t y = 0; y < image.height; ++y) {
    reader.row(row);
    for (const Rgbe& p : row) {
      const double scale = p[3] == 0 ? 0.0 : std::ldexp(1.0, p[3] - kExponentBias - kMantissaBits) / exposure;
      for (std::size_t c = 0; c < 3; ++c) *out++ = static_cast<float>(p[c] * scale);
    }
  }
  return image;
}

}  // namespace crosslight::codec

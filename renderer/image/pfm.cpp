// Portable float map (Debevec, "Portable FloatMap Image Format"): text header, then raw floats, bottom row first; a
// negative scale means little-endian.
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include "base/error.h"
#include "image/codecs.h"

namespace crosslight::codec {
namespace {

static_assert(std::endian::native == std::endian::little, "PFM samples are copied as they lie in memory");

struct Header {
  std::size_t channels = 0;
  std::uint32_t width = 0, height = 0;
  bool bigEndian = false;
  std::size_t end = 0;  // offset of the first sample
};

bool isSpace(std::byte b) {
  return b == std::byte{' '} || b == std::byte{'\n'} || b == std::byte{'\r'} || b == std::byte{'\t'};
}

// Next word and the offset of the one white-space character that ends it.
std::string nextWord(View file, std::size_t& at) {
  constexpr std::size_t kLongest = 64;
  while (at < file.size() && isSpace(file[at])) ++at;
  std::string word;
  while (at < file.size() && !isSpace(file[at]) && word.size() < kLongest) word += static_cast<char>(file[at++]);
  return word;
}

template <class T>
std::optional<T> numberOf(const std::string& word) {
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

Header parseHeader(View file, const std::string& where) {
  Header header;
  std::size_t at = 0;
  const std::string magic = nextWord(file, at);
  if (magic != "PF" && magic != "Pf") throw InputError(where, "is not a PFM file: it must start with PF or Pf");
  header.channels = magic == "PF" ? 3 : 1;
  const auto width = numberOf<std::uint32_t>(nextWord(file, at));
  const auto height = numberOf<std::uint32_t>(nextWord(file, at));
  const auto scale = numberOf<double>(nextWord(file, at));
  if (!width || !height || !scale || !std::isfinite(*scale) || *scale == 0 || at >= file.size()) {
    throw InputError(where, "has a broken PFM header: width, height and a scale other than 0 must follow PF or Pf");
  }
  checkSides(*width, *height, where);
  header.width = *width;
  header.height = *height;
  header.bigEndian = *scale > 0;
  header.end = at + 1;
  return header;
}

float swapped(float value) {
  const auto b = std::bit_cast<std::uint32_t>(value);
  return std::bit_cast<float>((b >> 24) | ((b >> 8) & 0xff00u) | ((b << 8) & 0xff0000u) | (b << 24));
}

}  // namespace

Bytes encodePfm(const Image& image, float gain) {
  const bool gray = image.picture().channels() == 1;
  const std::size_t channels = gray ? 1 : 3;
  const std::vector<float> rgb = pictureRgb(image, gain);
  Bytes bytes;
  append(bytes,
         (gray ? "Pf\n" : "PF\n") + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n");
  const std::size_t start = bytes.size(), rowBytes = image.width * channels * sizeof(float);
  bytes.resize(start + rowBytes * image.height);
  std::byte* out = bytes.data() + start;
  for (std::size_t y = image.height; y-- > 0;) {
    const float* row = rgb.data() + y * image.width * 3;
    for (std::size_t x = 0; x < image.width; ++x, out += channels * sizeof(float)) {
      std::memcpy(out, row + 3 * x, channels * sizeof(float));
    }
  }
  return bytes;
}

Image decodePfm(View file, const std::string& where) {
  const Header header = parseHeader(file, where);
  const std::size_t rowValues = header.width * header.channels, rowBytes = rowValues * sizeof(float);
  if (file.size() - header.end < rowBytes * header.height) {
    throw InputError(where, "ends early: it has " + std::to_string(file.size() - header.end) +
                                " bytes of samples and needs " + std::to_string(rowBytes * header.height));
  }
  Image image;
  image.width = header.width;
  image.height = header.height;
  Layer& layer = addLayer(
      image, "", header.channels == 3 ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"});
  for (std::size_t y = 0; y < header.height; ++y) {
    const std::size_t fileRow = header.height - 1 - y;
    std::memcpy(layer.samples.data() + y * rowValues, file.data() + header.end + fileRow * rowBytes, rowBytes);
  }
  if (header.bigEndian) {
    for (float& sample : layer.samples) sample = swapped(sample);
  }
  return image;
}

}  // namespace crosslight::codec

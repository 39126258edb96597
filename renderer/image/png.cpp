// PNG: rows are shown, filtered and packed here, deflate is libdeflate's. Reading is stb's, the only place of this room
// that sees it; it is static here, because tinygltf brings its own copy.
#include <libdeflate.h>

#include <atomic>
#include <climits>
#include <cstdlib>
#include <memory>

#include "base/check.h"
#include "base/error.h"
#include "base/log.h"
#include "image/codecs.h"
#include "image/display_rows.h"
#include "image/png_chunks.h"
#include "image/row_threads.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace crosslight::codec {
namespace {

// One filter for all rows: choosing per row costs five passes over the data, and "up" suits rendered pictures. Level 1
// makes files 8 % larger than level 4 in half the time (teapot 512x512, overview 2000x2000; Sapphire Rapids,
// 2026-11-23).
constexpr std::uint8_t kFilterUp = 2;
constexpr int kCompressionLevel = 1;

struct Free {
  void operator()(void* p) const { std::free(p); }
};

// Memory that nobody sets to zero first: a page that is not written costs nothing.
struct RawBytes {
  explicit RawBytes(std::size_t sizeBytes) : size(sizeBytes), data(std::make_unique_for_overwrite<std::byte[]>(size)) {}
  std::size_t size;
  std::unique_ptr<std::byte[]> data;
};

// Every row's filter and its codes less those of the row above. A range begins by showing the row above it once more.
RawBytes filteredRows(const Image& image, const DisplayTransform& display, const std::string& where) {
  const DisplayRows shown(image, display);
  const std::size_t rowCodes = std::size_t{image.width} * shown.channels();
  RawBytes filtered((rowCodes + 1) * image.height);
  std::atomic<std::size_t> nonFinite{0};
  forRowRanges(image.height, rowCodes, [&](std::uint32_t first, std::uint32_t end) {
    std::vector<std::uint8_t> above(rowCodes, 0), codes(rowCodes);
    if (first > 0) shown(first - 1, above.data());
    std::size_t found = 0;
    for (std::uint32_t row = first; row < end; ++row) {
      found += shown(row, codes.data());
      std::byte* out = filtered.data.get() + row * (rowCodes + 1);
      *out++ = std::byte{kFilterUp};
      for (std::size_t i = 0; i < rowCodes; ++i) out[i] = static_cast<std::byte>(codes[i] - above[i]);
      std::swap(above, codes);
    }
    nonFinite += found;
  });
  if (nonFinite > 0) {
    logWarning(where + ": " + std::to_string(nonFinite) + " values of the picture are not finite (NaN is shown as 0)");
  }
  return filtered;
}

struct FreeCompressor {
  void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
};

RawBytes zlibStream(const RawBytes& data) {
  const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
      libdeflate_alloc_compressor(kCompressionLevel));
  if (compressor == nullptr) throw std::bad_alloc();
  RawBytes packed(libdeflate_zlib_compress_bound(compressor.get(), data.size));
  packed.size = libdeflate_zlib_compress(compressor.get(), data.data.get(), data.size, packed.data.get(), packed.size);
  CL_CHECK(packed.size > 0);
  return packed;
}

struct Decoded {
  std::unique_ptr<void, Free> samples;
  int width = 0, height = 0, channels = 0;
};

Decoded decodeWithStb(View file, bool wide, const std::string& where) {
  if (file.size() > INT_MAX) throw InputError(where, "is too large for a PNG file");
  Decoded result;
  const auto* data = reinterpret_cast<const stbi_uc*>(file.data());
  const int size = static_cast<int>(file.size());
  if (stbi_info_from_memory(data, size, &result.width, &result.height, &result.channels) == 0) {
    throw InputError(where, std::string("cannot be decoded: ") + stbi_failure_reason());
  }
  const int wanted = result.channels == 2 || result.channels == 4 ? 4 : 3;
  if (wide) {
    result.samples.reset(stbi_load_16_from_memory(data, size, &result.width, &result.height, &result.channels, wanted));
  } else {
    result.samples.reset(stbi_load_from_memory(data, size, &result.width, &result.height, &result.channels, wanted));
  }
  if (result.samples == nullptr) throw InputError(where, std::string("cannot be decoded: ") + stbi_failure_reason());
  result.channels = wanted;
  return result;
}

template <class Code>
void linearize(const Decoded& decoded, float codeMax, std::vector<float>& samples) {
  const auto* codes = static_cast<const Code*>(decoded.samples.get());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const float value = static_cast<float>(codes[i]) / codeMax;
    samples[i] = decoded.channels == 4 && i % 4 == 3 ? value : linearFromSrgb(value);
  }
}

}  // namespace

Bytes encodePng(const Image& image, const DisplayTransform& display, const std::string& where) {
  const RawBytes packed = zlibStream(filteredRows(image, display, where));
  return pngFile(image.width, image.height, DisplayRows(image, display).channels(), image.metadata,
                 View(packed.data.get(), packed.size));
}

Image decodePng(View file, const std::string& where) {
  const bool wide = checkPng(file, where).bitDepth == 16;
  const Decoded decoded = decodeWithStb(file, wide, where);
  Image image;
  image.width = static_cast<std::uint32_t>(decoded.width);
  image.height = static_cast<std::uint32_t>(decoded.height);
  Layer& layer = addLayer(image, "", {"R", "G", "B"});
  if (decoded.channels == 4) layer.channelNames.push_back("A");
  layer.samples.resize(image.pixels() * layer.channels());
  if (wide) {
    linearize<stbi_us>(decoded, 65535.0f, layer.samples);
  } else {
    linearize<stbi_uc>(decoded, 255.0f, layer.samples);
  }
  return image;
}

}  // namespace crosslight::codec

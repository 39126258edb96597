// PNG through stb, the only place of this room that sees it. stb is static here, because tinygltf brings its own copy.
// Deflate is libdeflate's: stb's own is slower and packs worse.
#include <libdeflate.h>

#include <climits>
#include <cstdlib>
#include <memory>

#include "base/check.h"
#include "base/error.h"
#include "base/log.h"
#include "image/codecs.h"
#include "image/png_chunks.h"

namespace {

// Called by stb, which frees the result with free().
unsigned char* compressZlib(unsigned char* data, int size, int* compressedSize, int level) {
  libdeflate_compressor* const compressor = libdeflate_alloc_compressor(level);
  if (compressor == nullptr) return nullptr;
  const std::size_t bound = libdeflate_zlib_compress_bound(compressor, static_cast<std::size_t>(size));
  auto* out = static_cast<unsigned char*>(std::malloc(bound));
  if (out != nullptr) {
    *compressedSize =
        static_cast<int>(libdeflate_zlib_compress(compressor, data, static_cast<std::size_t>(size), out, bound));
  }
  libdeflate_free_compressor(compressor);
  return out;
}

}  // namespace

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#define STBIW_ZLIB_COMPRESS compressZlib
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace crosslight::codec {
namespace {

// One filter for all rows: choosing per row, as stb does by default, costs five passes over the data. "Up" suits
// rendered pictures; level 4 is where libdeflate's greedy matching starts to pay.
constexpr int kFilterUp = 2, kCompressionLevel = 4;

struct Free {
  void operator()(void* p) const { std::free(p); }
};

Bytes encodeWithStb(const DisplayPicture& picture, const std::string& where) {
  // Set once: every call wants the same values, and stb keeps them in globals.
  static const bool configured = [] {
    stbi_write_force_png_filter = kFilterUp;
    stbi_write_png_compression_level = kCompressionLevel;
    return true;
  }();
  CL_CHECK(configured);
  const std::uint64_t rowBytes = std::uint64_t{picture.width} * picture.channels + 1;
  // stb counts in int, libdeflate's bound is larger than its input by a block header per 10000 bytes and a few more.
  if (rowBytes * picture.height > std::uint64_t{INT_MAX} / 2)
    throw InputError(where, "the picture is too large for PNG; write EXR");
  int size = 0;
  const std::unique_ptr<unsigned char, Free> file(stbi_write_png_to_mem(
      picture.codes.data(), static_cast<int>(picture.width * picture.channels), static_cast<int>(picture.width),
      static_cast<int>(picture.height), static_cast<int>(picture.channels), &size));
  CL_CHECK(file != nullptr && size > 0);
  const auto* first = reinterpret_cast<const std::byte*>(file.get());
  return Bytes(first, first + size);
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
  const DisplayPicture picture = displayPicture(image, display);
  if (picture.nonFinite > 0) {
    logWarning(where + ": " + std::to_string(picture.nonFinite) +
               " values of the picture are not finite (NaN is shown as 0)");
  }
  return withPngInfo(encodeWithStb(picture, where), image.metadata);
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

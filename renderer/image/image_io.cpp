// Chooses the codec by the file's extension; the codecs know nothing of each other.
#include "image/image_io.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/error.h"
#include "base/file.h"
#include "image/codecs.h"

namespace crosslight {
namespace codec {

void checkSides(std::uint64_t width, std::uint64_t height, const std::string& where) {
  if (width >= 1 && height >= 1 && width <= kMaxImageSide && height <= kMaxImageSide) return;
  throw InputError(where, "has a size of " + std::to_string(width) + " x " + std::to_string(height) +
                              "; each side must be 1 to " + std::to_string(kMaxImageSide));
}

std::vector<float> pictureRgb(const Image& image, float gain) {
  std::vector<float> rgb(image.pixels() * 3);
  const PixelReader read(image, image.picture());
  float* out = rgb.data();
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    float p[4];
    read(i, p);
    // Not times 1: that would change the bits of a signaling NaN.
    for (int c = 0; c < 3; ++c) *out++ = gain == 1.0f ? p[c] : p[c] * gain;
  }
  return rgb;
}

void append(Bytes& bytes, const std::string& text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  bytes.insert(bytes.end(), first, first + text.size());
}

}  // namespace codec

namespace {

void checkLayers(const Image& image) {
  CL_CHECK(!image.layers.empty());
  if (!image.shownCodes.empty()) {
    CL_CHECK_EQ(image.shownCodes.size(), 3 * image.pixels());
    return;
  }
  for (const Layer& layer : image.layers) {
    const std::size_t values = image.pixels() * layer.channels();
    CL_CHECK_EQ(layer.samples.size(), layer.isInteger ? 0 : values);
    CL_CHECK_EQ(layer.integers.size(), layer.isInteger ? values : 0);
  }
}

}  // namespace

ImageFormat imageFormatOf(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (extension == ".png") return ImageFormat::png;
  if (extension == ".exr") return ImageFormat::exr;
  if (extension == ".hdr") return ImageFormat::hdr;
  if (extension == ".pfm") return ImageFormat::pfm;
  throw UsageError("\"" + path.string() +
                   "\": the image format follows the file's extension, which must be .png, .exr, .hdr or .pfm");
}

void writeImage(const std::filesystem::path& path, const Image& image, const DisplayTransform& display) {
  const ImageFormat format = imageFormatOf(path);
  const std::string where = path.string();
  codec::checkSides(image.width, image.height, where);
  checkLayers(image);
  CL_CHECK(image.shownCodes.empty() || format == ImageFormat::png);
  const float gain = gainOf(display);
  const codec::Bytes file = [&] {
    switch (format) {
      case ImageFormat::png:
        return codec::encodePng(image, display, where);
      case ImageFormat::exr:
        return codec::encodeExr(image, gain, where);
      case ImageFormat::hdr:
        return codec::encodeHdr(image, gain, where);
      case ImageFormat::pfm:
        return codec::encodePfm(image, gain);
    }
    throw InternalError("an image format without an encoder");
  }();
  writeFileAtomically(path, codec::View(file));
}

std::vector<std::byte> pngOf(const Image& image, const DisplayTransform& display) {
  return codec::encodePng(image, display, "picture");
}

Image readImage(const std::filesystem::path& path) {
  const ImageFormat format = imageFormatOf(path);
  const codec::Bytes file = readFile(path);
  const std::string where = path.string();
  switch (format) {
    case ImageFormat::png:
      return codec::decodePng(file, where);
    case ImageFormat::exr:
      return codec::decodeExr(file, where);
    case ImageFormat::hdr:
      return codec::decodeHdr(file, where);
    case ImageFormat::pfm:
      return codec::decodePfm(file, where);
  }
  throw InternalError("an image format without a decoder");
}

}  // namespace crosslight

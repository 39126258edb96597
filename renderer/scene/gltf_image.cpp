// Decodes the images of textures with stb_image. Sizes are checked against the budget before anything is decoded, and
// the decoder's own memory is bounded: a small file can claim to inflate to gigabytes.
#include "scene/gltf_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "scene/gltf_jpeg.h"

namespace {

// Bytes that the decoder may still take on this thread; every block remembers its size in front of itself.
thread_local std::size_t decoderBytesLeft = 0;
constexpr std::size_t kBlockHeaderBytes = alignof(std::max_align_t);

void* boundedMalloc(std::size_t size) {
  if (size > decoderBytesLeft) return nullptr;
  // Zeros: the decoder reads tables that a broken file never filled.
  auto* block = static_cast<unsigned char*>(std::calloc(size + kBlockHeaderBytes, 1));
  if (block == nullptr) return nullptr;
  decoderBytesLeft -= size;
  std::memcpy(block, &size, sizeof(size));
  return block + kBlockHeaderBytes;
}

std::size_t blockSize(void* pointer) {
  std::size_t size = 0;
  std::memcpy(&size, static_cast<unsigned char*>(pointer) - kBlockHeaderBytes, sizeof(size));
  return size;
}

void boundedFree(void* pointer) {
  if (pointer == nullptr) return;
  decoderBytesLeft += blockSize(pointer);
  std::free(static_cast<unsigned char*>(pointer) - kBlockHeaderBytes);
}

void* boundedRealloc(void* pointer, std::size_t size) {
  void* fresh = boundedMalloc(size);
  if (fresh == nullptr || pointer == nullptr) return fresh;
  std::memcpy(fresh, pointer, std::min(size, blockSize(pointer)));
  boundedFree(pointer);
  return fresh;
}

}  // namespace

// A broken invariant of the decoder is the file's fault and must not end the program; loadScene makes an InputError of
// it.
#define STBI_ASSERT(condition) \
  ((condition) ? static_cast<void>(0) : throw std::runtime_error("image decoder: " #condition))
#define STBI_MALLOC(size) boundedMalloc(size)
#define STBI_REALLOC(pointer, size) boundedRealloc(pointer, size)
#define STBI_FREE(pointer) boundedFree(pointer)
#define STBI_MAX_DIMENSIONS 32768
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_FAILURE_STRINGS
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace crosslight::gltf {
namespace {

bool isPng(const Bytes& bytes) { return bytes.size() >= 8 && std::memcmp(bytes.data(), "\x89PNG\r\n\x1a\n", 8) == 0; }

bool isJpeg(const Bytes& bytes) { return bytes.size() >= 3 && std::memcmp(bytes.data(), "\xFF\xD8\xFF", 3) == 0; }

// Rows with their filter bytes, the same once more unfiltered at 16 bits, RGBA copies of both, and the same again
// while a buffer doubles: 64 bytes per pixel and a little for the tables.
std::size_t decoderBytes(std::size_t pixels, std::size_t encodedBytes) {
  return pixels * 64 + encodedBytes * 4 + (std::size_t{1} << 22);
}

template <class T>
void toFloats(const T* samples, float largest, std::vector<float>& out) {
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<float>(samples[i]) / largest;
}

}  // namespace

TextureImage decodeImage(const Bytes& file, const JsonAt& at, Budget& budget) {
  if (file.empty()) at.fail("has no bytes behind it");
  if (!isPng(file) && !isJpeg(file)) at.fail("is neither PNG nor JPEG, the formats that glTF allows");
  const Bytes encoded = isJpeg(file) ? withoutMetadata(file) : file;
  if (isJpeg(file) && !huffmanTablesFit(encoded)) at.fail("its Huffman tables are broken");
  if (encoded.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) at.fail("is larger than 2 GiB");
  const int size = static_cast<int>(encoded.size());
  int width = 0;
  int height = 0;
  int channels = 0;
  decoderBytesLeft = decoderBytes(0, encoded.size());
  if (!stbi_info_from_memory(encoded.data(), size, &width, &height, &channels) || width < 1 || height < 1) {
    at.fail("its image header is broken or promises too many pixels");
  }
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  budget.charge(pixels * 4 * sizeof(float), at);
  decoderBytesLeft = decoderBytes(pixels, encoded.size());

  TextureImage image;
  image.width = static_cast<std::uint32_t>(width);
  image.height = static_cast<std::uint32_t>(height);
  const auto decodeAs = [&](auto* samples, float largest) {
    const std::unique_ptr<std::remove_pointer_t<decltype(samples)>, void (*)(void*)> owned(samples, stbi_image_free);
    if (samples == nullptr || static_cast<std::size_t>(width) * static_cast<std::size_t>(height) != pixels) {
      at.fail("its image data are broken or cut off");
    }
    image.rgba.resize(pixels * 4);
    toFloats(samples, largest, image.rgba);
  };
  if (stbi_is_16_bit_from_memory(encoded.data(), size)) {
    decodeAs(stbi_load_16_from_memory(encoded.data(), size, &width, &height, &channels, 4), 65535.0f);
  } else {
    decodeAs(stbi_load_from_memory(encoded.data(), size, &width, &height, &channels, 4), 255.0f);
  }
  return image;
}

}  // namespace crosslight::gltf

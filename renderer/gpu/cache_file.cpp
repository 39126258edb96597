#include "gpu/cache_file.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <exception>

#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"
#include "gpu/device.h"

namespace crosslight::gpu {
namespace {

constexpr std::array<char, 8> kMagic{'C', 'L', 'P', 'I', 'P', 'E', 'S', '\n'};
constexpr std::uint32_t kVersion = 1;
// A cache beyond this is a mistake, not a cache: some hundred pipelines take a few MiB.
constexpr std::uint64_t kMaxFileBytes = std::uint64_t{256} << 20;

struct Header {
  std::array<char, 8> magic;
  std::uint32_t version;
  std::uint32_t headerBytes;
  std::uint64_t blobBytes;
  std::uint64_t blobHash;
};
static_assert(sizeof(Header) == 32);

}  // namespace

std::vector<std::byte> packCache(std::span<const std::byte> blob) {
  const Header header{kMagic, kVersion, sizeof(Header), blob.size(), hashBytes(blob)};
  std::vector<std::byte> file(sizeof(Header) + blob.size());
  std::memcpy(file.data(), &header, sizeof(Header));
  if (!blob.empty()) std::memcpy(file.data() + sizeof(Header), blob.data(), blob.size());
  return file;
}

std::optional<std::vector<std::byte>> unpackCache(std::span<const std::byte> file) {
  if (file.size() < sizeof(Header)) return std::nullopt;
  Header header;
  std::memcpy(&header, file.data(), sizeof(Header));
  const std::span<const std::byte> blob = file.subspan(sizeof(Header));
  const bool whole = header.magic == kMagic && header.version == kVersion && header.headerBytes == sizeof(Header) &&
                     header.blobBytes == blob.size() && header.blobHash == hashBytes(blob);
  if (!whole) return std::nullopt;
  return std::vector<std::byte>(blob.begin(), blob.end());
}

std::optional<std::vector<std::byte>> loadCache(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  try {
    std::optional<std::vector<std::byte>> blob = unpackCache(readFile(path, kMaxFileBytes));
    if (!blob) logVerbose("the pipeline cache " + path.string() + " is damaged or of another version; it is ignored");
    return blob;
  } catch (const std::exception& trouble) {
    logVerbose(std::string("the pipeline cache is ignored: ") + trouble.what());
    return std::nullopt;
  }
}

bool saveCache(const std::filesystem::path& path, std::span<const std::byte> blob) noexcept {
  try {
    std::filesystem::create_directories(path.parent_path());
    writeFileAtomically(path, packCache(blob));
    return true;
  } catch (const std::exception& trouble) {
    logVerbose(std::string("the pipeline cache is not written: ") + trouble.what());
    return false;
  }
}

}  // namespace crosslight::gpu

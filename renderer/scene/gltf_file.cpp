// From the bytes of a .gltf or .glb file to its JSON value. Structure of the container, size and depth of the JSON are
// checked here; what the JSON says is gltf_validate.cpp's.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "scene/gltf_document.h"

namespace crosslight::gltf {
namespace fs = std::filesystem;
namespace {

constexpr std::uint32_t kGlbMagic = 0x46546C67;   // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004E4942;   // "BIN\0"
constexpr std::size_t kGlbHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
// glTF itself nests seven deep; extras and extensions get room. Bounds the recursion of everything that walks JSON.
constexpr int kMaxJsonDepth = 100;

std::uint32_t word(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= static_cast<std::uint32_t>(bytes[offset + i]) << (8 * i);
  return value;
}

struct Glb {
  std::span<const std::byte> json;
  std::optional<std::span<const std::byte>> bin;
};

std::size_t checkedGlbLength(const std::string& file, std::span<const std::byte> bytes) {
  if (bytes.size() < kGlbHeaderBytes) throw InputError(file, "ends inside the 12-byte GLB header");
  if (const std::uint32_t version = word(bytes, 4); version != 2) {
    throw InputError(file, fmt::format("is GLB version {}, only 2 is known", version));
  }
  const std::size_t length = word(bytes, 8);
  if (length > bytes.size()) {
    throw InputError(file, fmt::format("says it is {} bytes long, is {}: cut off?", length, bytes.size()));
  }
  if (length < kGlbHeaderBytes + kChunkHeaderBytes) {
    throw InputError(file, fmt::format("says it is {} bytes long, too short for a JSON chunk", length));
  }
  if (length < bytes.size()) {
    logWarning(fmt::format("{}: {} bytes after the end of the GLB are left alone", file, bytes.size() - length));
  }
  return length;
}

void takeChunk(const std::string& file, Glb& glb, std::size_t number, std::uint32_t type,
               std::span<const std::byte> content) {
  if (number == 0) {
    if (type != kJsonChunk) throw InputError(file, "its first GLB chunk is not JSON");
    if (content.empty()) throw InputError(file, "its JSON chunk is empty");
    glb.json = content;
  } else if (type == kJsonChunk) {
    throw InputError(file, "has two JSON chunks");
  } else if (type == kBinChunk) {
    if (glb.bin) throw InputError(file, "has two BIN chunks");
    if (number != 1) throw InputError(file, "its BIN chunk is not the second one");
    glb.bin = content;
  } else {
    logWarning(fmt::format("{}: GLB chunk {} of unknown type 0x{:08x} is left alone", file, number, type));
  }
}

Glb splitGlb(const std::string& file, std::span<const std::byte> bytes) {
  const std::size_t length = checkedGlbLength(file, bytes);
  Glb glb;
  std::size_t offset = kGlbHeaderBytes;
  for (std::size_t number = 0; offset < length; ++number) {
    if (length - offset < kChunkHeaderBytes) throw InputError(file, "ends inside a GLB chunk header");
    const std::size_t size = word(bytes, offset);
    const std::uint32_t type = word(bytes, offset + 4);
    offset += kChunkHeaderBytes;
    if (size > length - offset) {
      throw InputError(file, fmt::format("GLB chunk {} says {} bytes, {} are left", number, size, length - offset));
    }
    if (size % 4 != 0) throw InputError(file, fmt::format("GLB chunk {} has {} bytes, no multiple of 4", number, size));
    takeChunk(file, glb, number, type, bytes.subspan(offset, size));
    offset += size;
  }
  return glb;
}

// JSON writes integers as it likes (1, 1.0, 1e0); tinygltf takes only the first for an integer.
void makeWholeNumbersIntegers(Json& value) {
  if (value.is_number_float()) {
    const double number = value.get<double>();
    if (std::trunc(number) == number && std::abs(number) < double(kLargestInteger)) {
      value = static_cast<std::int64_t>(number);
    }
  } else if (value.is_structured()) {
    for (Json& child : value) makeWholeNumbersIntegers(child);
  }
}

Json parseJson(const std::string& file, std::span<const std::byte> text) {
  const auto* begin = reinterpret_cast<const char*>(text.data());
  if (text.size() >= 3 && std::memcmp(begin, "\xEF\xBB\xBF", 3) == 0) {
    throw InputError(file, "its JSON begins with a byte order mark, which glTF forbids: save it without");
  }
  const auto limitDepth = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > kMaxJsonDepth) {
      throw InputError(file, fmt::format("its JSON is nested deeper than {} levels", kMaxJsonDepth));
    }
    return true;
  };
  try {
    Json json = Json::parse(begin, begin + text.size(), limitDepth);
    makeWholeNumbersIntegers(json);
    return json;
  } catch (const Json::exception& error) {
    throw InputError(file, std::string("is not valid JSON: ") + error.what());
  }
}

// Half of the machine's memory: a file that says it needs more would get the process killed instead of an answer.
std::uint64_t memoryLimitBytes(std::uint64_t askedBytes) {
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long pageBytes = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || pageBytes <= 0) return askedBytes;
  return std::min(askedBytes, static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(pageBytes) / 2);
}

}  // namespace

void Budget::charge(std::uint64_t bytes, const JsonAt& forWhat) {
  if (bytes > leftBytes()) {
    forWhat.fail(
        fmt::format("needs {} more bytes, of the limit of {} only {} are left", bytes, limitBytes_, leftBytes()));
  }
  usedBytes_ += bytes;
}

void Notes::add(const JsonAt& at, const std::string& what) {
  Entry& entry = entries_[what];
  if (entry.count++ == 0) entry.place = at.place();
}

void Notes::log() const {
  for (const auto& [what, entry] : entries_) {
    const std::string more = entry.count > 1 ? fmt::format(" (and {} more like it)", entry.count - 1) : "";
    logWarning(entry.place + ": " + what + more);
  }
}

Document::Document(const fs::path& file, const LoadOptions& options)
    : fileName(file.string()), hashContents(options.hashContents), budget(memoryLimitBytes(options.maxBytes)) {
  std::error_code error;
  if (!fs::exists(file, error)) throw InputError(fileName, "does not exist");
  // A pipe or device would block or never end.
  if (!fs::is_regular_file(file, error)) throw InputError(fileName, "is not a regular file");
  const fs::path parent = file.parent_path();
  folder = fs::canonical(parent.empty() ? fs::path(".") : parent, error);
  if (error) throw InputError(fileName, "its folder cannot be resolved: " + error.message());
  const std::vector<std::byte> bytes = readFile(file, budget.leftBytes());
  fileBytes = bytes.size();
  if (hashContents) contentHash = hashBytes(bytes, contentHash);
  budget.charge(fileBytes, root());
  const std::span<const std::byte> all(bytes);
  if (bytes.size() >= 4 && word(all, 0) == kGlbMagic) {
    const Glb glb = splitGlb(fileName, all);
    isGlb = true;
    json = parseJson(fileName, glb.json);
    if (glb.bin) {
      const auto* begin = reinterpret_cast<const unsigned char*>(glb.bin->data());
      hasGlbChunk = true;
      glbChunk.assign(begin, begin + glb.bin->size());
    }
  } else {
    if (bytes.empty()) throw InputError(fileName, "is empty");
    if (file.extension() == ".glb") throw InputError(fileName, "does not begin with the magic \"glTF\" of a GLB file");
    json = parseJson(fileName, all);
  }
}

std::size_t Document::count(const char* array) const {
  const auto it = json.find(array);
  return it == json.end() ? 0 : it->size();
}

bool Document::uses(const char* extension) const {
  const auto it = json.find("extensionsUsed");
  return it != json.end() && std::find(it->begin(), it->end(), Json(extension)) != it->end();
}

}  // namespace crosslight::gltf

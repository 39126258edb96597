// The bytes that a glTF file refers to: embedded as data URIs, in the GLB's binary chunk, or in files of its own
// folder. Nothing outside that folder is read, whatever the URI or a symbolic link says.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/file.h"
#include "scene/gltf_document.h"

namespace crosslight::gltf {
namespace fs = std::filesystem;
namespace {

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string percentDecoded(const JsonAt& at, std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    const int high = i + 1 < text.size() ? hexDigit(text[i + 1]) : -1;
    const int low = i + 2 < text.size() ? hexDigit(text[i + 2]) : -1;
    if (high < 0 || low < 0) at.fail("has a % that two hexadecimal digits do not follow");
    decoded += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return decoded;
}

// Scheme of a URI (RFC 3986, 3.1), or empty for a relative reference.
std::string_view schemeOf(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  if (colon == std::string_view::npos || colon == 0) return {};
  const auto isAlpha = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  if (!isAlpha(uri[0])) return {};
  for (const char c : uri.substr(0, colon)) {
    if (!isAlpha(c) && !(c >= '0' && c <= '9') && c != '+' && c != '-' && c != '.') return {};
  }
  return uri.substr(0, colon);
}

int base64Digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;  // and the URL-safe alphabet
  if (c == '/' || c == '_') return 63;
  return -1;
}

Bytes base64Decoded(const JsonAt& at, std::string_view text) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  if (text.size() % 4 == 1) at.fail("its base64 data are cut off");
  Bytes bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int bitCount = 0;
  for (const char c : text) {
    const int digit = base64Digit(c);
    if (digit < 0) at.fail("its base64 data hold a character that base64 does not have");
    bits = (bits << 6 | static_cast<std::uint32_t>(digit)) & 0xffffffu;
    bitCount += 6;
    if (bitCount >= 8) {
      bitCount -= 8;
      bytes.push_back(static_cast<unsigned char>(bits >> bitCount & 0xffu));
    }
  }
  return bytes;
}

Bytes dataUri(const JsonAt& at, Budget& budget) {
  const std::string& uri = at.string();
  budget.charge(uri.size(), at);
  const std::size_t comma = uri.find(',');
  if (comma == std::string::npos) at.fail("is a data URI without data");
  const std::string_view header = std::string_view(uri).substr(5, comma - 5);
  if (header.find(";;") != std::string_view::npos) at.fail("is a data URI with an empty parameter");
  const std::string_view data = std::string_view(uri).substr(comma + 1);
  if (header.ends_with(";base64")) return base64Decoded(at, data);
  const std::string plain = percentDecoded(at, data);
  return Bytes(plain.begin(), plain.end());
}

bool liesInside(const fs::path& folder, const fs::path& file) {
  const auto [inFolder, inFile] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return inFolder == folder.end();
}

}  // namespace

fs::path fileInFolder(const JsonAt& at, const Document& document) {
  const std::string& uri = at.string();
  if (uri.empty()) at.fail("is empty");
  if (const std::string_view scheme = schemeOf(uri); !scheme.empty()) {
    at.fail(fmt::format("has the scheme '{}'; only data URIs and paths inside the file's folder are read", scheme));
  }
  const std::string decoded = percentDecoded(at, uri);
  if (decoded.find('\0') != std::string::npos) at.fail("holds a zero byte");
  const fs::path relative(decoded);
  if (relative.is_absolute()) at.fail("is an absolute path; only paths inside the file's folder are read");
  std::error_code error;
  const fs::path full = fs::weakly_canonical(document.folder / relative, error);
  if (error) at.fail("cannot be resolved: " + error.message());
  if (!liesInside(document.folder, full)) at.fail("leads out of the file's folder, which is not read");
  if (!fs::exists(full, error)) at.fail("the file '" + decoded + "' does not exist");
  if (!fs::is_regular_file(full, error)) at.fail("'" + decoded + "' is not a regular file");
  return full;
}

namespace {

Bytes externalFile(const JsonAt& at, Document& document) {
  const fs::path path = fileInFolder(at, document);
  std::error_code error;
  const std::uint64_t size = fs::file_size(path, error);
  if (error) at.fail("its size cannot be read: " + error.message());
  document.budget.charge(size, at);
  document.fileBytes += size;
  const std::vector<std::byte> bytes = readFile(path, size);
  if (document.hashContents) document.contentHash = hashBytes(bytes, document.contentHash);
  const auto* begin = reinterpret_cast<const unsigned char*>(bytes.data());
  return Bytes(begin, begin + bytes.size());
}

Bytes bytesOf(const JsonAt& uri, Document& document) {
  const std::string scheme(schemeOf(uri.string()));
  return scheme == "data" ? dataUri(uri, document.budget) : externalFile(uri, document);
}

bool isMeshoptFallback(const JsonAt& buffer) {
  const auto extension = buffer.extension("EXT_meshopt_compression");
  return extension && booleanOr(*extension, "fallback", false);
}

void loadBuffer(const JsonAt& buffer, std::size_t index, Document& document) {
  Bytes& bytes = document.buffers[index];
  if (const auto uri = buffer.find("uri")) {
    bytes = bytesOf(*uri, document);
  } else if (index == 0 && document.hasGlbChunk) {
    bytes = std::move(document.glbChunk);
  } else if (index == 0 && document.isGlb && !isMeshoptFallback(buffer)) {
    buffer.fail("has neither a uri nor a binary chunk in the GLB file");
  } else {
    // An extension may stand in for it, as meshopt's compressed twins do. Whoever reads it finds nothing and says so.
    if (!isMeshoptFallback(buffer)) buffer.warn("has no uri, so there is nothing behind it");
    return;
  }
  const auto length = static_cast<std::uint64_t>(buffer.at("byteLength").integer());
  if (bytes.size() < length) {
    buffer.fail(fmt::format("byteLength is {}, but there are only {} bytes", length, bytes.size()));
  }
  bytes.resize(length);
}

}  // namespace

void loadResources(Document& document) {
  document.buffers.resize(document.count("buffers"));
  for (std::size_t i = 0; i < document.buffers.size(); ++i) loadBuffer(document.entry("buffers", i), i, document);
  document.images.resize(document.count("images"));
  for (std::size_t i = 0; i < document.images.size(); ++i) {
    const JsonAt image = document.entry("images", i);
    if (const auto uri = image.find("uri")) {
      document.images[i] = bytesOf(*uri, document);
      continue;
    }
    const JsonAt view = document.entry("bufferViews", static_cast<std::size_t>(image.at("bufferView").integer()));
    const Bytes& buffer = document.buffers[static_cast<std::size_t>(view.at("buffer").integer())];
    const std::int64_t offset = integerOr(view, "byteOffset", 0);
    const std::int64_t end = offset + view.at("byteLength").integer();
    if (static_cast<std::uint64_t>(end) > buffer.size()) continue;  // said when a material uses it
    document.budget.charge(static_cast<std::uint64_t>(end - offset), image);
    document.images[i].assign(buffer.begin() + offset, buffer.begin() + end);
  }
}

}  // namespace crosslight::gltf

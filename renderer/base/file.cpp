#include "base/file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>

#include "base/error.h"
#include "base/interrupt.h"

namespace crosslight {
namespace fs = std::filesystem;

std::vector<std::byte> readFile(const fs::path& path, std::uint64_t maxBytes) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw InputError(path.string(), "is a folder, a file is needed");
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) throw InputError(path.string(), std::string("cannot be opened: ") + std::strerror(errno));
  const std::streamoff size = in.tellg();
  if (size < 0) throw InputError(path.string(), "its size cannot be read");
  if (static_cast<std::uint64_t>(size) > maxBytes) {
    throw InputError(path.string(),
                     "is " + std::to_string(size) + " bytes large, the limit is " + std::to_string(maxBytes));
  }
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(bytes.data()), size);
  if (!in && size > 0) throw InputError(path.string(), "cannot be read to its end");
  return bytes;
}

namespace {

void flushToDisk(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) throw InputError(path.string(), std::string("cannot be reopened: ") + std::strerror(errno));
  const int cause = ::fsync(file) == 0 ? 0 : errno;
  ::close(file);
  // Some file systems know no fsync (EINVAL); the rename is still atomic there.
  if (cause != 0 && cause != EINVAL)
    throw InputError(path.string(), std::string("cannot be flushed: ") + std::strerror(cause));
}

}  // namespace

void writeFileAtomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  static std::atomic<unsigned> counter{0};
  fs::path temporary = path;
  // The extension stays last: writers that choose their format by it work on the temporary file too.
  std::string name = ".";
  name += path.stem().string() + ".tmp" + std::to_string(::getpid()) + "-" + std::to_string(counter++) +
          path.extension().string();
  temporary.replace_filename(name);
  struct Cleanup {
    const fs::path& file;
    bool armed = true;
    ~Cleanup() {
      std::error_code ignored;
      if (armed) fs::remove(file, ignored);
    }
  } cleanup{temporary};
  write(temporary);
  throwIfInterrupted();
  flushToDisk(temporary);
  std::error_code error;
  fs::rename(temporary, path, error);
  if (error) throw InputError(path.string(), "cannot be written: " + error.message());
  cleanup.armed = false;
}

void writeFileAtomically(const fs::path& path, std::span<const std::byte> bytes) {
  writeFileAtomically(path, [&](const fs::path& temporary) {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    if (!out) throw InputError(path.string(), std::string("cannot be written: ") + std::strerror(errno));
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    out.flush();
    if (!out) throw InputError(path.string(), std::string("cannot be written: ") + std::strerror(errno));
  });
}

void writeFileAtomically(const fs::path& path, const std::string& text) {
  writeFileAtomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

std::filesystem::path cacheFolder() {
  // The XDG base directory specification: a relative path is invalid and to be ignored.
  const auto absolutePath = [](const char* name) {
    const char* const value = std::getenv(name);
    const std::filesystem::path path = value == nullptr ? "" : value;
    return path.is_absolute() ? path : std::filesystem::path();
  };
  if (const auto cache = absolutePath("XDG_CACHE_HOME"); !cache.empty()) return cache / "crosslight";
  if (const auto home = absolutePath("HOME"); !home.empty()) return home / ".cache" / "crosslight";
  return {};
}

}  // namespace crosslight

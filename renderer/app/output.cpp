#include "app/output.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/error.h"

namespace crosslight {
namespace fs = std::filesystem;

void printToStdout(const std::string& text) {
  const std::size_t written = std::fwrite(text.data(), 1, text.size(), stdout);
  if (written != text.size() || std::fflush(stdout) != 0) {
    throw InputError("standard output", std::string("cannot be written: ") + std::strerror(errno));
  }
}

void checkOutputPlace(const fs::path& file) {
  std::error_code ignored;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::exists(folder, ignored)) {
    throw InputError(file.string(), "its folder '" + folder.string() + "' does not exist; make it first");
  }
  if (!fs::is_directory(folder, ignored)) throw InputError(file.string(), "'" + folder.string() + "' is no folder");
  if (fs::is_directory(file, ignored) || !file.has_filename()) {
    throw InputError(file.string(), "is a folder; the name of a file is needed");
  }
  // A file without a name tells what permission bits do not (read-only and pseudo file systems, root) and leaves
  // nothing.
  const int probe = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  if (probe >= 0) {
    ::close(probe);
    return;
  }
  // Some file systems know no files without a name: there the permission bits decide, and in the end the writing
  // itself.
  const bool unknown = errno == EOPNOTSUPP || errno == EISDIR || errno == EINVAL;
  if (unknown && ::access(folder.c_str(), W_OK | X_OK) == 0) return;
  throw InputError(file.string(), "its folder '" + folder.string() + "' cannot be written: " + std::strerror(errno));
}

}  // namespace crosslight

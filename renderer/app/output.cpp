#include "app/output.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/error.h"

namespace crosslight {
namespace fs = std::filesystem;
namespace {

// 0, or the errno that making a file in `folder` gives. Permission bits do not tell: root passes all of them, and
// read-only and pseudo file systems refuse whatever they say.
int probe(const fs::path& folder) {
  int file = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);  // has no name: leaves nothing behind
  if (file >= 0) {
    ::close(file);
    return 0;
  }
  if (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL) return errno;
  // The file system knows no files without a name.
  const fs::path named = folder / (".crosslight.probe" + std::to_string(::getpid()));
  file = ::open(named.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0600);
  if (file < 0) return errno;
  ::close(file);
  ::unlink(named.c_str());
  return 0;
}

}  // namespace

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
  if (const int error = probe(folder); error != 0) {
    throw InputError(file.string(), "its folder '" + folder.string() + "' cannot be written: " + std::strerror(error));
  }
}

}  // namespace crosslight

// scenegen OUTDIR [--only NAME] | scenegen --list: writes the scenes, the same bytes on every run.
#include <cstdio>
#include <cstring>
#include <optional>
#include <string>

#include "base/error.h"
#include "scenegen/registry.h"

namespace crosslight::scenegen {
namespace {

constexpr const char* kUsage =
    "usage: scenegen OUTDIR [--only NAME]   write all scenes and README.md, or the scenes called NAME\n"
    "       scenegen --list                 name them\n";

struct Options {
  std::string folder;
  std::optional<std::string> only;
  bool list = false;
};

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--list") {
      options.list = true;
    } else if (word == "--only" && i + 1 < argc) {
      options.only = argv[++i];
    } else if (options.folder.empty() && word.front() != '-') {
      options.folder = word;
    } else {
      throw UsageError("unexpected '" + word + "'\n" + kUsage);
    }
  }
  if (options.folder.empty() && !options.list) throw UsageError(std::string("no folder given\n") + kUsage);
  return options;
}

bool isCalled(const SceneRow& row, const std::string& name) {
  return row.path == name || std::filesystem::path(row.path).filename() == name;
}

void generate(const Options& options) {
  if (!options.only) {
    writeAllScenes(options.folder);
    return;
  }
  bool found = false;
  for (const SceneRow& row : allScenes()) {
    if (!isCalled(row, *options.only)) continue;
    writeScene(row, options.folder);
    found = true;
  }
  if (!found) throw UsageError("there is no scene '" + *options.only + "'; --list names them");
}

int run(int argc, char** argv) {
  try {
    const Options options = parse(argc, argv);
    if (options.list) {
      for (const SceneRow& row : allScenes()) std::printf("%-34s %s\n", row.path, row.purpose);
    }
    if (!options.folder.empty()) generate(options);
    return static_cast<int>(ExitCode::ok);
  } catch (const Error& error) {
    std::fprintf(stderr, "scenegen: %s\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scenegen: %s\n", error.what());
    return static_cast<int>(ExitCode::internal);
  }
}

}  // namespace
}  // namespace crosslight::scenegen

int main(int argc, char** argv) { return crosslight::scenegen::run(argc, argv); }

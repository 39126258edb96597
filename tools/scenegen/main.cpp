// scenegen OUTDIR [--only NAME | --random NUMBER] | scenegen --list: writes scenes, the same bytes on every run.
#include <charconv>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string>

#include "base/error.h"
#include "scenegen/random_scene.h"
#include "scenegen/registry.h"

namespace crosslight::scenegen {
namespace {

constexpr const char* kUsage =
    "usage: scenegen OUTDIR [--only NAME]   write all scenes and README.md, or the scenes called NAME\n"
    "       scenegen OUTDIR --random NUMBER write a scene of the random series; print options to draw it with\n"
    "       scenegen --list                 name them\n";

struct Options {
  std::string folder;
  std::optional<std::string> only;
  std::optional<std::uint64_t> random;
  bool list = false;
};

std::uint64_t numberOf(const std::string& word) {
  std::uint64_t number = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || stop != word.data() + word.size()) throw UsageError("'" + word + "' is no whole number");
  return number;
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--list") {
      options.list = true;
    } else if (word == "--only" && i + 1 < argc) {
      options.only = argv[++i];
    } else if (word == "--random" && i + 1 < argc) {
      options.random = numberOf(argv[++i]);
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

void generateRandom(std::uint64_t number, const std::filesystem::path& folder) {
  std::printf("%s\n", writeRandomScene(number, folder).c_str());
  for (const char* method : {"flat", "gouraud", "phong", "whitted"}) {
    for (const std::string& word : optionsOf(number, method)) std::printf("%s ", word.c_str());
    std::printf("\n");
  }
}

void generate(const Options& options) {
  if (options.random) return generateRandom(*options.random, options.folder);
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

// Pictures of the random series: the scene as the program loads it, the settings as it reads them from the command
// line.
#pragma once

#include <unistd.h>

#include <cstring>
#include <sstream>

#include "app/command_line.h"
#include "app/render_options.h"
#include "base/log.h"
#include "scenegen/random_scene.h"
#include "support/render_fixture.h"

namespace crosslight::testing {

struct RandomPicture {
  Scene scene;
  RenderSettings settings;
  std::string command;  // draws it again
};

inline RenderOptions optionsFrom(const std::vector<std::string>& words) {
  RenderOptions options;
  CommandLine line;
  auto& command = line.add("render", "", "");
  addRenderOptions(line, command, options);
  std::vector<std::string> all{"crosslight", "render"};
  all.insert(all.end(), words.begin(), words.end());
  line.parse(all);
  return options;
}

// InputError and UsageError where the scene or the options are refused.
inline RandomPicture randomPicture(std::uint64_t number, const std::string& method) {
  setLogLevel(LogLevel::quiet);
  const auto folder = std::filesystem::path(::testing::TempDir()) / ("crosslight_random_" + std::to_string(getpid()));
  const std::filesystem::path file = scenegen::writeRandomScene(number, folder);
  std::vector<std::string> words = scenegen::optionsOf(number, method);
  RandomPicture picture;
  picture.command = "scenegen /tmp/random --random " + std::to_string(number) + "; crosslight render /tmp/random/" +
                    file.filename().string() + " -o /tmp/random/got.exr";
  for (const std::string& word : words) picture.command += " " + word;
  words.insert(words.end(), {file.string(), "-o", (folder / "got.exr").string()});
  const RenderOptions options = optionsFrom(words);
  picture.settings = checkedSettings(options);
  picture.settings.allowNonfinite = true;  // counted by the tests
  picture.scene = loadScene(file, loadOptionsOf(options));
  completeScene(picture.scene, options);
  std::filesystem::remove_all(folder);
  return picture;
}

// Layer, pixel, channel and both values of the first difference; empty where all bits are the same.
inline std::string firstDifference(const Image& a, const Image& b) {
  for (std::size_t l = 0; l < a.layers.size(); ++l) {
    const Layer &p = a.layers[l], &q = b.layers[l];
    if (p.integers != q.integers) return "layer " + p.name + " (integers)";
    for (std::size_t i = 0; i < p.samples.size(); ++i) {
      if (std::memcmp(&p.samples[i], &q.samples[i], sizeof(float)) == 0) continue;
      std::ostringstream text;
      text.precision(9);
      const std::size_t pixel = i / p.channels();
      text << "layer '" << p.name << "' at (" << pixel % a.width << ", " << pixel / a.width << ") channel "
           << i % p.channels() << ": " << p.samples[i] << " and " << q.samples[i];
      return text.str();
    }
  }
  return a.layers.size() == b.layers.size() ? "" : "other layers";
}

}  // namespace crosslight::testing

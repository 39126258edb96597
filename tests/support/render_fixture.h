// What image tests share: one device for the process with validation on, scenes by name, and access to pixels.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "app/render_job.h"
#include "app/scene_extras.h"
#include "image/image.h"
#include "scene/load.h"
#include "study/stage.h"

namespace crosslight::testing {

// The device that all tests of one executable draw on. Validation is always on: a message fails the render.
inline gpu::Device& device() {
  static gpu::Device value = [] {
    gpu::DeviceOptions options;
    options.validation = true;
    if (const char* name = std::getenv("CROSSLIGHT_TEST_DEVICE")) options.selector = name;
    return gpu::Device::open(options);
  }();
  return value;
}

inline std::filesystem::path scenesFolder() { return std::filesystem::path(CROSSLIGHT_SOURCE_DIR) / "scenes"; }
inline Scene sceneNamed(const std::string& name) {
  Scene scene = loadScene(scenesFolder() / (name + ".gltf"));
  completeScene(scene);
  return scene;
}

// Every scene file of the project, sorted by path relative to scenes/ and without its extension.
inline std::vector<std::string> allSceneNames() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scenesFolder())) {
    if (entry.path().extension() != ".gltf") continue;
    names.push_back(std::filesystem::relative(entry.path(), scenesFolder()).replace_extension().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

using study::pixelAt;
using study::settingsFor;

// Where two pictures differ most, over the pixels for which `counts` holds.
struct Difference {
  double maximum = 0;
  std::uint32_t x = 0, y = 0;
  int channel = 0;
  float a = 0, b = 0;
  std::size_t compared = 0;
};

template <class Counts>
Difference largestDifference(const Image& a, const Image& b, const Counts& counts) {
  Difference d;
  for (std::uint32_t y = 0; y < a.height; ++y) {
    for (std::uint32_t x = 0; x < a.width; ++x) {
      if (!counts(x, y)) continue;
      ++d.compared;
      const auto p = pixelAt(a, x, y), q = pixelAt(b, x, y);
      for (int c = 0; c < 3; ++c) {
        const double difference =
            std::abs(static_cast<double>(p[static_cast<std::size_t>(c)]) - q[static_cast<std::size_t>(c)]);
        if (difference <= d.maximum) continue;
        d.maximum = difference;
        d.x = x, d.y = y, d.channel = c;
        d.a = p[static_cast<std::size_t>(c)], d.b = q[static_cast<std::size_t>(c)];
      }
    }
  }
  return d;
}

inline std::ostream& operator<<(std::ostream& out, const Difference& d) {
  return out << d.maximum << " at (" << d.x << ", " << d.y << ") channel " << d.channel << ": " << d.a << " and " << d.b
             << " (" << d.compared << " pixels compared)";
}

// A pixel is interior in a picture when its eight neighbours show the same object.
class Interior {
 public:
  explicit Interior(const Image& image)
      : width_(image.width), height_(image.height), ids_(image.find("instanceId")->integers) {}

  std::uint32_t idAt(std::uint32_t x, std::uint32_t y) const { return ids_[std::size_t{y} * width_ + x]; }
  bool operator()(std::uint32_t x, std::uint32_t y) const {
    if (x == 0 || y == 0 || x + 1 >= width_ || y + 1 >= height_) return false;
    for (std::uint32_t v = y - 1; v <= y + 1; ++v) {
      for (std::uint32_t u = x - 1; u <= x + 1; ++u) {
        if (idAt(u, v) != idAt(x, y)) return false;
      }
    }
    return true;
  }

 private:
  std::uint32_t width_, height_;
  const std::vector<std::uint32_t>& ids_;
};

}  // namespace crosslight::testing

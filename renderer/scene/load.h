// From a glTF 2.0 file to a Scene. Everything that the file may do wrong ends in an InputError that names the file and
// the JSON path, or in a named warning (base/log.h); nothing outside the file's folder is read.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "scene/displacement.h"
#include "scene/scene.h"

namespace crosslight {

struct LoadOptions {
  std::string scene{};       // name or index; empty: the file's default, else the first
  double timeSeconds = 0.0;  // where animations are evaluated
  bool animate = false;      // false: the rest pose as the nodes have it, animations are left alone
  std::string animation{};   // name or index of the only one to evaluate; empty: all of them
  DisplacementOptions displacement{};
  bool hashContents = false;                        // fill SceneStats::contentHash
  std::uint64_t maxBytes = std::uint64_t{8} << 30;  // of file, buffers and decoded images together
};

Scene loadScene(const std::filesystem::path& file, const LoadOptions& options = {});

// A file that is read and checked once and then posed at many times. A scene of it is the one that loadScene gives.
class SceneFile {
 public:
  explicit SceneFile(const std::filesystem::path& file, const LoadOptions& options = {});
  SceneFile(SceneFile&&) noexcept;
  ~SceneFile();
  // With the file's options, but for the time.
  Scene pose(double timeSeconds) const;

 private:
  friend Scene loadScene(const std::filesystem::path& file, const LoadOptions& options);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Turns a camera about the vertical through the middle of the scene's bounds, counter-clockwise as seen from above. The
// headlight of a file without lights goes along.
void orbit(Scene& scene, int camera, double degrees);

// Index of the camera with this name or number; UsageError lists what there is.
int findCamera(const Scene& scene, const std::string& nameOrIndex);

// The camera that sees all of `bounds`, from the front, a little above; used when the file has none.
Camera frameBounds(const DBounds& bounds);

}  // namespace crosslight

// From a glTF 2.0 file to a Scene. Everything that the file may do wrong ends in an InputError that names the file and
// the JSON path, or in a named warning (base/log.h); nothing outside the file's folder is read.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "scene/scene.h"

namespace crosslight {

struct LoadOptions {
  std::string scene{};       // name or index; empty: the file's default, else the first
  double timeSeconds = 0.0;  // where animations are evaluated
  bool animate = false;      // false: the rest pose as the nodes have it, animations are left alone
  std::uint64_t maxBytes = std::uint64_t{8} << 30;  // of file, buffers and decoded images together
};

Scene loadScene(const std::filesystem::path& file, const LoadOptions& options = {});

// Index of the camera with this name or number; UsageError lists what there is.
int findCamera(const Scene& scene, const std::string& nameOrIndex);

// The camera that sees all of `bounds`, from the front, a little above; used when the file has none.
Camera frameBounds(const DBounds& bounds);

}  // namespace crosslight

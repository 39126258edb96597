// Scenes and options drawn from a seed: random subsets of all that a scene and `crosslight render` may ask for, in a
// few objects and small pictures. What a failing test names by its seed, `scenegen DIR --random SEED` writes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scenegen/gltf_builder.h"

namespace crosslight::scenegen {

// What pipelines are made for beside the effects: scenes of one style share the pipelines with all effects compiled in.
struct RandomStyle {
  bool orthographic = false;
  bool manyLights = false;            // more than fit into one batch of the ray kernels
  std::vector<std::string> ofRaster;  // words for the raster methods
  std::vector<std::string> ofRays;    // for whitted
};
RandomStyle randomStyle(std::uint64_t seed);

// `name` begins the names of the files beside it.
void buildRandomScene(GltfBuilder& gltf, const std::string& name, std::uint64_t seed, const RandomStyle& style);

// Words of `crosslight render` after the scene, the output and the effects: method, resolution, samples, keys of --set.
// Any seed goes with any scene.
std::vector<std::string> randomOptions(std::uint64_t seed, const RandomStyle& style, const std::string& method);

// The series that tests draw: scenes after one another have one style.
inline constexpr std::uint64_t kScenesOfAStyle = 15;
RandomStyle styleOf(std::uint64_t number);
// NAME.gltf in the folder; its path.
std::filesystem::path writeRandomScene(std::uint64_t number, const std::filesystem::path& folder);
std::vector<std::string> optionsOf(std::uint64_t number, const std::string& method);

}  // namespace crosslight::scenegen

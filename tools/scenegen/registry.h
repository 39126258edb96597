// The list of scenes: a row gives the file, what it is for and the function that builds it. A new scene is a function
// and a row.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "scenegen/gltf_builder.h"

namespace crosslight::scenegen {

struct SceneRow {
  const char* path;     // below scenes/, without the ending
  const char* purpose;  // one line for scenes/README.md
  void (*build)(GltfBuilder& gltf);
};

std::span<const SceneRow> analyticScenes();
std::span<const SceneRow> showcaseScenes();
std::span<const SceneRow> overviewScenes();
std::span<const SceneRow> featureScenes();
std::span<const SceneRow> lightScenes();
std::span<const SceneRow> airScenes();
std::span<const SceneRow> areaLightScenes();
std::span<const SceneRow> modelScenes();
std::span<const SceneRow> layerScenes();
std::span<const SceneRow> surfaceScenes();
std::span<const SceneRow> stressScenes();

std::vector<SceneRow> allScenes();  // by path

std::string readmeText();

// PATH.gltf and PATH.bin below the folder.
void writeScene(const SceneRow& row, const std::filesystem::path& folder);

// All of them, and README.md.
void writeAllScenes(const std::filesystem::path& folder);

}  // namespace crosslight::scenegen

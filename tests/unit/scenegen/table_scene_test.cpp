// The table of presets as a scene: none is missing.
#include <gtest/gtest.h>
#include <filesystem>

#include <set>

#include "scene/load.h"
#include "scene/material_table.h"

namespace crosslight::scenegen {
namespace {

TEST(MaterialTableScene, showsEveryPresetOnce) {
  const Scene scene =
      loadScene(std::filesystem::path(CROSSLIGHT_SOURCE_DIR) / "scenes" / "showcase" / "material_table.gltf");
  std::multiset<std::string> shown, known;
  for (const MeshInstance& instance : scene.instances) shown.insert(instance.name);
  for (const MaterialPreset& preset : materialPresets()) known.emplace(preset.name);
  EXPECT_EQ(shown, known);
}

}  // namespace
}  // namespace crosslight::scenegen

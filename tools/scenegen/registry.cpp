#include "scenegen/registry.h"

#include <algorithm>
#include <string_view>

#include "base/file.h"

namespace crosslight::scenegen {

std::vector<SceneRow> allScenes() {
  std::vector<SceneRow> all;
  for (const auto rows :
       {analyticScenes(), showcaseScenes(), overviewScenes(), featureScenes(), lightScenes(), airScenes(),
        areaLightScenes(), modelScenes(), layerScenes(), surfaceScenes(), stressScenes()}) {
    all.insert(all.end(), rows.begin(), rows.end());
  }
  std::sort(all.begin(), all.end(),
            [](const SceneRow& a, const SceneRow& b) { return std::string_view(a.path) < std::string_view(b.path); });
  return all;
}

std::string readmeText() {
  std::string text =
      "# Scenes\n\n"
      "Written by `tools/scenegen` (`scenegen scenes`) and committed: do not edit them, edit the generator; a test\n"
      "regenerates them and compares every byte. Folders: `analytic/` has values derived on paper, `feature/` the "
      "smallest\n"
      "scene that needs exactly one thing, `stress/` what is numerically hard, `showcase/` the pictures. Files are "
      "glTF 2.0\n"
      "with the extensions of `schema/`; `tools/scenegen/validate.mjs` checks them with Khronos' validator.\n\n"
      "| scene | for |\n|---|---|\n";
  for (const SceneRow& row : allScenes()) {
    text += std::string("| `") + row.path + ".gltf` | " + row.purpose + " |\n";
  }
  return text;
}

void writeScene(const SceneRow& row, const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / row.path;
  const std::string name = path.filename().string();
  GltfBuilder gltf(name);
  row.build(gltf);
  gltf.write(path.parent_path(), name);
}

void writeAllScenes(const std::filesystem::path& folder) {
  for (const SceneRow& row : allScenes()) writeScene(row, folder);
  writeFileAtomically(folder / "README.md", readmeText());
}

}  // namespace crosslight::scenegen

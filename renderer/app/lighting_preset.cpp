#include "app/lighting_preset.h"

#include <fmt/format.h>

#include "app/render_job.h"
#include "scene/shape_mesh.h"

namespace crosslight {
namespace {

std::string quoted(const char* kind, const std::string& name, std::size_t index) {
  return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} '{}'", kind, name);
}

bool inFixedFunction(IlluminationModel model) {
  return model == IlluminationModel::unlit || model == IlluminationModel::lambert ||
         model == IlluminationModel::blinnPhong;
}

}  // namespace

void lightAsOpenGl(RenderSettings& settings) {
  settings.clampVertexColors = true;
  settings.flatVertex = FlatVertex::last;
  settings.infiniteViewer = true;
  settings.fogDistance = FogDistance::depth;
}

std::vector<std::string> unlikeOpenGl(const Scene& scene, const RenderSettings& settings) {
  std::vector<std::string> sentences;
  if (settings.method != Method::flat && settings.method != Method::gouraud) {
    sentences.push_back(
        fmt::format("--lighting opengl: the fixed function lights vertices (flat, gouraud), {} does not; its model, "
                    "viewer and fog are taken over",
                    nameOf(settings.method)));
  }
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    if (inFixedFunction(m.model)) continue;
    sentences.push_back(
        fmt::format("--lighting opengl: {} is lit by {}, which the fixed function does not have; its highlights are "
                    "blinnPhong's, (N.H)^n",
                    quoted("material", m.name, i), nameOf(m.model)));
  }
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    if (scene.lights[i].classic) continue;
    sentences.push_back(
        fmt::format("--lighting opengl: {} fades and has cones as glTF says, the fixed function's are those of "
                    "CROSSLIGHT_lights_classic",
                    quoted("light", scene.lights[i].name, i)));
  }
  return sentences;
}

}  // namespace crosslight

// Scenes of what fills the space between things: fog.
#include "scenegen/meshes.h"
#include "scenegen/parts.h"
#include "scenegen/registry.h"

namespace crosslight::scenegen {
namespace {

using glm::dvec3;

// Balls on a floor that runs to the horizon, each farther away than the one before.
void ballsInFog(GltfBuilder& gltf, Json fog) {
  const int floor = gltf.addMaterial(matte("floor", {0.30, 0.34, 0.30}));
  const Primitive grid = withoutUv(gridMesh({0.0, 0.0, -20.0}, {30.0, 0.0, 0.0}, {0.0, 0.0, -30.0}, 40));
  gltf.addRoot(meshNode("floor", gltf.addMesh("floor", {{gltf.addGeometry(grid), floor}})));
  const dvec3 colors[4] = {{0.75, 0.15, 0.12}, {0.80, 0.55, 0.10}, {0.20, 0.55, 0.25}, {0.15, 0.30, 0.70}};
  const dvec3 places[4] = {{-1.3, 0.8, 1.5}, {1.1, 0.8, -0.5}, {-1.4, 0.8, -4.0}, {2.2, 0.8, -9.0}};
  for (int i = 0; i < 4; ++i) {
    const int material = gltf.addMaterial(paint("ball", colors[i]));
    gltf.addRoot(shapeNode(gltf, "ball", {.params = {0.8, 0.0, 0.0}, .segments = 40}, material, places[i]));
  }
  addDirectionalLight(gltf, "sun", {0.5, -1.0, -0.6}, {.color = dvec3(0.9)});
  addCamera(gltf, {.eye = {0.0, 1.7, 7.0}, .target = {0.0, 0.9, 0.0}, .yFovDegrees = 50.0});
  gltf.setAtmosphere({{"ambient", listOf(dvec3(0.2))}, {"background", listOf({0.20, 0.35, 0.60})}, {"fog", fog}});
}

Json fogOf(const char* mode) { return {{"mode", mode}, {"color", listOf({0.62, 0.66, 0.70})}}; }

void fogLinear(GltfBuilder& gltf) {
  Json fog = fogOf("linear");
  fog["start"] = 4.0;
  fog["end"] = 18.0;
  ballsInFog(gltf, std::move(fog));
}

void fogExp(GltfBuilder& gltf) {
  Json fog = fogOf("exp");
  fog["density"] = 0.1;
  ballsInFog(gltf, std::move(fog));
}

void fogExp2(GltfBuilder& gltf) {
  Json fog = fogOf("exp2");
  fog["density"] = 0.09;
  ballsInFog(gltf, std::move(fog));
}

constexpr SceneRow kRows[] = {
    {"feature/fog_linear", "fog that grows from start to end", fogLinear},
    {"feature/fog_exp", "fog e^-(density d)", fogExp},
    {"feature/fog_exp2", "fog e^-(density d)^2", fogExp2},
};

}  // namespace

std::span<const SceneRow> airScenes() { return kRows; }

}  // namespace crosslight::scenegen

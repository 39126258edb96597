// Scenes of what fills the space between things: fog and smoke; and of bodies that light goes through.
#include <cmath>

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

Json smokeOf(const char* shape, double absorption, double scattering, double anisotropy) {
  return {{"shape", shape},
          {"absorption", listOf(dvec3(absorption))},
          {"scattering", listOf(dvec3(scattering))},
          {"anisotropy", anisotropy}};
}

void addFloor(GltfBuilder& gltf, const dvec3& color) {
  const int floor = gltf.addMaterial(matte("floor", color));
  const Primitive grid = withoutUv(gridMesh(dvec3(0.0), {3.0, 0.0, 0.0}, {0.0, 0.0, -3.0}, 24));
  gltf.addRoot(meshNode("floor", gltf.addMesh("floor", {{gltf.addGeometry(grid), floor}})));
}

// A lamp and the shadow of a ball in the smoke.
void addSmokyStage(GltfBuilder& gltf, Json smoke) {
  addFloor(gltf, {0.40, 0.40, 0.42});
  const int red = gltf.addMaterial(paint("red", {0.75, 0.20, 0.15}));
  gltf.addRoot(shapeNode(gltf, "ball", {.params = {0.65, 0.0, 0.0}, .segments = 40}, red, {0.0, 1.0, 0.0}));
  addPointLight(gltf, "lamp", {-2.6, 3.4, 0.6}, {.color = dvec3(6.0), .attenuation = {0.0, 0.0, 0.5}});
  addCamera(gltf, {.eye = {0.0, 2.0, 5.6}, .target = {0.0, 1.0, 0.0}, .yFovDegrees = 28.0});
  gltf.setAtmosphere({{"ambient", listOf(dvec3(0.05))}, {"background", listOf({0.02, 0.03, 0.05})}, {"smoke", smoke}});
}

void smoke(GltfBuilder& gltf) {
  Json smoke = smokeOf("box", 0.06, 0.30, 0.2);
  smoke["center"] = listOf({0.0, 1.2, 0.0});
  smoke["size"] = listOf({4.0, 2.4, 3.0});
  addSmokyStage(gltf, std::move(smoke));
}

// Puffs that rise from a chimney, each wider and thinner than the one below: a sum of Gaussians.
float plumeDensity(const dvec3& p) {
  constexpr int kPuffs = 14;
  double density = 0.0;
  for (int k = 0; k < kPuffs; ++k) {
    const double height = static_cast<double>(k) / (kPuffs - 1), radius = 0.10 + 0.26 * height;
    const dvec3 puff(0.35 * height * std::sin(5.0 * height) + 0.12 * std::sin(9.1 * k), 2.2 + 1.35 * height,
                     0.10 * std::cos(7.3 * k));
    const dvec3 d = (p - puff) / radius;
    density += 0.35 / (0.3 + height) * std::exp(-2.0 * glm::dot(d, d));
  }
  return static_cast<float>(density);
}

// The lamp stands behind the smoke, which scatters forwards.
void smokeGrid(GltfBuilder& gltf) {
  constexpr int kX = 24, kY = 30, kZ = 16;
  const dvec3 center(0.0, 2.95, 0.0), size(2.2, 2.0, 1.6);
  std::vector<float> densities;
  for (int z = 0; z < kZ; ++z) {
    for (int y = 0; y < kY; ++y) {
      for (int x = 0; x < kX; ++x)
        densities.push_back(
            plumeDensity(center + size * (dvec3((x + 0.5) / kX, (y + 0.5) / kY, (z + 0.5) / kZ) - 0.5)));
    }
  }
  addFloor(gltf, {0.30, 0.30, 0.32});
  const int clay = gltf.addMaterial(paint("clay", {0.65, 0.28, 0.16}));
  gltf.addRoot(shapeNode(gltf, "chimney", {.kind = ShapeKind::cylinder, .params = {0.4, 2.1, 0.0}, .segments = 40},
                         clay, {0.0, 1.05, 0.0}));
  addPointLight(gltf, "lamp", {1.9, 3.9, -1.7}, {.color = dvec3(15.0, 14.0, 12.0), .attenuation = {0.0, 0.0, 0.5}});
  addPointLight(gltf, "fill", {-3.0, 3.0, 3.0}, {.color = dvec3(1.6, 2.0, 2.8), .attenuation = {0.0, 0.0, 0.5}});
  addCamera(gltf, {.eye = {0.0, 2.2, 7.0}, .target = {0.0, 1.85, 0.0}, .yFovDegrees = 32.0});
  Json smoke = smokeOf("box", 0.1, 6.0, 0.45);
  smoke["center"] = listOf(center);
  smoke["size"] = listOf(size);
  smoke["grid"] = {{"cellsX", kX}, {"cellsY", kY}, {"cellsZ", kZ}, {"densities", gltf.addScalars(densities)}};
  gltf.setAtmosphere({{"ambient", listOf(dvec3(0.05))}, {"background", listOf({0.02, 0.03, 0.05})}, {"smoke", smoke}});
}

Json bodyMaterial(const char* name, const dvec3& tint, double ior, int priority) {
  Json material = glassMaterial(name, tint, ior);
  material["extensions"]["CROSSLIGHT_materials_dielectric"]["priority"] = priority;
  return material;
}

// A block of water with a ball of ice that sticks out of it, and a ball of glass within.
void nestedMedia(GltfBuilder& gltf) {
  addFloor(gltf, {0.45, 0.45, 0.47});
  const int red = gltf.addMaterial(paint("red", {0.75, 0.15, 0.12}));
  const int water = gltf.addMaterial(bodyMaterial("water", dvec3(1.0), 1.33, 1));
  const int ice = gltf.addMaterial(bodyMaterial("ice", dvec3(1.0), 1.31, 2));
  const int glass = gltf.addMaterial(bodyMaterial("glass", dvec3(1.0), 1.5, 3));
  gltf.addRoot(shapeNode(gltf, "red ball", {.params = {0.4, 0.0, 0.0}}, red, {0.5, 0.4, -1.9}));
  gltf.addRoot(shapeNode(gltf, "water", {.kind = ShapeKind::box, .params = {2.2, 1.6, 1.4}}, water, {0.0, 0.81, 0.0}));
  gltf.addRoot(shapeNode(gltf, "ice", {.params = {0.5, 0.0, 0.0}}, ice, {-0.45, 1.3, 0.1}));
  gltf.addRoot(shapeNode(gltf, "glass", {.params = {0.45, 0.0, 0.0}}, glass, {0.5, 0.7, 0.0}));
  addPointLight(gltf, "key", {-3.0, 5.0, 4.0}, {.color = dvec3(0.9)});
  addCamera(gltf, {.eye = {0.6, 2.2, 5.4}, .target = {0.0, 0.85, 0.0}, .yFovDegrees = 34.0});
  setAtmosphere(gltf, 0.15, {0.09, 0.11, 0.14});
}

// White bars behind a block and a ball of flint with as much dispersion as no glass has: fringes at every edge.
void dispersion(GltfBuilder& gltf) {
  addFloor(gltf, {0.05, 0.05, 0.06});
  const int white = gltf.addMaterial(matte("white", {0.9, 0.9, 0.9}));
  for (int i = 0; i < 9; ++i) {
    gltf.addRoot(shapeNode(gltf, "bar " + std::to_string(i),
                           {.kind = ShapeKind::box, .params = {0.14, 1.8, 0.1}, .segments = 3}, white,
                           {-2.0 + 0.5 * i, 0.9, -1.6}));
  }
  Json flint = glassMaterial("flint", dvec3(1.0), 1.7);
  flint["extensions"]["KHR_materials_dispersion"]["dispersion"] = 2.0;
  const int material = gltf.addMaterial(std::move(flint));
  gltf.addRoot(shapeNode(gltf, "ball", {.params = {0.7, 0.0, 0.0}}, material, {-0.8, 0.71, 0.4}));
  gltf.addRoot(shapeNode(gltf, "block", {.kind = ShapeKind::box, .params = {0.9, 1.2, 0.5}, .segments = 3}, material,
                         {0.95, 0.61, 0.3}));
  addPointLight(gltf, "key", {-2.0, 4.0, 5.0}, {.color = dvec3(1.0)});
  addCamera(gltf, {.eye = {0.5, 1.3, 5.6}, .target = {0.0, 0.75, 0.0}, .yFovDegrees = 42.0});
  setAtmosphere(gltf, 0.2, {0.02, 0.02, 0.03});
}

// A ball of milky glass and a block of amber, lit from the side: what light scatters within them, and their shadows in
// it.
void volumeScatter(GltfBuilder& gltf) {
  addFloor(gltf, {0.03, 0.03, 0.033});  // a light that shows in a body is bright on a floor
  const auto milky = [&](const char* name, const dvec3& left, const dvec3& seen, double g) {
    Json glass = glassMaterial(name, dvec3(1.0), 1.33);
    glass["extensions"]["KHR_materials_volume"]["attenuationColor"] = listOf(left);
    glass["extensions"]["KHR_materials_volume"]["attenuationDistance"] = 1.0;
    glass["extensions"]["KHR_materials_volume_scatter"] = {{"multiscatterColor", listOf(seen)},
                                                           {"scatterAnisotropy", g}};
    return gltf.addMaterial(std::move(glass));
  };
  const int milk = milky("milk", {0.05, 0.05, 0.06}, {0.9, 0.9, 0.9}, 0.0);
  const int amber = milky("amber", {0.3, 0.12, 0.02}, {0.9, 0.5, 0.03}, 0.3);
  gltf.addRoot(shapeNode(gltf, "ball", {.params = {0.7, 0.0, 0.0}}, milk, {-0.8, 0.71, 0.0}));
  Json block = shapeNode(gltf, "block", {.kind = ShapeKind::box, .params = {0.9, 1.2, 0.8}, .segments = 3}, amber,
                         {0.95, 0.61, 0.0});
  block.erase("extensions");  // its triangles are met
  gltf.addRoot(std::move(block));
  addDirectionalLight(gltf, "sun", {0.8, -0.7, -0.5}, {.color = dvec3(22.0)});
  addCamera(gltf, {.eye = {0.3, 1.7, 5.2}, .target = {0.0, 0.6, 0.0}, .yFovDegrees = 38.0});
  setAtmosphere(gltf, 0.05, {0.09, 0.11, 0.14});
}

Json coloredGlass(const char* name, const dvec3& tint, const dvec3& left) {
  Json glass = glassMaterial(name, tint, 1.5);
  glass["extensions"]["KHR_materials_volume"]["attenuationColor"] = listOf(left);
  glass["extensions"]["KHR_materials_volume"]["attenuationDistance"] = 1.0;
  return glass;
}

// Bodies that color light on their way, as a shape and as a mesh, and a pane that tints it: shadows of their colors.
void coloredShadow(GltfBuilder& gltf) {
  addFloor(gltf, {0.75, 0.75, 0.75});
  const int red = gltf.addMaterial(coloredGlass("red glass", dvec3(1.0), {0.8, 0.08, 0.05}));
  const int blue = gltf.addMaterial(coloredGlass("blue glass", dvec3(1.0), {0.1, 0.2, 0.9}));
  Json pane = glassMaterial("green pane", {0.2, 0.8, 0.3}, 1.5);
  pane["extensions"]["KHR_materials_volume"]["thicknessFactor"] = 0.0;
  pane["doubleSided"] = true;
  const int green = gltf.addMaterial(std::move(pane));
  gltf.addRoot(shapeNode(gltf, "red ball", {.params = {0.5, 0.0, 0.0}}, red, {-1.1, 0.51, 0.2}));
  Json ball = shapeNode(gltf, "blue ball", {.params = {0.5, 0.0, 0.0}}, blue, {0.2, 0.51, -0.3});
  ball.erase("extensions");  // its triangles are met
  gltf.addRoot(std::move(ball));
  const Primitive square = withoutUv(gridMesh({1.0, 0.6, 0.6}, {0.36, 0.0, -0.36}, {0.0, 0.55, 0.0}, 1));
  gltf.addRoot(meshNode("pane", gltf.addMesh("pane", {{gltf.addGeometry(square), green}})));
  addDirectionalLight(gltf, "sun", {-0.75, -1.0, -0.35}, {.color = dvec3(0.9)});
  addCamera(gltf, {.eye = {0.4, 3.2, 4.6}, .target = {-0.1, 0.3, 0.0}, .yFovDegrees = 44.0});
  setAtmosphere(gltf, 0.15, {0.09, 0.11, 0.14});
}

constexpr SceneRow kRows[] = {
    {"feature/fog_linear", "fog that grows from start to end", fogLinear},
    {"feature/fog_exp", "fog e^-(density d)", fogExp},
    {"feature/fog_exp2", "fog e^-(density d)^2", fogExp2},
    {"feature/dispersion", "bodies of glass that bend every color by its own index", dispersion},
    {"feature/colored_shadow", "light through colored glass: bodies and a pane", coloredShadow},
    {"feature/volume_scatter", "milky glass and amber: light scattered once within bodies", volumeScatter},
    {"feature/nested_media", "ice and glass that overlap water, kept apart by priority", nestedMedia},
    {"feature/smoke", "even smoke in a box, and a shadow in it", smoke},
    {"feature/smoke_grid", "smoke of a density given by a grid", smokeGrid},
};

}  // namespace

std::span<const SceneRow> airScenes() { return kRows; }

}  // namespace crosslight::scenegen

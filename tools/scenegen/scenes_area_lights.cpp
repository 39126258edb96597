// Scenes per light with an area: rectangle, disk, sphere; on metal and plastic, and on classic materials.
#include <glm/geometric.hpp>

#include "scenegen/meshes.h"
#include "scenegen/parts.h"
#include "scenegen/radiance_picture.h"
#include "scenegen/registry.h"

namespace crosslight::scenegen {
namespace {

using glm::dvec3;

void addStage(GltfBuilder& gltf, Json ball, Json floor) {
  gltf.addRoot(shapeNode(gltf, "ball", {.segments = 48}, gltf.addMaterial(std::move(ball)), {0.0, 1.0, 0.0}));
  const Primitive grid = withoutUv(gridMesh(dvec3(0.0), {3.0, 0.0, 0.0}, {0.0, 0.0, -3.0}, 40));
  const int material = gltf.addMaterial(std::move(floor));
  gltf.addRoot(meshNode("floor", gltf.addMesh("floor", {{gltf.addGeometry(grid), material}})));
  addCamera(gltf, {.eye = {0.0, 2.6, 5.4}, .target = {0.0, 0.85, 0.0}, .yFovDegrees = 36.0});
  setAtmosphere(gltf, 0.05, {0.06, 0.07, 0.09});
}

void addAreaLight(GltfBuilder& gltf, Json light, const dvec3& position, const dvec3& target) {
  Json node = {{"name", light["name"]}, {"matrix", matrixOf(lookAt(position, target, {0.0, 0.0, -1.0}))}};
  node["extensions"]["EXT_lights_area"]["light"] = gltf.addLight(std::move(light), "EXT_lights_area");
  gltf.addRoot(std::move(node));
}

Json areaLight(const char* name, const char* type, const dvec3& color, double nits, double size) {
  return {{"name", name}, {"type", type}, {"color", listOf(color)}, {"intensity", nits}, {"size", size}};
}

// Stands on the floor, half of it below the horizon of much of the ball.
void areaRectangle(GltfBuilder& gltf) {
  addStage(gltf, pbrMaterial("ball", {0.75, 0.72, 0.68}, 0.0, 0.4), pbrMaterial("floor", dvec3(0.6), 0.0, 0.3));
  Json light = areaLight("rectangle", "rect", {1.0, 0.9, 0.75}, 8.0, 2.2);
  light["rect"]["aspect"] = 0.6;
  addAreaLight(gltf, std::move(light), {-2.2, 1.1, 0.6}, {0.0, 1.1, 0.0});
}

void areaDisk(GltfBuilder& gltf) {
  addStage(gltf, paint("ball", {0.6, 0.6, 0.62}), matte("floor", dvec3(0.5)));
  addAreaLight(gltf, areaLight("disk", "disk", {0.85, 0.92, 1.0}, 3.0, 1.6), {-1.5, 2.6, 1.6}, {0.0, 0.9, 0.0});
}

void areaSphere(GltfBuilder& gltf) {
  Json phong = classicMaterial(
      "ball", {.model = "phong", .ka = dvec3(0.3), .kd = dvec3(0.4), .ks = dvec3(0.5), .shininess = 30.0});
  addStage(gltf, std::move(phong), pbrMaterial("floor", dvec3(0.6), 0.0, 0.35));
  Json light = khrLight("sphere", "point", {1.0, 0.95, 0.85}, 6.0);
  light["extensions"]["CROSSLIGHT_lights_area"]["radius"] = 0.5;
  Json node = {{"name", "sphere"}, {"translation", listOf({-1.7, 1.2, 1.0})}};
  node["extensions"]["KHR_lights_punctual"]["light"] = gltf.addLight(std::move(light));
  gltf.addRoot(std::move(node));
}

// Rows of balls, from rough to smooth, metal behind plastic, under a window of light.
void areaGlossy(GltfBuilder& gltf) {
  const double roughness[5] = {0.15, 0.3, 0.45, 0.7, 1.0};
  for (int i = 0; i < 5; ++i) {
    for (int metal = 0; metal < 2; ++metal) {
      const std::string name = (metal == 1 ? "metal " : "plastic ") + std::to_string(i + 1);
      const dvec3 color = metal == 1 ? dvec3(0.95, 0.78, 0.45) : dvec3(0.25, 0.35, 0.6);
      const int material = gltf.addMaterial(pbrMaterial(name, color, metal, roughness[i]));
      gltf.addRoot(shapeNode(gltf, name, {ShapeKind::sphere, {0.45, 0.0, 0.0}, 48}, material,
                             {1.0 * (i - 2), 0.45, metal == 1 ? -0.9 : 0.3}));
    }
  }
  const Primitive grid = withoutUv(gridMesh({0.0, 0.0, -0.3}, {3.2, 0.0, 0.0}, {0.0, 0.0, -2.0}, 40));
  const int floor = gltf.addMaterial(pbrMaterial("floor", dvec3(0.4), 0.0, 0.25));
  gltf.addRoot(meshNode("floor", gltf.addMesh("floor", {{gltf.addGeometry(grid), floor}})));
  Json light = areaLight("window", "rect", dvec3(1.0), 5.0, 1.2);
  light["rect"]["aspect"] = 3.0;
  addAreaLight(gltf, std::move(light), {0.0, 2.0, -2.6}, {0.0, 0.4, 0.0});
  addAreaLight(gltf, areaLight("lamp", "disk", {1.0, 0.8, 0.6}, 6.0, 0.9), {-1.8, 2.2, 2.0}, {0.0, 0.3, 0.0});
  addCamera(gltf, {.eye = {0.0, 2.0, 4.6}, .target = {0.0, 0.35, -0.3}, .yFovDegrees = 65.0});
  setAtmosphere(gltf, 0.0, {0.02, 0.02, 0.03});
}

// A blue sky over brown ground, a bright window of it low on the left.
dvec3 sky(int x, int y) {
  const double height = 1.0 - (y + 0.5) / 16.0;
  const dvec3 ground(0.16, 0.12, 0.08), horizon(0.7, 0.75, 0.8), zenith(0.2, 0.35, 0.7);
  if (x >= 12 && x < 15 && y >= 9 && y < 12) return {60.0, 50.0, 38.0};
  return height < 0.0 ? ground : horizon + (zenith - horizon) * height;
}

void environment(GltfBuilder& gltf) {
  gltf.addFile("environment_sky.hdr", radiancePicture(64, 32, sky));
  gltf.addRoot(shapeNode(gltf, "plastic", {ShapeKind::sphere, {0.7, 0.0, 0.0}, 48},
                         gltf.addMaterial(pbrMaterial("plastic", {0.6, 0.15, 0.1}, 0.0, 0.4)), {-1.55, 0.7, 0.0}));
  gltf.addRoot(shapeNode(gltf, "metal", {ShapeKind::sphere, {0.7, 0.0, 0.0}, 48},
                         gltf.addMaterial(pbrMaterial("metal", {0.95, 0.8, 0.5}, 1.0, 0.25)), {0.0, 0.7, 0.0}));
  gltf.addRoot(shapeNode(gltf, "painted", {ShapeKind::sphere, {0.7, 0.0, 0.0}, 48},
                         gltf.addMaterial(paint("painted", {0.1, 0.14, 0.2}, 0.2, 40.0)), {1.55, 0.7, 0.0}));
  const Primitive grid = withoutUv(gridMesh(dvec3(0.0), {3.0, 0.0, 0.0}, {0.0, 0.0, -2.0}, 40));
  const int floor = gltf.addMaterial(pbrMaterial("floor", dvec3(0.5), 0.0, 0.9));
  gltf.addRoot(meshNode("floor", gltf.addMesh("floor", {{gltf.addGeometry(grid), floor}})));
  addCamera(gltf, {.eye = {0.0, 1.9, 5.4}, .target = {0.0, 0.65, 0.0}, .yFovDegrees = 52.0});
  gltf.setAtmosphere({{"environment", {{"uri", "environment_sky.hdr"}, {"rotation", 0.6}}}});
}

constexpr SceneRow kRows[] = {
    {"feature/environment", "light from an equirectangular picture: plastic, metal and paint", environment},
    {"feature/areaRectangle", "rectangle light of EXT_lights_area, standing on the floor", areaRectangle},
    {"feature/areaDisk", "disk light of EXT_lights_area on classic materials", areaDisk},
    {"feature/areaSphere", "a point light made a sphere by CROSSLIGHT_lights_area", areaSphere},
    {"feature/area_glossy", "rectangle and disk lights in metal and plastic from smooth to rough", areaGlossy},
};

}  // namespace

std::span<const SceneRow> areaLightScenes() { return kRows; }

}  // namespace crosslight::scenegen

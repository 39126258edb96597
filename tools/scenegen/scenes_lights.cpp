// Scenes per light type, and all analytic shapes under transforms.
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scenegen/meshes.h"
#include "scenegen/parts.h"
#include "scenegen/registry.h"

namespace crosslight::scenegen {
namespace {

using glm::dvec3;
constexpr double kPi = std::numbers::pi;

void addGrid(GltfBuilder& gltf, const char* name, int material, const Primitive& grid) {
  gltf.addRoot(meshNode(name, gltf.addMesh(name, {{gltf.addGeometry(withoutUv(grid)), material}})));
}

void addKhrLight(GltfBuilder& gltf, Json light, const dvec3& position, const dvec3& target) {
  Json node = {{"name", light["name"]}, {"matrix", matrixOf(lookAt(position, target, {0.0, 0.0, -1.0}))}};
  node["extensions"]["KHR_lights_punctual"]["light"] = gltf.addLight(std::move(light));
  gltf.addRoot(std::move(node));
}

// A ball on a floor without a light; materials by the caller's family.
void addBallAndFloor(GltfBuilder& gltf, Json ball, Json floor) {
  gltf.addRoot(shapeNode(gltf, "ball", {.segments = 48}, gltf.addMaterial(std::move(ball)), {0.0, 1.0, 0.0}));
  addGrid(gltf, "floor", gltf.addMaterial(std::move(floor)),
          gridMesh(dvec3(0.0), {3.0, 0.0, 0.0}, {0.0, 0.0, -3.0}, 40));
  addCamera(gltf, {.eye = {0.0, 2.6, 5.4}, .target = {0.0, 0.85, 0.0}, .yFovDegrees = 36.0});
  setAtmosphere(gltf, 0.05, {0.06, 0.07, 0.09});
}

void addPbrStage(GltfBuilder& gltf) {
  addBallAndFloor(gltf, pbrMaterial("ball", {0.7, 0.7, 0.72}, 0.0, 0.5), pbrMaterial("floor", dvec3(0.6), 0.0, 1.0));
}

void addClassicStage(GltfBuilder& gltf) {
  addBallAndFloor(gltf, paint("ball", {0.6, 0.6, 0.62}), matte("floor", dvec3(0.5)));
}

void point(GltfBuilder& gltf) {
  addPbrStage(gltf);
  addKhrLight(gltf, khrLight("point", "point", {1.0, 0.9, 0.75}, 26.0), {-1.6, 3.2, 1.8}, dvec3(0.0));
}

void directional(GltfBuilder& gltf) {
  addPbrStage(gltf);
  addKhrLight(gltf, khrLight("directional", "directional", {1.0, 0.95, 0.85}, 3.0), {-1.0, 2.0, 1.0}, dvec3(0.0));
}

void spot(GltfBuilder& gltf) {
  addPbrStage(gltf);
  Json light = khrLight("spot", "spot", {0.85, 0.92, 1.0}, 42.0);
  light["spot"] = {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.45}};
  addKhrLight(gltf, std::move(light), {-1.5, 4.0, 2.0}, {0.1, 0.5, 0.0});
}

void pointClassic(GltfBuilder& gltf) {
  addClassicStage(gltf);
  addPointLight(gltf, "point", {-1.6, 3.2, 1.8}, {.color = {1.0, 0.9, 0.75}, .attenuation = {0.6, 0.0, 0.06}});
}

void directionalClassic(GltfBuilder& gltf) {
  addClassicStage(gltf);
  addDirectionalLight(gltf, "directional", {1.0, -2.0, -1.0}, {.color = {1.0, 0.95, 0.85}});
}

void spotClassic(GltfBuilder& gltf) {
  addClassicStage(gltf);
  addSpotLight(gltf, "spot", {-1.5, 4.0, 2.0}, {0.1, 0.5, 0.0},
               {.color = {0.85, 0.92, 1.0}, .spotCutoff = 24.0, .spotExponent = 12.0});
}

// Above, on the wall: spots with exponents 0, 4, 16, 64 and two cutoffs. Below, close to the floor: point lights with
// constant, linear, quadratic and mixed attenuation.
void spotAttenuation(GltfBuilder& gltf) {
  const int white = gltf.addMaterial(matte("white", dvec3(0.8)));
  addGrid(gltf, "wall", white, gridMesh({0.0, 4.0, -2.0}, {7.0, 0.0, 0.0}, {0.0, 4.0, 0.0}, 64));
  addGrid(gltf, "floor", white, gridMesh({0.0, 0.0, 2.0}, {7.0, 0.0, 0.0}, {0.0, 0.0, -4.0}, 64));
  const double exponents[4] = {0.0, 4.0, 16.0, 64.0}, cutoffs[4] = {20.0, 20.0, 28.0, 28.0};
  const dvec3 attenuations[4] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {0.25, 0.5, 1.5}};
  const dvec3 colors[4] = {{0.40, 0.40, 0.40}, {0.45, 0.30, 0.15}, {0.15, 0.40, 0.20}, {0.20, 0.25, 0.45}};
  for (int i = 0; i < 4; ++i) {
    const double x = 2.8 * (i - 1.5);
    const std::string number = std::to_string(i + 1);
    addSpotLight(gltf, "spot " + number, {x, 3.4, 1.0}, {x, 3.2, -2.0},
                 {.color = dvec3(0.9), .spotCutoff = cutoffs[i], .spotExponent = exponents[i]});
    addPointLight(gltf, "point " + number, {x, 0.7, 0.9}, {.color = colors[i], .attenuation = attenuations[i]});
  }
  addCamera(gltf, {.eye = {0.0, 4.5, 12.5}, .target = {0.0, 2.3, 0.0}, .yFovDegrees = 50.0});
  setAtmosphere(gltf, 0.04, dvec3(0.0));
}

// KHR spots: the smooth step between inner and outer cone, and the inverse square from three heights.
void spotGltf(GltfBuilder& gltf) {
  const int white = gltf.addMaterial(pbrMaterial("white", dvec3(0.8), 0.0, 1.0));
  addGrid(gltf, "floor", white, gridMesh(dvec3(0.0), {7.0, 0.0, 0.0}, {0.0, 0.0, -4.0}, 64));
  const double inner[4] = {0.0, 0.2, 0.38, 0.2}, outer[4] = {0.4, 0.4, 0.4, 0.4}, heights[4] = {3.0, 3.0, 3.0, 4.5};
  for (int i = 0; i < 4; ++i) {
    Json light = khrLight("spot " + std::to_string(i + 1), "spot", dvec3(1.0), 24.0);
    light["spot"] = {{"innerConeAngle", inner[i]}, {"outerConeAngle", outer[i]}};
    if (i == 1) light["range"] = 4.0;
    const double x = 2.8 * (i - 1.5);
    addKhrLight(gltf, std::move(light), {x, heights[i], 0.0}, {x, 0.0, 0.0});
  }
  addCamera(gltf, {.eye = {0.0, 8.0, 9.5}, .target = {0.0, 0.0, 0.2}, .yFovDegrees = 52.0});
  setAtmosphere(gltf, 0.03, dvec3(0.0));
}

Json quaternion(const dvec3& axis, double degrees) {
  const double half = degrees * kPi / 360.0;
  const dvec3 v = std::sin(half) * glm::normalize(axis);
  return {v.x, v.y, v.z, std::cos(half)};
}

// The plane is the floor; its tessellation is a square of it, so it reaches farther in rays than in raster.
void shapes(GltfBuilder& gltf) {
  const int floor = gltf.addMaterial(matte("floor", dvec3(0.5)));
  gltf.addRoot(shapeNode(gltf, "floor", {ShapeKind::plane, dvec3(0.0), 64}, floor));
  const dvec3 colors[6] = {{0.75, 0.20, 0.15}, {0.80, 0.55, 0.12}, {0.30, 0.60, 0.20},
                           {0.12, 0.55, 0.60}, {0.20, 0.30, 0.75}, {0.55, 0.25, 0.65}};
  const auto add = [&](const char* name, ShapeKind kind, const dvec3& params, const dvec3& at, Json rotation,
                       const dvec3& scale) {
    const auto i = static_cast<std::size_t>(kind == ShapeKind::sphere ? 0 : static_cast<int>(kind) - 1);
    Json material = paint(name, colors[i]);
    if (kind == ShapeKind::disk) material["doubleSided"] = true;
    Json node = shapeNode(gltf, name, {kind, params, 48}, gltf.addMaterial(std::move(material)), at);
    node["rotation"] = std::move(rotation);
    node["scale"] = listOf(scale);
    gltf.addRoot(std::move(node));
  };
  const dvec3 one(1.0);
  add("ellipsoid", ShapeKind::sphere, {0.7, 0.0, 0.0}, {-2.0, 0.8, -1.3}, quaternion({0, 0, 1}, 30.0), {1.4, 0.8, 0.9});
  add("disk", ShapeKind::disk, {0.9, 0.0, 0.0}, {0.0, 1.0, -1.8}, quaternion({1, 0.2, 0}, 65.0), one);
  add("box", ShapeKind::box, {1.0, 1.2, 0.8}, {2.0, 0.95, -1.3}, quaternion({1, 1, 0.3}, 35.0), {-1.0, 1.0, 1.0});
  add("elliptic cylinder", ShapeKind::cylinder, {0.5, 1.4, 0.0}, {-1.7, 0.85, 1.0}, quaternion({1, 0, 0.4}, 25.0),
      {1.5, 1.0, 0.7});
  add("mirrored cone", ShapeKind::cone, {0.6, 1.3, 0.0}, {0.1, 0.75, 1.2}, quaternion({0, 0, 1}, -15.0),
      {1.0, -1.0, 1.0});
  add("stretched torus", ShapeKind::torus, {0.65, 0.22, 0.0}, {1.75, 0.85, 1.0}, quaternion({1, 0, 0}, 55.0),
      {1.3, 0.8, 0.9});
  addPointLight(gltf, "key", {-4.0, 7.0, 6.0}, {.color = dvec3(0.75)});
  addPointLight(gltf, "fill", {6.0, 4.0, 4.0}, {.color = dvec3(0.3)});
  addCamera(gltf, {.eye = {0.0, 4.6, 8.0}, .target = {0.0, 0.7, 0.0}, .yFovDegrees = 42.0});
  setAtmosphere(gltf, 0.15, {0.10, 0.12, 0.15});
}

constexpr SceneRow kRows[] = {
    {"feature/shapes", "all seven analytic shapes: rotated, stretched, mirrored", shapes},
    {"feature/point", "KHR point light, inverse square", point},
    {"feature/directional", "KHR directional light", directional},
    {"feature/spot", "KHR spot light", spot},
    {"feature/point_classic", "classic point light with attenuation", pointClassic},
    {"feature/directional_classic", "classic directional light", directionalClassic},
    {"feature/spot_classic", "classic spot with cutoff and exponent", spotClassic},
    {"feature/spot_attenuation", "classic spots of several exponents and cutoffs; kc, kl, kq", spotAttenuation},
    {"feature/spot_gltf", "KHR cones from smooth to sharp, a range, the inverse square", spotGltf},
};

}  // namespace

std::span<const SceneRow> lightScenes() { return kRows; }

}  // namespace crosslight::scenegen

#include "scenegen/material_stage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/shape_mesh.h"
#include "scenegen/meshes.h"
#include "scenegen/parts.h"
#include "scenegen/png.h"

namespace crosslight::scenegen {

using glm::dvec3;

void addFloorAndCamera(GltfBuilder& gltf, Json floor) {
  const int material = gltf.addMaterial(std::move(floor));
  const Primitive grid = withoutUv(gridMesh(dvec3(0.0), {3.0, 0.0, 0.0}, {0.0, 0.0, -3.0}, 16));
  gltf.addRoot(meshNode("floor", gltf.addMesh("floor", {{gltf.addGeometry(grid), material}})));
  addCamera(gltf, {.eye = {0.0, 2.6, 5.4}, .target = {0.0, 0.85, 0.0}, .yFovDegrees = 36.0});
  setAtmosphere(gltf, 0.15, {0.09, 0.11, 0.14});
}

void addClassicStage(GltfBuilder& gltf) {
  addFloorAndCamera(gltf, matte("floor", {0.45, 0.45, 0.47}));
  addPointLight(gltf, "key", {-3.0, 5.0, 4.0}, {.color = dvec3(0.9)});
  addPointLight(gltf, "rim", {4.0, 2.5, -3.0}, {.color = {0.4, 0.45, 0.5}});
}

void addKhrPoint(GltfBuilder& gltf, const std::string& name, const dvec3& position, const dvec3& color,
                 double candela) {
  Json node = {{"name", name}, {"translation", listOf(position)}};
  node["extensions"]["KHR_lights_punctual"]["light"] = gltf.addLight(khrLight(name, "point", color, candela));
  gltf.addRoot(std::move(node));
}

void addPbrStage(GltfBuilder& gltf) {
  addFloorAndCamera(gltf, pbrMaterial("floor", {0.45, 0.45, 0.47}, 0.0, 1.0));
  addKhrPoint(gltf, "key", {-3.0, 5.0, 4.0}, dvec3(1.0), 120.0);
  addKhrPoint(gltf, "rim", {4.0, 2.5, -3.0}, {0.8, 0.9, 1.0}, 60.0);
}

void addBalls(GltfBuilder& gltf, Json left, Json right) {
  const Json geometry =
      gltf.addGeometry(tessellateShape(ShapeKind::sphere, {0.66f, 0.0f, 0.0f, 0.0f}, kBallSegments, 1.0));
  const auto add = [&](const char* name, Json look, double x) {
    const int material = gltf.addMaterial(std::move(look));
    Json node = meshNode(name, gltf.addMesh(name, {{geometry, material}}), {x, 0.66, 0.0});
    node["extensions"]["CROSSLIGHT_node_shape"] = shapeExtension({.params = {0.66, 0.0, 0.0}}, material);
    gltf.addRoot(std::move(node));
  };
  add("left ball", std::move(left), -0.72);
  add("right ball", std::move(right), 0.72);
}

void addBallMeshes(GltfBuilder& gltf, Json left, Json right) {
  Primitive ball = tessellateShape(ShapeKind::sphere, {0.66f, 0.0f, 0.0f, 0.0f}, kBallSegments, 1.0);
  for (const glm::vec3& n : ball.normals) {
    const glm::dvec2 around(-static_cast<double>(n.z), static_cast<double>(n.x));
    const double length = std::hypot(around.x, around.y);
    const glm::dvec2 t = length > 1e-6 ? around / length : glm::dvec2(1.0, 0.0);
    ball.tangents.emplace_back(static_cast<float>(t.x), 0.0f, static_cast<float>(t.y), 1.0f);
  }
  const Json geometry = gltf.addGeometry(ball);
  const auto add = [&](const char* name, Json material, double x) {
    const int mesh = gltf.addMesh(name, {{geometry, gltf.addMaterial(std::move(material))}});
    gltf.addRoot(meshNode(name, mesh, {x, 0.66, 0.0}));
  };
  add("left ball", std::move(left), -0.72);
  add("right ball", std::move(right), 0.72);
}

Json withExtension(Json material, const char* name, Json extension) {
  material["extensions"][name] = std::move(extension);
  return material;
}

int wavesTexture(GltfBuilder& gltf) {
  const auto png = makePng(32, 32, 4, [](std::uint32_t x, std::uint32_t y, std::uint8_t* out) {
    const double u = 2.0 * std::numbers::pi * (x + 0.5) / 32.0, v = 2.0 * std::numbers::pi * (y + 0.5) / 32.0;
    const double waves[4] = {0.6 + 0.4 * std::sin(2.0 * u), 0.6 + 0.4 * std::sin(2.0 * v), 0.6 + 0.4 * std::cos(u + v),
                             0.6 + 0.4 * std::cos(2.0 * u) * std::cos(v)};
    for (int i = 0; i < 4; ++i) out[i] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(waves[i], 0.0, 1.0)));
  });
  return gltf.addTexture("waves", png,
                         {{"magFilter", kLinear}, {"minFilter", kLinear}, {"wrapS", kRepeat}, {"wrapT", kRepeat}});
}

}  // namespace crosslight::scenegen

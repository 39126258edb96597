// The smallest scene for each illumination model, shape and surface feature: a ball or a tile, a floor, one light.
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/shape_mesh.h"
#include "scenegen/meshes.h"
#include "scenegen/parts.h"
#include "scenegen/png.h"
#include "scenegen/registry.h"

namespace crosslight::scenegen {
namespace {

using glm::dvec3;

constexpr int kNearest = 9728, kLinear = 9729, kRepeat = 10497;

void addStage(GltfBuilder& gltf) {
  const int floor = gltf.addMaterial(matte("floor", {0.45, 0.45, 0.47}));
  const Primitive grid = withoutUv(gridMesh(dvec3(0.0), {3.0, 0.0, 0.0}, {0.0, 0.0, -3.0}, 24));
  gltf.addRoot(meshNode("floor", gltf.addMesh("floor", {{gltf.addGeometry(grid), floor}})));
  addPointLight(gltf, "key", {-3.0, 5.0, 4.0}, {.color = dvec3(0.9)});
  addCamera(gltf, {.eye = {0.0, 2.6, 5.4}, .target = {0.0, 0.85, 0.0}, .yFovDegrees = 36.0});
  setAtmosphere(gltf, 0.15, {0.09, 0.11, 0.14});
}

void ballScene(GltfBuilder& gltf, Json material) {
  const int index = gltf.addMaterial(std::move(material));
  gltf.addRoot(shapeNode(gltf, "ball", {.segments = 48}, index, {0.0, 1.0, 0.0}));
  addStage(gltf);
}

// An upright tile, seen from the front; tangents along its u.
Primitive tileMesh(int steps) {
  Primitive tile = gridMesh({0.0, 1.1, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, steps);
  tile.tangents.assign(tile.positions.size(), {1.0f, 0.0f, 0.0f, 1.0f});
  return tile;
}

void tileScene(GltfBuilder& gltf, const Primitive& tile, Json material) {
  const int mesh = gltf.addMesh("tile", {{gltf.addGeometry(tile), gltf.addMaterial(std::move(material))}});
  gltf.addRoot(meshNode("tile", mesh));
  addStage(gltf);
}

Json sampler(int filter) {
  return {{"magFilter", filter}, {"minFilter", filter}, {"wrapS", kRepeat}, {"wrapT", kRepeat}};
}

Primitive withoutTangents(Primitive mesh) {
  mesh.tangents.clear();
  return mesh;
}

std::uint8_t byteOf(double value) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

// Woven stripes, smooth, periodic.
int weaveTexture(GltfBuilder& gltf) {
  const auto png = makePng(64, 64, 3, [](std::uint32_t x, std::uint32_t y, std::uint8_t* out) {
    const double a = std::sin(2.0 * std::numbers::pi * (x + 0.5) / 16.0);
    const double b = std::sin(2.0 * std::numbers::pi * (y + 0.5) / 16.0);
    out[0] = byteOf(0.55 + 0.35 * a);
    out[1] = byteOf(0.50 + 0.30 * a * b);
    out[2] = byteOf(0.45 + 0.35 * b);
  });
  return gltf.addTexture("weave", png, sampler(kLinear));
}

// Alpha 1 in a ring pattern, 0 elsewhere, with a linear slope between: the cutoff decides where the edge lies.
int ringsTexture(GltfBuilder& gltf) {
  const auto png = makePng(64, 64, 4, [](std::uint32_t x, std::uint32_t y, std::uint8_t* out) {
    const double r = std::hypot(x + 0.5 - 32.0, y + 0.5 - 32.0) / 32.0;
    out[0] = 200;
    out[1] = 120;
    out[2] = 40;
    out[3] = r < 1.0 ? byteOf(0.5 + 1.5 * std::cos(5.0 * std::numbers::pi * r)) : 0;
  });
  return gltf.addTexture("rings", png, sampler(kLinear));
}

// Normals of the height field h = c sin(x) sin(y), c chosen for slopes up to 1.
int bumpsTexture(GltfBuilder& gltf) {
  const auto png = makePng(64, 64, 3, [](std::uint32_t x, std::uint32_t y, std::uint8_t* out) {
    const double s = 2.0 * std::numbers::pi * (x + 0.5) / 32.0, t = 2.0 * std::numbers::pi * (y + 0.5) / 32.0;
    // Image rows run down, glTF's +Y of normal maps points up.
    const dvec3 n = glm::normalize(dvec3(-std::cos(s) * std::sin(t), std::sin(s) * std::cos(t), 1.0));
    for (int i = 0; i < 3; ++i) out[i] = byteOf(0.5 * n[i] + 0.5);
  });
  return gltf.addTexture("bumps", png, sampler(kLinear));
}

void lambert(GltfBuilder& gltf) { ballScene(gltf, matte("lambert", {0.70, 0.36, 0.20})); }

void phong(GltfBuilder& gltf) {
  Json material = paint("phong", {0.20, 0.36, 0.70}, 0.5, 30.0);
  material["extensions"]["CROSSLIGHT_materials_classic"]["model"] = "phong";
  ballScene(gltf, std::move(material));
}

void blinnPhong(GltfBuilder& gltf) { ballScene(gltf, paint("blinnPhong", {0.20, 0.60, 0.30}, 0.5, 30.0)); }

void cookTorrance(GltfBuilder& gltf) {
  const int metal = gltf.addMaterial(pbrMaterial("rough metal", {0.95, 0.64, 0.54}, 1.0, 0.35));
  const int plastic = gltf.addMaterial(pbrMaterial("plastic", {0.15, 0.45, 0.75}, 0.0, 0.4));
  gltf.addRoot(shapeNode(gltf, "metal ball", {.params = {0.66, 0.0, 0.0}, .segments = 48}, metal, {-0.72, 0.66, 0.0}));
  gltf.addRoot(
      shapeNode(gltf, "plastic ball", {.params = {0.66, 0.0, 0.0}, .segments = 48}, plastic, {0.72, 0.66, 0.0}));
  addStage(gltf);
}

void unlit(GltfBuilder& gltf) {
  Json material = pbrMaterial("unlit", {0.25, 0.65, 0.55}, 0.0, 1.0);
  material["extensions"]["KHR_materials_unlit"] = Json::object();
  ballScene(gltf, std::move(material));
}

void mirror(GltfBuilder& gltf) {
  const int red = gltf.addMaterial(paint("red", {0.75, 0.15, 0.12}));
  gltf.addRoot(shapeNode(gltf, "red ball", {.params = {0.4, 0.0, 0.0}}, red, {0.85, 0.4, 0.95}));
  ballScene(gltf, classicMaterial(
                      "mirror",
                      {.ka = dvec3(0.02), .kd = dvec3(0.05), .ks = dvec3(0.5), .shininess = 100.0, .kr = dvec3(0.9)}));
}

// A wall that is a mirror, turned, behind a ball and a leaning tile.
void flatMirror(GltfBuilder& gltf) {
  const int glass = gltf.addMaterial(
      classicMaterial("looking glass", {.ka = dvec3(0.02), .kd = dvec3(0.05), .kr = dvec3(0.8, 0.85, 0.8)}));
  const Primitive wall = withoutUv(gridMesh({0.2, 1.2, -1.2}, {1.4, 0.0, 0.4}, {0.0, 1.1, 0.0}, 4));
  gltf.addRoot(meshNode("looking glass", gltf.addMesh("looking glass", {{gltf.addGeometry(wall), glass}})));
  const int blue = gltf.addMaterial(
      classicMaterial("blue", {.model = "lambert", .ka = {0.2, 0.3, 0.7}, .kd = {0.2, 0.3, 0.7}, .doubleSided = true}));
  const Primitive tile = withoutUv(gridMesh({-0.85, 0.7, 0.5}, {0.5, 0.1, 0.2}, {0.0, 0.6, -0.3}, 4));
  gltf.addRoot(meshNode("tile", gltf.addMesh("tile", {{gltf.addGeometry(tile), blue}})));
  const int red = gltf.addMaterial(paint("red", {0.75, 0.15, 0.12}));
  gltf.addRoot(shapeNode(gltf, "red ball", {.params = {0.5, 0.0, 0.0}}, red, {0.7, 0.5, 0.5}));
  addStage(gltf);
}

void refraction(GltfBuilder& gltf) {
  const int red = gltf.addMaterial(paint("red", {0.75, 0.15, 0.12}));
  gltf.addRoot(shapeNode(gltf, "red ball", {.params = {0.4, 0.0, 0.0}}, red, {0.9, 0.4, -1.6}));
  ballScene(gltf, glassMaterial("glass", dvec3(1.0), 1.5));
}

void transparency(GltfBuilder& gltf) {
  const int red = gltf.addMaterial(paint("red", {0.75, 0.15, 0.12}));
  gltf.addRoot(shapeNode(gltf, "red ball", {.params = {0.4, 0.0, 0.0}}, red, {0.9, 0.4, -1.6}));
  ballScene(gltf, classicMaterial("clear", {.ka = dvec3(0.2, 0.4, 0.5),
                                            .kd = dvec3(0.2, 0.4, 0.5),
                                            .ks = dvec3(0.5),
                                            .shininess = 60.0,
                                            .transparency = 0.6}));
}

void emission(GltfBuilder& gltf) {
  Json material = pbrMaterial("glowing", dvec3(0.1), 0.0, 1.0);
  material["emissiveFactor"] = {0.9, 0.45, 0.1};
  material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 1.5;
  ballScene(gltf, std::move(material));
}

void texture(GltfBuilder& gltf) {
  Json material = pbrMaterial("woven", dvec3(1.0), 0.0, 0.8);
  Json& use = material["pbrMetallicRoughness"]["baseColorTexture"];
  use["index"] = weaveTexture(gltf);
  use["extensions"]["KHR_texture_transform"]["scale"] = {2.0, 2.0};
  tileScene(gltf, withoutTangents(tileMesh(4)), std::move(material));
}

void textureNearest(GltfBuilder& gltf) {
  const auto png = makePng(
      4, 4, 1, [](std::uint32_t x, std::uint32_t y, std::uint8_t* out) { out[0] = (x + y) % 2 == 0 ? 230 : 40; });
  Json material = matte("checks", dvec3(0.9));
  material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = gltf.addTexture("checks", png, sampler(kNearest));
  tileScene(gltf, withoutTangents(tileMesh(4)), std::move(material));
}

void normalMap(GltfBuilder& gltf) {
  Json material = pbrMaterial("bumpy", {0.6, 0.55, 0.5}, 0.0, 0.5);
  material["normalTexture"]["index"] = bumpsTexture(gltf);
  tileScene(gltf, tileMesh(4), std::move(material));
}

void alphaMask(GltfBuilder& gltf) {
  Json material = pbrMaterial("rings", dvec3(1.0), 0.0, 0.8);
  material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = ringsTexture(gltf);
  material["alphaMode"] = "MASK";
  material["alphaCutoff"] = 0.5;
  material["doubleSided"] = true;
  tileScene(gltf, withoutTangents(tileMesh(4)), std::move(material));
}

void alphaBlend(GltfBuilder& gltf) {
  const dvec3 colors[3] = {{0.8, 0.2, 0.2}, {0.2, 0.7, 0.3}, {0.2, 0.3, 0.8}};
  for (int i = 0; i < 3; ++i) {
    Json material = pbrMaterial("film", colors[i], 0.0, 0.8);
    material["pbrMetallicRoughness"]["baseColorFactor"][3] = 0.5;
    material["alphaMode"] = "BLEND";
    material["doubleSided"] = true;
    const dvec3 center(0.5 * (i - 1), 0.9 + 0.2 * i, 0.4 * (1 - i));
    const Primitive sheet = withoutUv(gridMesh(center, {0.7, 0.0, 0.0}, {0.0, 0.7, 0.0}, 8));
    const int mesh = gltf.addMesh("film", {{gltf.addGeometry(sheet), gltf.addMaterial(std::move(material))}});
    gltf.addRoot(meshNode("film", mesh));
  }
  addStage(gltf);
}

void vertexColors(GltfBuilder& gltf) {
  Primitive tile = withoutTangents(tileMesh(8));
  for (const glm::vec2& uv : tile.uv0) tile.colors.emplace_back(uv.x, uv.y, 1.0f - uv.x, 1.0f);
  tile.uv0.clear();
  tileScene(gltf, tile, pbrMaterial("painted by vertex", dvec3(1.0), 0.0, 0.8));
}

constexpr SceneRow kRows[] = {
    {"feature/lambert", "illumination model lambert", lambert},
    {"feature/phong", "illumination model phong, (R.V)^n", phong},
    {"feature/blinnPhong", "illumination model blinnPhong, (N.H)^n", blinnPhong},
    {"feature/cookTorrance", "illumination model cookTorrance: a metal and a plastic ball", cookTorrance},
    {"feature/unlit", "KHR_materials_unlit", unlit},
    {"feature/mirror", "reflectionFactor of the classic material", mirror},
    {"feature/flat_mirror", "a flat mirror, which raster methods can show too", flatMirror},
    {"feature/refraction", "transmission with an index of refraction and a volume", refraction},
    {"feature/transparency", "classic transparency kt", transparency},
    {"feature/emission", "emissive factor and strength", emission},
    {"feature/texture", "a linear, repeated and transformed base color texture", texture},
    {"feature/texture_nearest", "a texture without filtering on a classic material", textureNearest},
    {"feature/normal_map", "a normal map with tangents", normalMap},
    {"feature/alpha_mask", "alpha mask with a cutoff of one half", alphaMask},
    {"feature/alpha_blend", "three half-transparent sheets, one behind the other", alphaBlend},
    {"feature/vertex_colors", "colors by vertex (COLOR_0)", vertexColors},
};

}  // namespace

std::span<const SceneRow> featureScenes() { return kRows; }

}  // namespace crosslight::scenegen

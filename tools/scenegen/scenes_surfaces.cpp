// The smallest scenes of what textures do besides coloring: levels, bumps, displacement.
#include <cmath>
#include <numbers>

#include "scene/shape_mesh.h"
#include "scenegen/material_stage.h"
#include "scenegen/meshes.h"
#include "scenegen/parts.h"
#include "scenegen/png.h"
#include "scenegen/registry.h"

namespace crosslight::scenegen {
namespace {

using glm::dvec3;

// A tiled floor to the horizon, sharp near and gray far; a mirror that shows it once more.
void mipmaps(GltfBuilder& gltf) {
  const auto png = makePng(32, 32, 1, [](std::uint32_t x, std::uint32_t y, std::uint8_t* out) {
    out[0] = x % 16 == 0 || y % 16 == 0 ? 20 : ((x / 16 + y / 16) % 2 == 0 ? 220 : 90);
  });
  constexpr int kLinearMipmapLinear = 9987;
  const int tiles = gltf.addTexture(
      "tiles", png,
      {{"magFilter", kLinear}, {"minFilter", kLinearMipmapLinear}, {"wrapS", kRepeat}, {"wrapT", kRepeat}});
  Json material = matte("tiles", dvec3(0.9));
  Json& use = material["pbrMetallicRoughness"]["baseColorTexture"];
  use["index"] = tiles;
  use["extensions"]["KHR_texture_transform"]["scale"] = {24.0, 24.0};
  const Primitive floor = gridMesh({0.0, 0.0, -9.0}, {12.0, 0.0, 0.0}, {0.0, 0.0, -12.0}, 4);
  gltf.addRoot(
      meshNode("floor", gltf.addMesh("floor", {{gltf.addGeometry(floor), gltf.addMaterial(std::move(material))}})));
  const int mirror = gltf.addMaterial(classicMaterial(
      "mirror", {.ka = dvec3(0.02), .kd = dvec3(0.02), .ks = dvec3(0.2), .shininess = 100.0, .kr = dvec3(0.9)}));
  const Primitive wall = withoutUv(gridMesh({0.9, 1.3, -4.0}, {1.9, 0.0, 0.6}, {0.0, 1.2, 0.0}, 4));
  gltf.addRoot(meshNode("mirror", gltf.addMesh("mirror", {{gltf.addGeometry(wall), mirror}})));
  addPointLight(gltf, "key", {-3.0, 8.0, 4.0}, {.color = dvec3(0.9)});
  addCamera(gltf, {.eye = {0.0, 1.2, 3.0}, .target = {0.0, 0.6, -2.0}, .yFovDegrees = 50.0});
  setAtmosphere(gltf, 0.15, {0.09, 0.11, 0.14});
}

// Rings of height 0.04 on a tile, its texture coordinates as they are and mirrored.
void bumpMap(GltfBuilder& gltf) {
  const auto png = makePng(64, 64, 1, [](std::uint32_t x, std::uint32_t y, std::uint8_t* out) {
    const double r = std::hypot(x + 0.5 - 32.0, y + 0.5 - 32.0) / 32.0;
    out[0] = static_cast<std::uint8_t>(
        std::lround(255.0 * (0.5 + 0.5 * std::cos(6.0 * std::numbers::pi * std::min(r, 1.0)))));
  });
  const int rings = gltf.addTexture(
      "rings", png, {{"magFilter", kLinear}, {"minFilter", kLinear}, {"wrapS", kRepeat}, {"wrapT", kRepeat}});
  const int material =
      gltf.addMaterial(withExtension(pbrMaterial("embossed", {0.6, 0.55, 0.5}, 0.0, 0.5), "EXT_materials_bump",
                                     {{"bumpTexture", textureInfo(rings)}, {"bumpFactor", 0.04}}));
  for (const bool mirrored : {false, true}) {
    Primitive tile = gridMesh({mirrored ? 0.85 : -0.85, 1.0, 0.0}, {0.75, 0.0, 0.0}, {0.0, 0.75, 0.0}, 2);
    for (glm::vec2& uv : tile.uv0) uv.x = mirrored ? 1.0f - uv.x : uv.x;
    gltf.addRoot(meshNode("tile", gltf.addMesh("tile", {{gltf.addGeometry(tile), material}})));
  }
  addPbrStage(gltf);
}

// A ball with dents (its texture meets itself at a seam) and a wavy tile with sharp borders.
void displacement(GltfBuilder& gltf) {
  const auto png = makePng(64, 32, 1, [](std::uint32_t x, std::uint32_t y, std::uint8_t* out) {
    const double u = 2.0 * std::numbers::pi * (x + 0.5) / 64.0, v = std::numbers::pi * (y + 0.5) / 32.0;
    // Flat towards the poles, where all u meet.
    const double height = 0.5 + 0.5 * std::sin(6.0 * u) * std::sin(5.0 * v) * std::sin(v) * std::sin(v);
    out[0] = static_cast<std::uint8_t>(std::lround(255.0 * height));
  });
  const int dents = gltf.addTexture(
      "dents", png, {{"magFilter", kLinear}, {"minFilter", kLinear}, {"wrapS", kRepeat}, {"wrapT", kRepeat}});
  const auto displaced = [&](const char* name, const dvec3& color, double scale, double bias) {
    return withExtension(paint(name, color), "CROSSLIGHT_materials_displacement",
                         {{"displacementTexture", textureInfo(dents)}, {"scale", scale}, {"bias", bias}});
  };
  const Primitive ball = tessellateShape(ShapeKind::sphere, {0.6f, 0.0f, 0.0f, 0.0f}, 12, 1.0);
  const int ballMaterial = gltf.addMaterial(displaced("dented", {0.7, 0.45, 0.2}, 0.2, -0.1));
  gltf.addRoot(meshNode("ball", gltf.addMesh("ball", {{gltf.addGeometry(ball), ballMaterial}}), {-0.8, 0.72, 0.0}));
  const Primitive tile = gridMesh({0.85, 0.9, 0.0}, {0.65, 0.0, -0.2}, {0.0, 0.7, 0.0}, 3);
  const int tileMaterial = gltf.addMaterial(displaced("wavy", {0.25, 0.5, 0.65}, 0.15, 0.0));
  gltf.addRoot(meshNode("tile", gltf.addMesh("tile", {{gltf.addGeometry(tile), tileMaterial}})));
  addClassicStage(gltf);
}

constexpr SceneRow kRows[] = {
    {"feature/mipmaps", "a floor of tiles with levels, seen directly and in a mirror", mipmaps},
    {"feature/bump_map", "EXT_materials_bump on texture coordinates as they are and mirrored", bumpMap},
    {"feature/displacement", "CROSSLIGHT_materials_displacement on a closed ball and a tile", displacement},
};

}  // namespace

std::span<const SceneRow> surfaceScenes() { return kRows; }

}  // namespace crosslight::scenegen

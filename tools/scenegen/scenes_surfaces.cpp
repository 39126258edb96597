// The smallest scenes of what textures do besides coloring.
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
    {"feature/displacement", "CROSSLIGHT_materials_displacement on a closed ball and a tile", displacement},
};

}  // namespace

std::span<const SceneRow> surfaceScenes() { return kRows; }

}  // namespace crosslight::scenegen

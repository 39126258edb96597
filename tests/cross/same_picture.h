// What comparisons of raster with rays share: the same geometry for both, and which pixels may be compared.
#pragma once

#include "effects/material_traits.h"
#include "structs.h"
#include "support/render_fixture.h"

namespace crosslight::testing {

// Rays see shapes' meshes here, so that both worlds have the same geometry: analytic shapes have tests of their own.
inline Scene asMeshes(Scene scene) {
  for (MeshInstance& instance : scene.instances) instance.replacedByShape = false;
  std::vector<ShapeInstance> kept;
  for (const ShapeInstance& shape : scene.shapes) {
    const bool hasMesh = std::any_of(scene.instances.begin(), scene.instances.end(),
                                     [&](const MeshInstance& i) { return i.instanceId == shape.instanceId; });
    if (!hasMesh) kept.push_back(shape);
  }
  scene.shapes = kept;
  return scene;
}

// Where one pixel's color hangs on the last bit of a coordinate, in either world: at the edge between two triangles
// that are not neighbours (a fold of one object) and at an edge within a texture.
class Steady {
 public:
  Steady(const Image& raster, const Image& rays)
      : width_(raster.width),
        triangleA_(raster.find("primitiveId")->integers),
        triangleB_(rays.find("primitiveId")->integers),
        albedo_(raster.find("albedo")->samples) {}

  // Interior pixels only: the neighbours exist.
  bool operator()(std::uint32_t x, std::uint32_t y) const {
    const std::size_t at = std::size_t{y} * width_ + x;
    if (triangleA_[at] != triangleB_[at]) return false;
    for (const std::size_t neighbour : {at - 1, at + 1, at - width_, at + width_}) {
      for (std::size_t c = 0; c < 3; ++c) {
        if (std::abs(albedo_[3 * at + c] - albedo_[3 * neighbour + c]) > kTextureEdge) return false;
      }
    }
    return true;
  }

 private:
  static constexpr float kTextureEdge =
      0.05f;  // a step of albedo that no smooth texture of the scenes takes in a pixel
  std::uint32_t width_;
  const std::vector<std::uint32_t>&triangleA_, &triangleB_;
  const std::vector<float>& albedo_;
};

// The same for what shows through a transparent surface, of which AOVs say nothing: an edge where the picture changes.
class SteadyThrough {
 public:
  SteadyThrough(const Scene& scene, const Image& picture)
      : scene_(scene), picture_(picture), materials_(picture.find("materialId")->integers) {}

  bool operator()(std::uint32_t x, std::uint32_t y) const {
    const std::uint32_t material = materials_[std::size_t{y} * picture_.width + x];
    if (material == shared::kNoId || !isTransparent(scene_.materials[material])) return true;
    const auto here = pixelAt(picture_, x, y);
    for (const auto& [u, v] : {std::pair(x - 1, y), {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
      const auto there = pixelAt(picture_, u, v);
      for (std::size_t c = 0; c < 3; ++c) {
        if (std::abs(there[c] - here[c]) > kEdge) return false;
      }
    }
    return true;
  }

 private:
  static constexpr float kEdge = 0.05f;  // more than light changes in a pixel of the scenes
  const Scene& scene_;
  const Image& picture_;
  const std::vector<std::uint32_t>& materials_;
};

}  // namespace crosslight::testing

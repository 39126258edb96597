// Things stand about the origin, within 2 scene units; the camera looks there, sometimes from within one of them.
#include "scenegen/random_scene.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/shape_mesh.h"
#include "scenegen/dice.h"
#include "scenegen/meshes.h"
#include "scenegen/parts.h"
#include "scenegen/random_lights.h"
#include "scenegen/random_materials.h"

namespace crosslight::scenegen {
namespace {

using glm::dvec3;

constexpr int kSegments = 10;

Json rotationOf(Dice& dice) {
  const dvec3 axis = glm::normalize(dice.vector(-1.0, 1.0) + dvec3(0.0, 1e-3, 0.0));
  const double half = dice.between(0.0, std::numbers::pi);
  const dvec3 v = std::sin(half) * axis;
  return {v.x, v.y, v.z, std::cos(half)};
}

class Things {
 public:
  Things(GltfBuilder& gltf, Dice& dice) : gltf_(gltf), dice_(dice), materials_(gltf, dice) {
    const int count = 2 + dice_.below(3);
    for (int i = 0; i < count; ++i) looks_.push_back(materials_.add(true));
  }

  void addAll() {
    // Now and then nothing but shapes that stand for themselves: no triangle at all.
    const bool shapesAlone = dice_.oneIn(12);
    if (!shapesAlone && !dice_.oneIn(3)) addFloor();
    const int count = 2 + dice_.below(4);
    for (int i = 0; i < count; ++i) {
      shapesAlone || dice_.oneIn(3) ? addShape() : addMeshes();
    }
  }

  const std::vector<dvec3>& places() const { return places_; }

 private:
  int look() { return looks_[static_cast<std::size_t>(dice_.below(static_cast<int>(looks_.size())))]; }

  dvec3 place() {
    const dvec3 at = dice_.vector(-1.6, 1.6);
    places_.push_back({at.x, 0.2 + 0.5 * at.y, at.z});
    return places_.back();
  }

  void turn(Json& node) {
    if (!dice_.oneIn(3)) node["rotation"] = rotationOf(dice_);
    const int scaling = dice_.below(4);
    if (scaling == 1) node["scale"] = listOf(dvec3(dice_.pick({0.5, 1.5})));
    if (scaling == 2) node["scale"] = listOf(dice_.vector(0.4, 1.5));
    if (scaling == 3) node["scale"] = listOf({dice_.pick({-1.0, 1.0}), dice_.pick({-0.7, 1.2}), 1.0});
  }

  void addFloor() {
    const int steps = dice_.pick({1, 6});
    Primitive floor = gridMesh({0.0, -0.9, 0.0}, {3.0, 0.0, 0.0}, {0.0, 0.0, -3.0}, steps);
    finish(floor);
    const Json geometry = gltf_.addGeometry(floor);
    gltf_.addRoot(meshNode("floor", gltf_.addMesh("floor", {{geometry, look()}})));
  }

  // Attributes that a mesh may have or lack.
  void finish(Primitive& mesh) {
    if (dice_.oneIn(8)) mesh.uv0.clear();
    if (!dice_.oneIn(3)) {
      for (const glm::vec2& uv : mesh.uv0) mesh.uv1.push_back({1.5f * uv.y, 0.5f - uv.x});
    }
    if (!dice_.oneIn(4)) return;
    const float alpha = dice_.oneIn(2) ? 1.0f : 0.6f;
    for (const glm::vec3& p : mesh.positions) mesh.colors.push_back({p.x > 0.0f ? 1.0f : 0.4f, 0.8f, 0.9f, alpha});
  }

  Primitive anyMesh() {
    const int kind = dice_.below(6);
    if (kind == 0) {
      Primitive solid = polyhedronMesh(platonicSolids()[static_cast<std::size_t>(dice_.below(5))]);
      solid.flatNormals = true;
      return solid;
    }
    if (kind == 1) {
      const int steps = dice_.pick({1, 4});
      return gridMesh(dvec3(0.0), {0.8, 0.0, 0.2}, {0.0, 0.7, 0.0}, steps);
    }
    const ShapeSpec shape = anyShape();
    return tessellateShape(shape.kind, glm::vec4(glm::vec3(shape.params), 0.0f), kSegments, 2.0);
  }

  ShapeSpec anyShape() {
    ShapeSpec shape{.kind = static_cast<ShapeKind>(dice_.pick({0, 0, 1, 2, 3, 4, 5, 6})), .segments = kSegments};
    if (shape.kind == ShapeKind::plane && !dice_.oneIn(3)) shape.kind = ShapeKind::sphere;
    shape.params = {dice_.between(0.4, 0.8), 0.0, 0.0};
    if (shape.kind == ShapeKind::box) shape.params = dice_.vector(0.4, 1.2);
    if (shape.kind == ShapeKind::cylinder || shape.kind == ShapeKind::cone) shape.params.y = dice_.between(0.5, 1.4);
    if (shape.kind == ShapeKind::torus) shape.params.y = dice_.between(0.1, 0.3);
    return shape;
  }

  void addShape() {
    const ShapeSpec shape = anyShape();
    const int material = look();
    Json node;
    if (dice_.oneIn(3)) {  // without a mesh of the file's
      node["extensions"]["CROSSLIGHT_node_shape"] = shapeExtension(shape, material);
    } else {
      node = shapeNode(gltf_, "", shape, material);
    }
    node["name"] = std::string(nameOf(shape.kind)) + " " + std::to_string(places_.size());
    node["translation"] = listOf(place());
    turn(node);
    gltf_.addRoot(std::move(node));
  }

  // One mesh of one or two primitives, on one node or on a few.
  void addMeshes() {
    std::vector<std::pair<Json, int>> parts;
    const int count = dice_.oneIn(4) ? 2 : 1;
    for (int i = 0; i < count; ++i) {
      Primitive mesh = anyMesh();
      finish(mesh);
      const Json geometry = gltf_.addGeometry(mesh);
      parts.emplace_back(geometry, look());
    }
    const std::string name = "mesh " + std::to_string(places_.size());
    const int mesh = gltf_.addMesh(name, parts);
    const int nodes = dice_.oneIn(3) ? 3 : 1;
    for (int i = 0; i < nodes; ++i) {
      Json node = meshNode(name, mesh);
      node["translation"] = listOf(place());
      turn(node);
      gltf_.addRoot(std::move(node));
    }
  }

  GltfBuilder& gltf_;
  Dice& dice_;
  RandomMaterials materials_;
  std::vector<int> looks_;
  std::vector<dvec3> places_;
};

void addRandomCamera(GltfBuilder& gltf, Dice& dice, bool orthographic, const std::vector<dvec3>& places) {
  const double turn = dice.between(0.0, 2.0 * std::numbers::pi), height = dice.between(0.2, 3.0);
  dvec3 eye(5.0 * std::sin(turn), height, 5.0 * std::cos(turn));
  // In a body, if that is one: not in its very middle, which no ray of another camera passes through either.
  if (!places.empty() && dice.oneIn(8)) eye = places.front() + dvec3(0.05, 0.1, -0.07);
  const dvec3 target = dice.vector(-0.4, 0.4);
  if (!orthographic) {
    CameraSpec camera{.eye = eye, .target = target, .yFovDegrees = dice.between(30.0, 70.0)};
    if (dice.oneIn(3)) camera.zFar = 30.0;
    addCamera(gltf, camera);
    return;
  }
  const double size = dice.between(1.2, 2.5);
  const int camera =
      gltf.addCamera({{"name", "camera"},
                      {"type", "orthographic"},
                      {"orthographic", {{"xmag", size * 4.0 / 3.0}, {"ymag", size}, {"znear", 0.1}, {"zfar", 30.0}}}});
  gltf.addRoot({{"name", "camera"}, {"camera", camera}, {"matrix", matrixOf(lookAt(eye, target))}});
}

}  // namespace

void buildRandomScene(GltfBuilder& gltf, const std::string& name, std::uint64_t seed, const RandomStyle& style) {
  Dice dice(seed);
  Things things(gltf, dice);
  things.addAll();
  addRandomLights(gltf, dice, style.manyLights);
  addRandomAir(gltf, dice, name);
  addRandomCamera(gltf, dice, style.orthographic, things.places());
}

RandomStyle styleOf(std::uint64_t number) { return randomStyle(number / kScenesOfAStyle); }

std::filesystem::path writeRandomScene(std::uint64_t number, const std::filesystem::path& folder) {
  const std::string name = "random_" + std::to_string(number);
  GltfBuilder gltf(name);
  buildRandomScene(gltf, name, number, styleOf(number));
  gltf.write(folder, name);
  return folder / (name + ".gltf");
}

std::vector<std::string> optionsOf(std::uint64_t number, const std::string& method) {
  return randomOptions(number, styleOf(number), method);
}

}  // namespace crosslight::scenegen

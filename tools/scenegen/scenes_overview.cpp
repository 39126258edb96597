// The scene that the demonstration draws by every method: each kind of surface once, few enough triangles that the
// wireframe is still a drawing.
#include <cmath>
#include <numbers>

#include "scenegen/meshes.h"
#include "scenegen/parts.h"
#include "scenegen/registry.h"
#include "scenegen/teapot.h"

namespace crosslight::scenegen {
namespace {

using glm::dvec3;

void addTeapot(GltfBuilder& gltf, const dvec3& at) {
  const int brass = gltf.addMaterial(presetMaterial("brass"));
  const int mesh = gltf.addMesh("teapot", {{gltf.addGeometry(withoutUv(tessellateTeapot(7))), brass}});
  Json node = meshNode("teapot", mesh, at);
  const double half = -17.0 * std::numbers::pi / 180.0;
  node["rotation"] = {0.0, std::sin(half), 0.0, std::cos(half)};
  node["scale"] = {0.62, 0.62, 0.62};
  gltf.addRoot(std::move(node));
}

// Tilted about x so that its hole shows, resting on the floor with its lowest point.
void addRing(GltfBuilder& gltf, int material, double x, double z) {
  const double radius = 0.62, tube = 0.22, tilt = 62.0 * std::numbers::pi / 180.0;
  Json node = shapeNode(gltf, "torus", {ShapeKind::torus, {radius, tube, 0.0}, 40}, material,
                        {x, radius * std::sin(tilt) + tube, z});
  node["rotation"] = {std::sin(0.5 * tilt), 0.0, 0.0, std::cos(0.5 * tilt)};
  gltf.addRoot(std::move(node));
}

void addBox(GltfBuilder& gltf, int material, double x, double z) {
  const dvec3 size(1.05, 1.5, 1.05);
  Json node = shapeNode(gltf, "box", {ShapeKind::box, size, 16}, material, {x, 0.5 * size.y, z});
  const double half = 0.5 * 28.0 * std::numbers::pi / 180.0;
  node["rotation"] = {0.0, std::sin(half), 0.0, std::cos(half)};
  gltf.addRoot(std::move(node));
}

void overview(GltfBuilder& gltf) {
  const int ivory = gltf.addMaterial(matte("ivory squares", {0.62, 0.60, 0.55}));
  const int slate = gltf.addMaterial(matte("slate squares", {0.12, 0.15, 0.20}));
  addCheckerFloor(gltf, 7.0, 14, ivory, slate);
  addTeapot(gltf, {-0.3, 0.0, 0.0});
  const int mirror = gltf.addMaterial(classicMaterial(
      "mirror", {.ka = dvec3(0.02), .kd = dvec3(0.05), .ks = dvec3(0.7), .shininess = 160.0, .kr = dvec3(0.85)}));
  const int glass = gltf.addMaterial(glassMaterial("glass", {0.97, 1.0, 0.98}, 1.5));
  const int teal = gltf.addMaterial(paint("teal", {0.06, 0.46, 0.47}));
  const int crimson = gltf.addMaterial(paint("crimson", {0.66, 0.09, 0.13}));
  const int amber = gltf.addMaterial(paint("amber", {0.84, 0.47, 0.07}));
  const int violet = gltf.addMaterial(paint("violet", {0.36, 0.23, 0.62}));
  gltf.addRoot(shapeNode(gltf, "mirror sphere", {ShapeKind::sphere, {1.2, 0.0, 0.0}, 32}, mirror, {1.85, 1.2, -2.2}));
  gltf.addRoot(shapeNode(gltf, "glass sphere", {ShapeKind::sphere, {0.75, 0.0, 0.0}, 28}, glass, {1.75, 0.75, 1.6}));
  gltf.addRoot(shapeNode(gltf, "cylinder", {ShapeKind::cylinder, {0.55, 2.1, 0.0}, 28}, violet, {-0.75, 1.05, -3.1}));
  gltf.addRoot(shapeNode(gltf, "cone", {ShapeKind::cone, {0.6, 1.35, 0.0}, 28}, amber, {-2.65, 0.675, 0.6}));
  addRing(gltf, teal, -1.05, 2.5);
  addBox(gltf, crimson, -2.75, -2.0);
  addPointLight(gltf, "key", {-4.5, 8.0, 6.0}, {.color = {1.10, 1.02, 0.88}});
  addPointLight(gltf, "sky", {6.5, 6.0, 4.5}, {.color = {0.34, 0.34, 0.36}});
  addPointLight(gltf, "rim", {2.0, 5.0, -7.0}, {.color = {0.32, 0.19, 0.12}});
  addCamera(gltf, {.eye = {0.7, 4.4, 9.2}, .target = {-0.2, 0.8, 0.0}, .yFovDegrees = 40.0, .zNear = 0.5});
  setAtmosphere(gltf, 0.3, {0.055, 0.085, 0.15});
}

constexpr SceneRow kRows[] = {
    {"showcase/overview", "the demonstration: brass teapot, mirror, glass and painted shapes, three lights", overview},
};

}  // namespace

std::span<const SceneRow> overviewScenes() { return kRows; }

}  // namespace crosslight::scenegen

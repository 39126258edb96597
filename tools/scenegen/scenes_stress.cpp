// What is numerically hard. Most files hold two scenes that must give the same picture: the hard one first, and an easy
// twin that says the same with better numbers.
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/shape_mesh.h"
#include "scenegen/meshes.h"
#include "scenegen/parts.h"
#include "scenegen/registry.h"

namespace crosslight::scenegen {
namespace {

using glm::dmat4;
using glm::dvec3;

Primitive knot() { return withoutUv(torusKnotMesh(0.8, 0.32, 0.16, 120, 14)); }

// A node that only places its children; everything of a scene can hang below it.
int addMeshChild(GltfBuilder& gltf, const char* name, const Primitive& mesh, int material) {
  return gltf.addNode(meshNode(name, gltf.addMesh(name, {{gltf.addGeometry(mesh), material}})));
}

void addView(GltfBuilder& gltf, double scale = 1.0) {
  addPointLight(gltf, "key", scale * dvec3(-3.0, 5.0, 6.0), {.color = dvec3(0.9)});
  addCamera(gltf,
            {.eye = scale * dvec3(0.0, 1.6, 6.0), .target = dvec3(0.0), .yFovDegrees = 34.0, .zNear = 0.1 * scale});
  setAtmosphere(gltf, 0.2, {0.08, 0.10, 0.12});
}

// A knot is not its own mirror image: wrong winding or a wrong sign of the normals shows.
void negativeScale(GltfBuilder& gltf) {
  const int material = gltf.addMaterial(paint("paint", {0.2, 0.5, 0.7}));
  Json node = meshNode("knot", gltf.addMesh("knot", {{gltf.addGeometry(knot()), material}}));
  node["scale"] = {-1.0, 1.0, 1.0};
  gltf.addRoot(std::move(node));
  addView(gltf);
  gltf.beginScene("mirrored in the mesh");
  const Primitive mirrored = transformed(knot(), glm::scale(dmat4(1.0), {-1.0, 1.0, 1.0}));
  gltf.addRoot(meshNode("knot", gltf.addMesh("knot", {{gltf.addGeometry(mirrored), material}})));
  addView(gltf);
}

// Scale (1, 10, 1) as in the textbook example of normals, and below a rotated child: a shear, which no translation,
// rotation and scale of one node can express.
void nonUniformScale(GltfBuilder& gltf) {
  const int material = gltf.addMaterial(paint("paint", {0.7, 0.45, 0.2}));
  const Primitive ball = withoutUv(tessellateShape(ShapeKind::sphere, {0.15f, 0.0f, 0.0f, 0.0f}, 48));
  const Primitive box = withoutUv(tessellateShape(ShapeKind::box, {0.3f, 0.2f, 0.3f, 0.0f}, 16));
  const double half = std::numbers::pi / 8.0;
  Json ballNode = meshNode("ellipsoid", gltf.addMesh("ball", {{gltf.addGeometry(ball), material}}), {-0.9, 0.0, 0.0});
  ballNode["scale"] = {1.0, 10.0, 1.0};
  gltf.addRoot(std::move(ballNode));
  Json child = meshNode("sheared box", gltf.addMesh("box", {{gltf.addGeometry(box), material}}));
  child["rotation"] = {0.0, 0.0, std::sin(half), std::cos(half)};
  gltf.addRoot({{"name", "stretch"},
                {"translation", {0.9, 0.0, 0.0}},
                {"scale", {1.0, 10.0, 1.0}},
                {"children", {gltf.addNode(std::move(child))}}});
  addView(gltf);
  gltf.beginScene("scaled in the mesh");
  const dmat4 stretch = glm::scale(dmat4(1.0), {1.0, 10.0, 1.0});
  const dmat4 shear = stretch * glm::rotate(dmat4(1.0), 2.0 * half, dvec3(0.0, 0.0, 1.0));
  const Primitive longBall = transformed(ball, stretch), sheared = transformed(box, shear);
  gltf.addRoot(meshNode("ellipsoid", gltf.addMesh("ball", {{gltf.addGeometry(longBall), material}}), {-0.9, 0.0, 0.0}));
  gltf.addRoot(meshNode("sheared box", gltf.addMesh("box", {{gltf.addGeometry(sheared), material}}), {0.9, 0.0, 0.0}));
  addView(gltf);
}

// A small still life below one node; `place` moves it with its light and its camera.
void addStillLife(GltfBuilder& gltf, const dvec3& place) {
  const int blue = gltf.addMaterial(paint("blue", {0.2, 0.4, 0.7}));
  const int gray = gltf.addMaterial(matte("gray", dvec3(0.5)));
  const Primitive floor = withoutUv(gridMesh({0.0, -1.0, 0.0}, {2.5, 0.0, 0.0}, {0.0, 0.0, -2.5}, 16));
  Json ball = shapeNode(gltf, "ball", {.params = {0.45, 0.0, 0.0}}, blue, {1.3, -0.55, 0.8});
  Json children = {addMeshChild(gltf, "knot", knot(), blue), addMeshChild(gltf, "floor", floor, gray),
                   gltf.addNode(std::move(ball))};
  gltf.addRoot({{"name", "everything"}, {"translation", listOf(place)}, {"children", children}});
  addPointLight(gltf, "key", place + dvec3(-3.0, 5.0, 6.0), {.color = dvec3(0.9)});
  addCamera(gltf, {.eye = place + dvec3(0.0, 2.0, 7.0), .target = place - dvec3(0.0, 0.2, 0.0), .yFovDegrees = 34.0});
  setAtmosphere(gltf, 0.2, {0.08, 0.10, 0.12});
}

void farFromOrigin(GltfBuilder& gltf) {
  addStillLife(gltf, dvec3(1e7));
  gltf.beginScene("near the origin");
  addStillLife(gltf, dvec3(0.0));
}

// Everything in millionths: lengths, the camera's near plane, the light's distance.
void tinyUnits(GltfBuilder& gltf) {
  const int material = gltf.addMaterial(paint("paint", {0.5, 0.6, 0.2}));
  const double tiny = 1e-6;
  const Primitive small = transformed(knot(), glm::scale(dmat4(1.0), dvec3(tiny)));
  gltf.addRoot(meshNode("knot", gltf.addMesh("knot", {{gltf.addGeometry(small), material}})));
  addView(gltf, tiny);
  gltf.beginScene("in units of one");
  gltf.addRoot(meshNode("knot", gltf.addMesh("knot", {{gltf.addGeometry(knot()), material}})));
  addView(gltf);
}

// A disk as a fan of 1440 slivers about a vertex off its center: every pixel near that vertex belongs to many.
Primitive fanMesh() {
  Primitive mesh;
  constexpr std::uint32_t kSlivers = 1440;
  const auto add = [&](double x, double y) {
    mesh.positions.emplace_back(x, y, 0.0);
    mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
  };
  add(0.1234567, -0.0712345);
  for (std::uint32_t i = 0; i < kSlivers; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSlivers;
    add(std::cos(angle), std::sin(angle));
    mesh.indices.insert(mesh.indices.end(), {0u, 1u + i, 1u + (i + 1u) % kSlivers});
  }
  return mesh;
}

// A square of strips, each `ratio` times as high as the one before: from a tenth of the height down to 1e-7 of it.
Primitive stripsMesh() {
  Primitive mesh;
  double y = -1.0;
  const auto addRow = [&] {
    for (const double x : {-1.0, 1.0}) {
      mesh.positions.emplace_back(x, y, 0.0);
      mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
    }
  };
  addRow();
  for (double height = 0.5; height > 2e-7; height *= 0.75) {
    y += height;
    addRow();
  }
  y = 1.0;
  addRow();
  for (std::uint32_t a = 0; a + 3 < mesh.positions.size(); a += 2) {
    mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + 3, a, a + 3, a + 2});
  }
  return mesh;
}

// Front faces must close without a gap over the red wall behind them: any red pixel inside is a leak.
void thinTriangles(GltfBuilder& gltf) {
  const int white = gltf.addMaterial(matte("white", dvec3(0.7)));
  const int red = gltf.addMaterial(matte("red: a leak", {0.9, 0.05, 0.05}));
  gltf.addRoot(meshNode("fan", gltf.addMesh("fan", {{gltf.addGeometry(fanMesh()), white}}), {-1.2, 0.0, 0.0}));
  gltf.addRoot(meshNode("strips", gltf.addMesh("strips", {{gltf.addGeometry(stripsMesh()), white}}), {1.2, 0.0, 0.0}));
  const Primitive back = withoutUv(gridMesh({0.0, 0.0, -0.25}, {2.4, 0.0, 0.0}, {0.0, 1.4, 0.0}, 1));
  gltf.addRoot(meshNode("wall", gltf.addMesh("wall", {{gltf.addGeometry(back), red}})));
  addDirectionalLight(gltf, "sun", {0.2, -0.4, -1.0}, {.color = dvec3(0.9)});
  addCamera(gltf, {.eye = {0.0, 0.0, 6.0}, .target = dvec3(0.0), .yFovDegrees = 42.0});
  setAtmosphere(gltf, 0.2, dvec3(0.0));
}

constexpr SceneRow kRows[] = {
    {"stress/negative_scale", "a chiral knot mirrored by its node; second scene: in the mesh", negativeScale},
    {"stress/non_uniform_scale", "scale (1,10,1) and a shear; second scene: in the mesh", nonUniformScale},
    {"stress/far_from_origin", "everything at (1e7,1e7,1e7); second scene: at the origin", farFromOrigin},
    {"stress/tiny_units", "everything in millionths of a unit; second scene: in units", tinyUnits},
    {"stress/thin_triangles", "slivers before a red wall: a red pixel inside is a leak", thinTriangles},
};

}  // namespace

std::span<const SceneRow> stressScenes() { return kRows; }

}  // namespace crosslight::scenegen

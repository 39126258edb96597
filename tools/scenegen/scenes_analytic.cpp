// Scenes with a value derived on paper.
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/shape_mesh.h"
#include "scenegen/meshes.h"
#include "scenegen/parts.h"
#include "scenegen/registry.h"

namespace crosslight::scenegen {
namespace {

using glm::dvec3;

constexpr double kSphereRadius = 2.0;

// The lecture's exercise: P = (0,2,0), N = V = (0,1,0), N.L = sqrt(1/2) for both lights. With ka = kd = 0.5, ks = 0.6,
// n = 10, Ia = 0.1 red and blue are 0.05 + sqrt(2)/4 + 0.6 c and green is 0.05, where c = (V.R)^10 = 1/32 for `phong`
// and (N.H)^10 = (58 + 41 sqrt(2)) / 256 for `blinnPhong`: 0.422303390593274 and 0.675387975102563.
int exerciseMaterial(GltfBuilder& gltf, const char* model) {
  return gltf.addMaterial(classicMaterial(
      "exercise", {.model = model, .ka = dvec3(0.5), .kd = dvec3(0.5), .ks = dvec3(0.6), .shininess = 10.0}));
}

// The camera looks along -Y with -Z up, so that +X is to the right: the red light is on the left.
void addExerciseView(GltfBuilder& gltf) {
  addPointLight(gltf, "red", {-10.0, 12.0, 0.0}, {.color = {1.0, 0.0, 0.0}});
  addPointLight(gltf, "blue", {10.0, 12.0, 0.0}, {.color = {0.0, 0.0, 1.0}});
  addCamera(gltf, {.eye = {0.0, 20.0, 0.0},
                   .target = {0.0, 2.0, 0.0},
                   .up = {0.0, 0.0, -1.0},
                   .yFovDegrees = 15.0,
                   .zNear = 1.0,
                   .zFar = 100.0});
  setAtmosphere(gltf, 0.1, dvec3(0.0));
}

// Turned so that P lies on the centroid of a triangle near the equator and never on a vertex or an edge, where its
// value would be exact or undecided: there the tessellation's error is its own and shrinks with the square of the step.
Primitive exerciseMesh(int segments) {
  const Primitive mesh = tessellateShape(ShapeKind::sphere, {float(kSphereRadius), 0.0f, 0.0f, 0.0f}, segments);
  const std::size_t triangle = mesh.indices.size() / 6;
  dvec3 centroid(0.0);
  for (std::size_t k = 0; k < 3; ++k) centroid += dvec3(mesh.positions[mesh.indices[3 * triangle + k]]) / 3.0;
  const dvec3 up = glm::normalize(centroid);
  const dvec3 right = glm::normalize(glm::cross(dvec3(0.0, 1.0, 0.0), up));
  const glm::dmat3 upright = glm::transpose(glm::dmat3(right, up, glm::cross(right, up)));
  return withoutUv(transformed(mesh, glm::dmat4(upright)));
}

void exerciseAnalytic(GltfBuilder& gltf, const char* model) {
  const int material = exerciseMaterial(gltf, model);
  const int mesh = gltf.addMesh("sphere", {{gltf.addGeometry(exerciseMesh(64)), material}});
  Json node = meshNode("sphere", mesh);
  node["extensions"]["CROSSLIGHT_node_shape"] = shapeExtension({.params = dvec3(kSphereRadius, 0.0, 0.0)}, material);
  gltf.addRoot(std::move(node));
  addExerciseView(gltf);
}

template <int segments>
void exerciseTessellated(GltfBuilder& gltf) {
  const int material = exerciseMaterial(gltf, "phong");
  gltf.addRoot(meshNode("sphere", gltf.addMesh("sphere", {{gltf.addGeometry(exerciseMesh(segments)), material}})));
  addExerciseView(gltf);
}

// With a directional light, an infinite viewer and one normal the lighting is one constant: the lecture's three
// conditions under which flat shading is exact. The plane fills the frame.
void planeDirectional(GltfBuilder& gltf) {
  const int material = gltf.addMaterial(classicMaterial(
      "plane", {.model = "phong", .ka = dvec3(0.2), .kd = dvec3(0.6, 0.5, 0.3), .ks = dvec3(0.4), .shininess = 12.0}));
  const Primitive grid = gridMesh(dvec3(0.0), {10.0, 0.0, 0.0}, {0.0, 0.0, -10.0}, 8);
  gltf.addRoot(meshNode("floor", gltf.addMesh("floor", {{gltf.addGeometry(grid), material}})));
  addDirectionalLight(gltf, "sun", {-1.0, -2.0, -0.5}, {});
  addCamera(gltf, {.eye = {0.0, 7.0, 7.0}, .target = dvec3(0.0), .yFovDegrees = 35.0, .zFar = 100.0});
  setAtmosphere(gltf, 0.1, dvec3(0.0));
}

constexpr SceneRow kRows[] = {
    {"analytic/exercise_phong", "the lecture's sphere: 0.422303390593274, 0.05, 0.422303390593274 at (0,2,0)",
     [](GltfBuilder& gltf) { exerciseAnalytic(gltf, "phong"); }},
    {"analytic/exercise_blinn_phong", "the same by (N.H)^n: 0.675387975102563, 0.05, 0.675387975102563",
     [](GltfBuilder& gltf) { exerciseAnalytic(gltf, "blinnPhong"); }},
    {"analytic/exercise_phong_16", "the same sphere as triangles, 16 around; P on a triangle's centroid",
     exerciseTessellated<16>},
    {"analytic/exercise_phong_64", "64 around: the error falls with the square of the step", exerciseTessellated<64>},
    {"analytic/exercise_phong_256", "256 around, the finest", exerciseTessellated<256>},
    {"analytic/plane_directional", "flat = Gouraud = Phong = Whitted with an infinite viewer", planeDirectional},
};

}  // namespace

std::span<const SceneRow> analyticScenes() { return kRows; }

}  // namespace crosslight::scenegen

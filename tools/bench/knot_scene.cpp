#include "bench/knot_scene.h"

#include <cmath>

#include "scenegen/meshes.h"
#include "scenegen/parts.h"

namespace crosslight::bench {
namespace {

constexpr double kKnotShare = 0.98;
constexpr double kLengthToGirth = 8.0;  // quads along the tube per quad around it: nearly square ones

int rounded(double value) { return std::max(3, static_cast<int>(std::lround(value))); }

}  // namespace

std::filesystem::path writeKnotScene(const std::filesystem::path& folder, std::uint32_t triangles) {
  using namespace scenegen;
  const double knotQuads = kKnotShare * triangles / 2.0, planeQuads = (1.0 - kKnotShare) * triangles / 2.0;
  const int around = rounded(std::sqrt(knotQuads / kLengthToGirth));
  const int along = rounded(knotQuads / around);
  GltfBuilder gltf("knot");
  // Highlights and all stay below 1: a peer with 8 bits per channel draws the same picture.
  const int paint = gltf.addMaterial(classicMaterial("paint", {.model = "blinnPhong",
                                                               .ka = glm::dvec3(0.5),
                                                               .kd = glm::dvec3(0.5, 0.45, 0.4),
                                                               .ks = glm::dvec3(0.3),
                                                               .shininess = 20.0}));
  const Primitive knot = withoutUv(torusKnotMesh(2.0, 0.8, 0.45, along, around));
  const Primitive plane =
      withoutUv(gridMesh({0.0, -1.5, 0.0}, {6.0, 0.0, 0.0}, {0.0, 0.0, -6.0}, rounded(std::sqrt(planeQuads))));
  const int mesh = gltf.addMesh("knot", {{gltf.addGeometry(knot), paint}, {gltf.addGeometry(plane), paint}});
  gltf.addRoot(meshNode("knot", mesh));
  addPointLight(gltf, "lamp", {-4.0, 7.0, 5.0}, {.color = glm::dvec3(0.8)});
  addCamera(gltf, {.eye = {0.0, 5.0, 7.5}, .target = {0.0, -0.3, 0.4}, .yFovDegrees = 44.0, .zNear = 0.1});
  setAtmosphere(gltf, 0.2, glm::dvec3(0.0));
  const std::string name = "knot_" + shortCount(triangles);
  gltf.write(folder, name);
  return folder / (name + ".gltf");
}

std::string shortCount(std::uint32_t count) {
  if (count % 1'000'000 == 0) return std::to_string(count / 1'000'000) + "M";
  return count % 1000 == 0 ? std::to_string(count / 1000) + "k" : std::to_string(count);
}

RenderSettings knotSettings(Method method, std::uint32_t width, std::uint32_t height) {
  RenderSettings s;
  s.method = method;
  s.width = width;
  s.height = height;
  s.maxDepth = 0;
  s.twoSided = TwoSided::always;
  return s;
}

}  // namespace crosslight::bench

// The pictures that every book on rendering has.
#include <array>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "scenegen/meshes.h"
#include "scenegen/parts.h"
#include "scenegen/registry.h"
#include "scenegen/teapot.h"

namespace crosslight::scenegen {
namespace {

using glm::dvec3;

Json rotatedAboutY(Json node, double degrees) {
  const double half = degrees * std::numbers::pi / 360.0;
  node["rotation"] = {0.0, std::sin(half), 0.0, std::cos(half)};
  return node;
}

void addFloor(GltfBuilder& gltf, const dvec3& center, double halfX, double halfZ, int material) {
  const Primitive grid = withoutUv(gridMesh(center, {halfX, 0.0, 0.0}, {0.0, 0.0, -halfZ}, 24));
  gltf.addRoot(meshNode("floor", gltf.addMesh("floor", {{gltf.addGeometry(grid), material}})));
}

void teapot(GltfBuilder& gltf) {
  const int metal = gltf.addMaterial(presetMaterial("polishedBronze"));
  const Json pot = gltf.addGeometry(tessellateTeapot(18));
  gltf.addRoot(rotatedAboutY(meshNode("teapot", gltf.addMesh("teapot", {{pot, metal}})), -25.0));
  addFloor(gltf, {0.0, 0.0, 0.0}, 9.0, 9.0, gltf.addMaterial(matte("floor", {0.42, 0.41, 0.40})));
  addPointLight(gltf, "key", {-6.0, 10.0, 8.0}, {.color = dvec3(0.9, 0.87, 0.82)});
  addPointLight(gltf, "fill", {9.0, 6.0, 4.0}, {.color = dvec3(0.25, 0.3, 0.4)});
  addCamera(gltf, {.eye = {0.5, 5.0, 11.0}, .target = {0.1, 1.35, 0.0}, .yFovDegrees = 40.0, .zNear = 0.5});
  setAtmosphere(gltf, 0.25, {0.10, 0.12, 0.15});
}

void teapots(GltfBuilder& gltf) {
  const Json pot = gltf.addGeometry(withoutUv(tessellateTeapot(8)));
  const char* presets[2][4] = {{"brass", "bronze", "copper", "gold"},
                               {"chrome", "polishedBronze", "polishedCopper", "polishedGold"}};
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 4; ++column) {
      const std::string preset = presets[row][column];
      const int mesh = gltf.addMesh(preset, {{pot, gltf.addMaterial(presetMaterial(preset))}});
      const dvec3 at((column - 1.5) * 5.2 - 0.3, 0.0, row == 0 ? -5.0 : 4.0);
      gltf.addRoot(rotatedAboutY(meshNode(preset, mesh, at), -40.0));
    }
  }
  addFloor(gltf, dvec3(0.0), 34.0, 34.0, gltf.addMaterial(matte("floor", {0.30, 0.30, 0.31})));
  addPointLight(gltf, "key", {-12.0, 20.0, 22.0}, {.color = dvec3(1.25, 1.2, 1.1)});
  addPointLight(gltf, "fill", {18.0, 10.0, 16.0}, {.color = dvec3(0.45)});
  addCamera(gltf, {.eye = {0.0, 27.0, 29.0}, .target = {0.0, 0.8, -0.1}, .yFovDegrees = 38.0, .zNear = 1.0});
  setAtmosphere(gltf, 0.35, {0.08, 0.09, 0.11});
}

void spheresChecker(GltfBuilder& gltf) {
  const int light = gltf.addMaterial(matte("light squares", {0.82, 0.80, 0.74}));
  const int dark = gltf.addMaterial(matte("dark squares", {0.13, 0.16, 0.20}));
  addCheckerFloor(gltf, 8.0, 16, light, dark);
  const int mirror = gltf.addMaterial(classicMaterial(
      "mirror", {.ka = dvec3(0.02), .kd = dvec3(0.04), .ks = dvec3(0.6), .shininess = 200.0, .kr = dvec3(0.85)}));
  const int glass = gltf.addMaterial(glassMaterial("glass", dvec3(1.0), 1.5));
  const int red = gltf.addMaterial(paint("red", {0.75, 0.12, 0.10}));
  const int green = gltf.addMaterial(paint("green", {0.14, 0.52, 0.20}));
  const int blue = gltf.addMaterial(paint("blue", {0.12, 0.22, 0.70}));
  const int yellow = gltf.addMaterial(paint("yellow", {0.85, 0.62, 0.10}));
  const auto ball = [&](const char* name, int material, double radius, double x, double z) {
    gltf.addRoot(shapeNode(gltf, name, {.params = {radius, 0.0, 0.0}, .segments = 40}, material, {x, radius, z}));
  };
  ball("mirror", mirror, 1.4, -0.9, -1.8);
  ball("glass", glass, 1.0, 1.35, 1.0);
  ball("red", red, 0.8, -2.35, 0.9);
  ball("green", green, 0.6, 2.9, -1.7);
  ball("blue", blue, 0.7, 1.6, -3.4);
  ball("yellow", yellow, 0.45, -0.8, 1.9);
  addPointLight(gltf, "key", {-5.0, 9.0, 6.0}, {.color = dvec3(0.8, 0.78, 0.74)});
  addPointLight(gltf, "fill", {7.0, 6.0, 3.0}, {.color = dvec3(0.25, 0.28, 0.35)});
  addCamera(gltf, {.eye = {0.6, 3.6, 9.0}, .target = {0.0, 0.75, -0.4}, .yFovDegrees = 46.0, .zNear = 0.5});
  setAtmosphere(gltf, 0.2, {0.28, 0.42, 0.60});
}

using Quad = std::array<dvec3, 4>;

// The box that Cornell University measured (Program of Computer Graphics, "Cornell Box Data"; millimeters). Seen from
// -z the red wall is on the left, in glTF's right-handed space too: +x points left there.
constexpr double kTop = 548.8, kBack = 559.2;

Quad upright(const dvec3& a, const dvec3& b, double height) {
  return {a, b, dvec3(b.x, height, b.z), dvec3(a.x, height, a.z)};
}

Primitive cornellBlock(const Quad& top) {
  std::vector<Quad> faces = {top};
  dvec3 center(0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    const dvec3 a = top[i], b = top[(i + 1) % 4];
    faces.push_back({a, b, dvec3(b.x, 0.0, b.z), dvec3(a.x, 0.0, a.z)});
    center += 0.25 * dvec3(a.x, 0.5 * a.y, a.z);
  }
  Primitive mesh;
  for (const Quad& face : faces) {  // each face looks away from the middle
    const dvec3 middle = 0.25 * (face[0] + face[1] + face[2] + face[3]);
    mesh = joined(mesh, quadMesh(std::vector<Quad>{face}, 2.0 * middle - center));
  }
  return mesh;
}

// The ceiling as a 3 x 3 grid without its middle: every corner of the opening is a vertex of all its neighbors.
std::vector<Quad> ceilingAround() {
  const double xs[4] = {0.0, 213.0, 343.0, 556.0}, zs[4] = {0.0, 227.0, 332.0, kBack};
  std::vector<Quad> quads;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      if (i == 1 && j == 1) continue;
      quads.push_back({dvec3(xs[i], kTop, zs[j]), dvec3(xs[i + 1], kTop, zs[j]), dvec3(xs[i + 1], kTop, zs[j + 1]),
                       dvec3(xs[i], kTop, zs[j + 1])});
    }
  }
  return quads;
}

void cornell(GltfBuilder& gltf) {
  const dvec3 inside(278.0, 273.0, 280.0);
  const auto add = [&](const char* name, const Primitive& mesh, int material) {
    gltf.addRoot(meshNode(name, gltf.addMesh(name, {{gltf.addGeometry(withoutUv(mesh)), material}})));
  };
  const int white = gltf.addMaterial(pbrMaterial("white", {0.74, 0.74, 0.74}, 0.0, 1.0));
  const int red = gltf.addMaterial(pbrMaterial("red", {0.63, 0.06, 0.05}, 0.0, 1.0));
  const int green = gltf.addMaterial(pbrMaterial("green", {0.14, 0.45, 0.09}, 0.0, 1.0));
  Json lamp = pbrMaterial("lamp", dvec3(0.78), 0.0, 1.0);
  lamp["emissiveFactor"] = {1.0, 0.8, 0.5};
  lamp["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 12.0;
  const Quad floor = {dvec3(552.8, 0.0, 0.0), dvec3(0.0), dvec3(0.0, 0.0, kBack), dvec3(549.6, 0.0, kBack)};
  add("floor", quadMesh(std::vector<Quad>{floor}, inside), white);
  add("ceiling", quadMesh(ceilingAround(), inside), white);
  const Quad back = {floor[3], floor[2], dvec3(0.0, kTop, kBack), dvec3(556.0, kTop, kBack)};
  add("back wall", quadMesh(std::vector<Quad>{back}, inside), white);
  const Quad left = {floor[0], floor[3], dvec3(556.0, kTop, kBack), dvec3(556.0, kTop, 0.0)};
  add("left wall", quadMesh(std::vector<Quad>{left}, inside), red);
  add("right wall", quadMesh(std::vector<Quad>{upright(floor[2], floor[1], kTop)}, inside), green);
  const Quad light = {dvec3(213.0, kTop, 227.0), dvec3(343.0, kTop, 227.0), dvec3(343.0, kTop, 332.0),
                      dvec3(213.0, kTop, 332.0)};
  add("lamp", quadMesh(std::vector<Quad>{light}, inside), gltf.addMaterial(lamp));
  add("short block",
      cornellBlock({dvec3(130.0, 165.0, 65.0), dvec3(82.0, 165.0, 225.0), dvec3(240.0, 165.0, 272.0),
                    dvec3(290.0, 165.0, 114.0)}),
      white);
  add("tall block",
      cornellBlock({dvec3(423.0, 330.0, 247.0), dvec3(265.0, 330.0, 296.0), dvec3(314.0, 330.0, 456.0),
                    dvec3(472.0, 330.0, 406.0)}),
      white);
  const int bulb = gltf.addLight(khrLight("bulb", "point", {1.0, 0.86, 0.66}, 400000.0));
  Json node = {{"name", "bulb"}, {"translation", {278.0, 490.0, 240.0}}};
  node["extensions"]["KHR_lights_punctual"]["light"] = bulb;
  gltf.addRoot(std::move(node));
  addCamera(gltf, {.eye = {278.0, 273.0, -800.0},
                   .target = {278.0, 273.0, 0.0},
                   .yFovDegrees = 39.3,
                   .zNear = 10.0,
                   .zFar = 5000.0});
  setAtmosphere(gltf, 0.12, dvec3(0.0));
}

// Three lights around the line of sight. White where all reach, yellow, cyan and magenta where one is turned away or,
// in ray traced shadows on the wall, hidden.
void threeLights(GltfBuilder& gltf) {
  const int white = gltf.addMaterial(paint("white", dvec3(0.85), 0.25, 40.0));
  const int wall = gltf.addMaterial(matte("wall", dvec3(0.8)));
  gltf.addRoot(shapeNode(gltf, "sphere", {.params = {1.0, 0.0, 0.0}, .segments = 64}, white, {-1.35, 0.0, 0.0}));
  const Primitive knot = withoutUv(torusKnotMesh(0.75, 0.3, 0.15, 160, 16));
  Json node = meshNode("torus knot", gltf.addMesh("torus knot", {{gltf.addGeometry(knot), white}}), {1.35, 0.0, 0.0});
  const double half = 0.25 * std::numbers::pi;
  node["rotation"] = {std::sin(half), 0.0, 0.0, std::cos(half)};  // 90 degrees about x: its axis to the viewer
  gltf.addRoot(std::move(node));
  const Primitive back = withoutUv(gridMesh({0.0, 0.0, -2.0}, {5.0, 0.0, 0.0}, {0.0, 3.5, 0.0}, 32));
  gltf.addRoot(meshNode("wall", gltf.addMesh("wall", {{gltf.addGeometry(back), wall}})));
  const char* names[3] = {"red", "green", "blue"};
  for (int i = 0; i < 3; ++i) {
    const double angle = std::numbers::pi * (0.5 + 2.0 * i / 3.0);
    dvec3 color(0.0);
    color[i] = 0.8;
    addPointLight(gltf, names[i], {6.0 * std::cos(angle), 6.0 * std::sin(angle), 7.0}, {.color = color});
  }
  addCamera(gltf, {.eye = {0.0, 0.0, 9.0}, .target = dvec3(0.0), .yFovDegrees = 35.0, .zNear = 0.5});
  setAtmosphere(gltf, 0.03, dvec3(0.0));
}

void polyhedra(GltfBuilder& gltf) {
  const dvec3 colors[5] = {
      {0.80, 0.22, 0.18}, {0.85, 0.60, 0.14}, {0.25, 0.60, 0.28}, {0.18, 0.42, 0.75}, {0.52, 0.28, 0.66}};
  const auto solids = platonicSolids();
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const int material = gltf.addMaterial(paint(solids[i].name, colors[i], 0.2, 20.0));
    const int mesh = gltf.addMesh(solids[i].name, {{gltf.addGeometry(polyhedronMesh(solids[i])), material}});
    const double back = i % 2 == 1 ? 1.0 : 0.0;  // three before, two behind them
    gltf.addRoot(
        rotatedAboutY(meshNode(solids[i].name, mesh, {(static_cast<double>(i) - 2.0) * 1.3, 1.0, 1.2 - 2.8 * back}),
                      17.0 * static_cast<double>(i)));
  }
  addFloor(gltf, dvec3(0.0), 5.0, 5.0, gltf.addMaterial(matte("floor", {0.45, 0.44, 0.43})));
  addPointLight(gltf, "key", {-4.0, 7.0, 7.0}, {.color = dvec3(0.9)});
  addPointLight(gltf, "fill", {8.0, 4.0, 3.0}, {.color = dvec3(0.25)});
  addCamera(gltf, {.eye = {0.0, 6.5, 10.5}, .target = {0.0, 0.7, 0.1}, .yFovDegrees = 39.5, .zNear = 0.5});
  setAtmosphere(gltf, 0.2, {0.10, 0.11, 0.13});
}

constexpr SceneRow kRows[] = {
    {"showcase/teapot", "one Utah teapot of 20 thousand triangles", teapot},
    {"showcase/teapots", "eight teapots, one mesh: the metals of the classic material table", teapots},
    {"showcase/spheres_checker", "mirror, glass and painted spheres over a checkered floor", spheresChecker},
    {"showcase/cornell", "the Cornell box as measured; a bulb and a glowing lamp", cornell},
    {"showcase/three_lights", "red, green and blue light that add up, and colored shadows", threeLights},
    {"showcase/polyhedra", "Platonic solids without normals: glTF's rule of flat shading", polyhedra},
};

}  // namespace

std::span<const SceneRow> showcaseScenes() { return kRows; }

}  // namespace crosslight::scenegen

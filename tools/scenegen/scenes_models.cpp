// The smallest scene for each further illumination model, and the table of presets.
#include "scene/shape_mesh.h"
#include "scenegen/material_stage.h"
#include "scenegen/meshes.h"
#include "scenegen/parts.h"
#include "scenegen/registry.h"

namespace crosslight::scenegen {
namespace {

using glm::dvec3;

Json classicWith(const std::string& name, const ClassicSpec& spec, const char* key, const Json& value) {
  Json material = classicMaterial(name, spec);
  material["extensions"]["CROSSLIGHT_materials_classic"][key] = value;
  return material;
}

void modifiedPhong(GltfBuilder& gltf) {
  const auto ball = [](double n, double ks) {
    return classicMaterial(
        "modified Phong",
        {.model = "modifiedPhong", .ka = {0.2, 0.36, 0.7}, .kd = {0.2, 0.36, 0.6}, .ks = dvec3(ks), .shininess = n});
  };
  addBalls(gltf, ball(8.0, 0.3), ball(80.0, 0.1));
  addClassicStage(gltf);
}

void orenNayar(GltfBuilder& gltf) {
  const ClassicSpec clay = {.model = "orenNayar", .ka = {0.70, 0.36, 0.20}, .kd = {0.70, 0.36, 0.20}};
  addBalls(gltf, classicWith("smooth clay", clay, "roughness", 0.1), classicWith("rough clay", clay, "roughness", 0.7));
  addClassicStage(gltf);
}

// n + ik of copper at 650, 550 and 450 nm (Johnson, Christy 1972), to two digits; a plastic by its F0 alone.
void cookTorrance1982(GltfBuilder& gltf) {
  Json copper =
      classicWith("copper", {.model = "cookTorrance1982", .ka = {0.05, 0.03, 0.02}, .kd = dvec3(0.0), .ks = dvec3(0.3)},
                  "roughness", 0.4);
  Json& classic = copper["extensions"]["CROSSLIGHT_materials_classic"];
  classic["refractiveIndex"] = {0.21, 1.02, 1.17};
  classic["extinction"] = {3.67, 2.59, 2.40};
  const ClassicSpec plastic = {
      .model = "cookTorrance1982", .ka = {0.1, 0.3, 0.15}, .kd = {0.1, 0.3, 0.15}, .ks = dvec3(0.04)};
  addBalls(gltf, std::move(copper), classicWith("plastic", plastic, "roughness", 0.2));
  addClassicStage(gltf);
}

void angularSpecular(GltfBuilder& gltf) {
  const ClassicSpec lacquer = {
      .model = "phong", .ka = {0.5, 0.1, 0.08}, .kd = {0.5, 0.1, 0.08}, .ks = dvec3(0.1), .shininess = 20.0};
  addBalls(gltf, classicWith("constant", lacquer, "specularCoefficient", "constant"),
           classicWith("angular", lacquer, "specularCoefficient", "angular"));
  addClassicStage(gltf);
}

// All presets, a family a row: metals, their polished kinds and pewter, stones, plastics, rubbers. Lit as the table is
// usually shown: a white directional light from above and before, a fifth of it all around.
constexpr const char* kTable[5][6] = {
    {"brass", "bronze", "chrome", "copper", "gold", "silver"},
    {"polishedBronze", "polishedCopper", "polishedGold", "polishedSilver", "pewter", nullptr},
    {"emerald", "jade", "obsidian", "pearl", "ruby", "turquoise"},
    {"blackPlastic", "cyanPlastic", "greenPlastic", "redPlastic", "whitePlastic", "yellowPlastic"},
    {"blackRubber", "cyanRubber", "greenRubber", "redRubber", "whiteRubber", "yellowRubber"}};

void materialTable(GltfBuilder& gltf) {
  const Json ball = gltf.addGeometry(tessellateShape(ShapeKind::sphere, {0.42f, 0.0f, 0.0f, 0.0f}, kBallSegments, 1.0));
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 6; ++column) {
      const char* name = kTable[row][column];
      if (name == nullptr) continue;
      const int material = gltf.addMaterial(presetMaterial(name));
      Json node = meshNode(name, gltf.addMesh(name, {{ball, material}}), {column - 2.5, 2.0 - row, 0.0});
      node["extensions"]["CROSSLIGHT_node_shape"] = shapeExtension({.params = {0.42, 0.0, 0.0}}, material);
      gltf.addRoot(std::move(node));
    }
  }
  addDirectionalLight(gltf, "key", {0.0, -1.0, -1.0}, {.color = dvec3(1.0)});
  addCamera(gltf, {.eye = {0.0, 0.0, 12.0}, .target = dvec3(0.0), .yFovDegrees = 30.0});
  setAtmosphere(gltf, 0.2, dvec3(0.2));
}

constexpr SceneRow kRows[] = {
    {"feature/modifiedPhong", "illumination model modifiedPhong, exponents 8 and 80", modifiedPhong},
    {"feature/orenNayar", "illumination model orenNayar, sigma 0.1 and 0.7", orenNayar},
    {"feature/cookTorrance1982", "illumination model cookTorrance1982: copper by n + ik, plastic by F0",
     cookTorrance1982},
    {"feature/angular_specular", "W(theta): the same highlight with a constant and with an angular coefficient",
     angularSpecular},
    {"showcase/material_table", "the classic material table, all of it, as spheres", materialTable},
};

}  // namespace

std::span<const SceneRow> modelScenes() { return kRows; }

}  // namespace crosslight::scenegen

#include "scenegen/parts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/check.h"
#include "scene/material_table.h"
#include "scene/shape_mesh.h"
#include "scenegen/meshes.h"

namespace crosslight::scenegen {
namespace {

using glm::dvec3;
constexpr double kPi = std::numbers::pi;

// Three digits are plenty for a value that only stands in for another.
double rounded(double value) { return std::round(value * 1000.0) / 1000.0; }

// Equal sharpness of the highlight: n = 2 / alpha^2 - 2 (Walter et al. 2007, "Microfacet Models for Refraction through
// Rough Surfaces", section 5.2), alpha = perceptualRoughness^2.
double perceptualRoughnessOf(double shininess) { return rounded(std::sqrt(std::sqrt(2.0 / (shininess + 2.0)))); }

Json fallback(dvec3 color, double metallic, double shininess) {
  for (int i = 0; i < 3; ++i) color[i] = rounded(std::clamp(color[i], 0.0, 1.0));
  return {{"baseColorFactor", {color.x, color.y, color.z, 1.0}},
          {"metallicFactor", metallic},
          {"roughnessFactor", perceptualRoughnessOf(shininess)}};
}

// The classic light's unitless intensity at a distance d, in candela: times d^2, and pi for the BRDF's 1/pi.
Json lightWithClassic(const std::string& name, const char* type, const ClassicLightSpec& spec, double distance) {
  const double strongest = std::max({spec.color.x, spec.color.y, spec.color.z});
  CL_CHECK_LT(0.0, strongest);
  Json light = khrLight(name, type, spec.color / strongest, std::round(strongest * kPi * distance * distance));
  Json classic = {{"ambient", {0.0, 0.0, 0.0}}, {"diffuse", listOf(spec.color)}, {"specular", listOf(spec.color)}};
  classic["attenuation"] = listOf(spec.attenuation);
  if (spec.spotCutoff) {
    classic["spotCutoff"] = *spec.spotCutoff;
    classic["spotExponent"] = spec.spotExponent;
    light["spot"] = {{"innerConeAngle", 0.0}, {"outerConeAngle", rounded(*spec.spotCutoff * kPi / 180.0)}};
  }
  light["extensions"]["CROSSLIGHT_lights_classic"] = std::move(classic);
  return light;
}

Json lightNode(const std::string& name, int light) {
  return {{"name", name}, {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}};
}

}  // namespace

Json listOf(const dvec3& v) { return {v.x, v.y, v.z}; }

Json matrixOf(const glm::dmat4& matrix) {
  Json list = Json::array();
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) list.push_back(matrix[column][row] + 0.0);
  }
  return list;
}

glm::dmat4 lookAt(const dvec3& eye, const dvec3& target, const dvec3& up) {
  const dvec3 back = glm::normalize(eye - target);
  const dvec3 right = glm::normalize(glm::cross(up, back));
  const dvec3 trueUp = glm::cross(back, right);
  return {{right, 0.0}, {trueUp, 0.0}, {back, 0.0}, {eye, 1.0}};
}

Json classicMaterial(const std::string& name, const ClassicSpec& spec) {
  const bool mirrors = spec.kr != dvec3(0.0);
  Json material = {{"name", name},
                   {"pbrMetallicRoughness",
                    mirrors ? fallback(spec.kr, 1.0, spec.shininess) : fallback(spec.kd, 0.0, spec.shininess)}};
  if (spec.doubleSided) material["doubleSided"] = true;
  Json classic = {{"model", spec.model}, {"ambientFactor", listOf(spec.ka)}, {"diffuseFactor", listOf(spec.kd)}};
  classic["specularFactor"] = listOf(spec.ks);
  classic["shininess"] = spec.shininess;
  if (spec.transparency != 0.0) classic["transparency"] = spec.transparency;
  if (mirrors) classic["reflectionFactor"] = listOf(spec.kr);
  material["extensions"]["CROSSLIGHT_materials_classic"] = std::move(classic);
  return material;
}

Json presetMaterial(const std::string& preset) {
  const auto row = findMaterialPreset(preset);
  CL_CHECK(row.has_value());
  Json material = {
      {"name", preset},
      {"pbrMetallicRoughness", fallback(dvec3(row->diffuse + row->specular), 1.0, static_cast<double>(row->shininess))},
      {"doubleSided", true}};
  material["extensions"]["CROSSLIGHT_materials_classic"] = {{"model", "blinnPhong"}, {"preset", preset}};
  return material;
}

Json pbrMaterial(const std::string& name, const dvec3& baseColor, double metallic, double perceptualRoughness) {
  return {{"name", name},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {baseColor.x, baseColor.y, baseColor.z, 1.0}},
            {"metallicFactor", metallic},
            {"roughnessFactor", perceptualRoughness}}}};
}

Json glassMaterial(const std::string& name, const dvec3& tint, double indexOfRefraction) {
  Json material = pbrMaterial(name, tint, 0.0, 0.0);
  material["extensions"] = {{"KHR_materials_transmission", {{"transmissionFactor", 1.0}}},
                            {"KHR_materials_ior", {{"ior", indexOfRefraction}}},
                            {"KHR_materials_volume", {{"thicknessFactor", 1.0}}}};
  return material;
}

Json paint(const std::string& name, const dvec3& color, double ks, double shininess) {
  return classicMaterial(name, {.ka = color, .kd = color, .ks = dvec3(ks), .shininess = shininess});
}

Json matte(const std::string& name, const dvec3& color) {
  return classicMaterial(name, {.model = "lambert", .ka = color, .kd = color});
}

Json khrLight(const std::string& name, const char* type, const dvec3& color, double intensity) {
  return {{"name", name}, {"type", type}, {"color", listOf(color)}, {"intensity", intensity}};
}

void addPointLight(GltfBuilder& gltf, const std::string& name, const dvec3& position, const ClassicLightSpec& spec) {
  Json node = lightNode(name, gltf.addLight(lightWithClassic(name, "point", spec, glm::length(position))));
  node["translation"] = listOf(position);
  gltf.addRoot(std::move(node));
}

void addSpotLight(GltfBuilder& gltf, const std::string& name, const dvec3& position, const dvec3& target,
                  const ClassicLightSpec& spec) {
  CL_CHECK(spec.spotCutoff.has_value());
  const Json light = lightWithClassic(name, "spot", spec, glm::distance(position, target));
  Json node = lightNode(name, gltf.addLight(light));
  const dvec3 along = glm::normalize(target - position);
  const dvec3 up = std::abs(along.y) > 0.9 ? dvec3(0.0, 0.0, -1.0) : dvec3(0.0, 1.0, 0.0);
  node["matrix"] = matrixOf(lookAt(position, target, up));
  gltf.addRoot(std::move(node));
}

void addDirectionalLight(GltfBuilder& gltf, const std::string& name, const dvec3& direction,
                         const ClassicLightSpec& spec) {
  Json node = lightNode(name, gltf.addLight(lightWithClassic(name, "directional", spec, 1.0)));
  node["matrix"] = matrixOf(lookAt(dvec3(0.0), direction));
  gltf.addRoot(std::move(node));
}

int addCamera(GltfBuilder& gltf, const CameraSpec& spec, const std::string& name) {
  Json perspective = {{"yfov", spec.yFovDegrees * kPi / 180.0}, {"znear", spec.zNear}};
  if (spec.zFar) perspective["zfar"] = *spec.zFar;
  const int camera = gltf.addCamera({{"name", name}, {"type", "perspective"}, {"perspective", perspective}});
  const glm::dmat4 pose = lookAt(spec.eye, spec.target, spec.up);
  return gltf.addRoot({{"name", name}, {"camera", camera}, {"matrix", matrixOf(pose)}});
}

Json meshNode(const std::string& name, int mesh, const dvec3& translation) {
  Json node = {{"name", name}, {"mesh", mesh}};
  if (translation != dvec3(0.0)) node["translation"] = listOf(translation);
  return node;
}

Json shapeExtension(const ShapeSpec& spec, int material) {
  Json shape = {{"kind", nameOf(spec.kind)}};
  const bool round = spec.kind != ShapeKind::box && spec.kind != ShapeKind::plane;
  if (round) shape["radius"] = spec.params.x;
  if (spec.kind == ShapeKind::cylinder || spec.kind == ShapeKind::cone) shape["height"] = spec.params.y;
  if (spec.kind == ShapeKind::torus) shape["tubeRadius"] = spec.params.y;
  if (spec.kind == ShapeKind::box) shape["size"] = listOf(spec.params);
  shape["material"] = material;
  return shape;
}

Json shapeNode(GltfBuilder& gltf, const std::string& name, const ShapeSpec& spec, int material,
               const dvec3& translation) {
  const glm::vec4 params(glm::vec3(spec.params), 0.0f);
  const double planeHalfSize = 10.0;
  const Json geometry = gltf.addGeometry(tessellateShape(spec.kind, params, spec.segments, planeHalfSize));
  Json node = meshNode(name, gltf.addMesh(name, {{geometry, material}}), translation);
  node["extensions"]["CROSSLIGHT_node_shape"] = shapeExtension(spec, material);
  return node;
}

void addCheckerFloor(GltfBuilder& gltf, double halfSize, int steps, int lightMaterial, int darkMaterial) {
  const Json light = gltf.addGeometry(withoutUv(checkerMesh(halfSize, steps, 0)));
  const Json dark = gltf.addGeometry(withoutUv(checkerMesh(halfSize, steps, 1)));
  gltf.addRoot(meshNode("floor", gltf.addMesh("floor", {{light, lightMaterial}, {dark, darkMaterial}})));
}

void setAtmosphere(GltfBuilder& gltf, double ambient, const dvec3& background) {
  gltf.setAtmosphere({{"ambient", listOf(dvec3(ambient))}, {"background", listOf(background)}});
}

}  // namespace crosslight::scenegen

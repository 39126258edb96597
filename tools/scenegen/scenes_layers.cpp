// The smallest scene for each extension that changes or covers a metallic-roughness surface.
#include "scenegen/material_stage.h"
#include "scenegen/meshes.h"
#include "scenegen/parts.h"
#include "scenegen/registry.h"

namespace crosslight::scenegen {
namespace {

using glm::dvec3;

void diffuseRoughness(GltfBuilder& gltf) {
  const Json chalk = pbrMaterial("chalk", {0.8, 0.62, 0.45}, 0.0, 1.0);
  const int waves = wavesTexture(gltf);
  addBalls(gltf, withExtension(chalk, "KHR_materials_diffuse_roughness", {{"diffuseRoughnessFactor", 1.0}}),
           withExtension(chalk, "KHR_materials_diffuse_roughness",
                         {{"diffuseRoughnessFactor", 1.0}, {"diffuseRoughnessTexture", textureInfo(waves)}}));
  addPbrStage(gltf);
}

void specularLayer(GltfBuilder& gltf) {
  const Json plastic = pbrMaterial("plastic", {0.12, 0.3, 0.5}, 0.0, 0.35);
  const int waves = wavesTexture(gltf);
  addBalls(gltf,
           withExtension(plastic, "KHR_materials_specular",
                         {{"specularFactor", 0.6}, {"specularColorFactor", {4.0, 1.0, 0.3}}}),
           withExtension(plastic, "KHR_materials_specular",
                         {{"specularTexture", textureInfo(waves)}, {"specularColorTexture", textureInfo(waves)}}));
  addPbrStage(gltf);
}

void clearcoat(GltfBuilder& gltf) {
  const Json paint = pbrMaterial("paint", {0.6, 0.04, 0.05}, 0.5, 0.55);
  const int waves = wavesTexture(gltf);
  addBalls(
      gltf,
      withExtension(paint, "KHR_materials_clearcoat", {{"clearcoatFactor", 1.0}, {"clearcoatRoughnessFactor", 0.15}}),
      withExtension(paint, "KHR_materials_clearcoat",
                    {{"clearcoatFactor", 1.0},
                     {"clearcoatTexture", textureInfo(waves)},
                     {"clearcoatRoughnessFactor", 0.3},
                     {"clearcoatRoughnessTexture", textureInfo(waves)}}));
  addPbrStage(gltf);
}

void sheen(GltfBuilder& gltf) {
  const Json velvet = pbrMaterial("velvet", {0.25, 0.03, 0.06}, 0.0, 0.9);
  const int waves = wavesTexture(gltf);
  addBalls(gltf,
           withExtension(velvet, "KHR_materials_sheen",
                         {{"sheenColorFactor", {0.9, 0.6, 0.7}}, {"sheenRoughnessFactor", 0.4}}),
           withExtension(velvet, "KHR_materials_sheen",
                         {{"sheenColorFactor", {0.9, 0.6, 0.7}},
                          {"sheenRoughnessFactor", 0.7},
                          {"sheenColorTexture", textureInfo(waves)},
                          {"sheenRoughnessTexture", textureInfo(waves)}}));
  addPbrStage(gltf);
}

void anisotropy(GltfBuilder& gltf) {
  const Json brushed = pbrMaterial("brushed metal", {0.85, 0.8, 0.72}, 1.0, 0.4);
  addBallMeshes(gltf, withExtension(brushed, "KHR_materials_anisotropy", {{"anisotropyStrength", 0.8}}),
                withExtension(brushed, "KHR_materials_anisotropy",
                              {{"anisotropyStrength", 0.8}, {"anisotropyRotation", 0.7853981633974483}}));
  addPbrStage(gltf);
}

void iridescence(GltfBuilder& gltf) {
  const int waves = wavesTexture(gltf);
  addBalls(gltf,
           withExtension(pbrMaterial("oil on plastic", dvec3(0.02), 0.0, 0.25), "KHR_materials_iridescence",
                         {{"iridescenceFactor", 1.0}, {"iridescenceIor", 1.8}, {"iridescenceThicknessMaximum", 500.0}}),
           withExtension(pbrMaterial("tempered steel", {0.6, 0.58, 0.55}, 1.0, 0.35), "KHR_materials_iridescence",
                         {{"iridescenceFactor", 0.9},
                          {"iridescenceThicknessMinimum", 150.0},
                          {"iridescenceThicknessMaximum", 650.0},
                          {"iridescenceTexture", textureInfo(waves)},
                          {"iridescenceThicknessTexture", textureInfo(waves)}}));
  addPbrStage(gltf);
}

// Two sheets with the lamp behind them.
void diffuseTransmission(GltfBuilder& gltf) {
  const int waves = wavesTexture(gltf);
  const auto addSheet = [&](const char* name, Json extension, double x) {
    Json leaf = withExtension(pbrMaterial(name, {0.15, 0.35, 0.08}, 0.0, 0.6), "KHR_materials_diffuse_transmission",
                              std::move(extension));
    leaf["doubleSided"] = true;
    Primitive sheet = gridMesh({x, 1.0, 0.0}, {0.7, 0.0, 0.0}, {0.0, 0.8, 0.0}, 8);
    gltf.addRoot(meshNode(name, gltf.addMesh(name, {{gltf.addGeometry(sheet), gltf.addMaterial(std::move(leaf))}})));
  };
  addSheet("paper", {{"diffuseTransmissionFactor", 0.6}}, -0.8);
  addSheet("leaf",
           {{"diffuseTransmissionFactor", 0.8},
            {"diffuseTransmissionTexture", textureInfo(waves)},
            {"diffuseTransmissionColorFactor", {0.9, 0.8, 0.2}},
            {"diffuseTransmissionColorTexture", textureInfo(waves)}},
           0.8);
  addFloorAndCamera(gltf, pbrMaterial("floor", {0.45, 0.45, 0.47}, 0.0, 1.0));
  addKhrPoint(gltf, "behind", {0.3, 1.6, -1.5}, dvec3(1.0), 8.0);
  addKhrPoint(gltf, "front", {-3.0, 5.0, 4.0}, dvec3(1.0), 30.0);
}

void transmissionTexture(GltfBuilder& gltf) {
  Json glass = pbrMaterial("etched glass", dvec3(1.0), 0.0, 0.3);
  glass["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", 0.9},
                                                       {"transmissionTexture", textureInfo(wavesTexture(gltf))}};
  const Primitive sheet = gridMesh({0.0, 1.1, 0.5}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 8);
  gltf.addRoot(
      meshNode("sheet", gltf.addMesh("sheet", {{gltf.addGeometry(sheet), gltf.addMaterial(std::move(glass))}})));
  addPbrStage(gltf);
}

// Each layer's own lobe under light that has an extent: a window before the balls and the sky of feature/environment.
void litLayers(GltfBuilder& gltf) {
  Json coated = withExtension(pbrMaterial("coated", {0.1, 0.2, 0.5}, 1.0, 0.5), "KHR_materials_clearcoat",
                              {{"clearcoatFactor", 1.0}, {"clearcoatRoughnessFactor", 0.2}});
  coated["extensions"]["KHR_materials_anisotropy"] = {{"anisotropyStrength", 0.6}};
  Json cloth = withExtension(pbrMaterial("shot silk", {0.3, 0.05, 0.1}, 0.0, 0.5), "KHR_materials_sheen",
                             {{"sheenColorFactor", {0.8, 0.6, 0.3}}, {"sheenRoughnessFactor", 0.5}});
  cloth["extensions"]["KHR_materials_iridescence"] = {{"iridescenceFactor", 0.8},
                                                      {"iridescenceThicknessMaximum", 450.0}};
  cloth["extensions"]["KHR_materials_diffuse_transmission"] = {{"diffuseTransmissionFactor", 0.3}};
  addBallMeshes(gltf, std::move(coated), std::move(cloth));
  addFloorAndCamera(gltf, pbrMaterial("floor", {0.45, 0.45, 0.47}, 0.0, 1.0));
  Json light = {{"name", "window"}, {"type", "rect"}, {"color", {1.0, 0.95, 0.85}}, {"intensity", 6.0}, {"size", 1.5}};
  Json node = {{"name", "window"}, {"matrix", matrixOf(lookAt({-2.0, 2.4, 1.8}, {0.0, 0.6, 0.0}, {0.0, 1.0, 0.0}))}};
  node["extensions"]["EXT_lights_area"]["light"] = gltf.addLight(std::move(light), "EXT_lights_area");
  gltf.addRoot(std::move(node));
  gltf.setAtmosphere({{"environment", {{"uri", "environment_sky.hdr"}, {"intensity", 0.3}, {"rotation", 0.6}}}});
}

constexpr SceneRow kRows[] = {
    {"feature/diffuse_roughness", "KHR_materials_diffuse_roughness: factor and texture", diffuseRoughness},
    {"feature/specular", "KHR_materials_specular: factors and textures", specularLayer},
    {"feature/clearcoat", "KHR_materials_clearcoat: factors and textures", clearcoat},
    {"feature/sheen", "KHR_materials_sheen: factors and textures", sheen},
    {"feature/anisotropy", "KHR_materials_anisotropy along the tangents and at 45 degrees to them", anisotropy},
    {"feature/iridescence", "KHR_materials_iridescence: a film on plastic and, by textures, on metal", iridescence},
    {"feature/diffuse_transmission", "KHR_materials_diffuse_transmission: sheets before a lamp", diffuseTransmission},
    {"feature/lit_layers", "coat, sheen, film and brushed metal under a rectangle light and a sky", litLayers},
    {"feature/transmission_texture", "KHR_materials_transmission by a texture, a thin sheet", transmissionTexture},
};

}  // namespace

std::span<const SceneRow> layerScenes() { return kRows; }

}  // namespace crosslight::scenegen

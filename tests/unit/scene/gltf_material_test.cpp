// Materials, textures, images, extensions of Khronos.
#include <algorithm>

#include "unit/scene/gltf_fixture.h"

namespace crosslight::test {
namespace {

// 2x1 pixels, 8-bit RGB: (255, 0, 0), (0, 128, 255).
constexpr const char* kPng =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mP4z8DA0PAfAAgAAn8lPvwJAAAAAElFTkSuQmCC";
// The same data under a header of 16000 x 16000 pixels.
constexpr const char* kPngThatLies =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAPoAAAD6ACAIAAADOHEiJAAAAD0lEQVR42mP4z8DA0PAfAAgAAn8lPvwJAAAAAElFTkSuQmCC";
// 1x1 pixel, 16-bit gray: 0x8001.
constexpr const char* kPng16 =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABEAAAAABq7kcWAAAAC0lEQVR42mNoYAQAAQQAgqo/t10AAAAASUVORK5CYII=";

// Everything but the material, so that materials can be tested alone.
Material materialOf(GltfFile& file) { return file.load().materials.at(0); }

GltfFile& textured(GltfFile& file) {
  file.json["images"] = {{{"uri", kPng}, {"name", "picture"}}};
  file.json["textures"] = {{{"source", 0}}};
  return file;
}

TEST(GltfMaterial, CoreFactorsAreReadAndTheRestHasGltfsDefaults) {
  GltfFile file;
  file.json["materials"] = {
      {{"name", "m"},
       {"pbrMetallicRoughness",
        {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.25}}},
       {"emissiveFactor", {1, 0.5, 0}},
       {"alphaMode", "MASK"},
       {"alphaCutoff", 0.75},
       {"doubleSided", true}},
      Json::object()};
  const Scene scene = file.load();
  const Material& material = scene.materials.at(0);
  EXPECT_EQ(material.name, "m");
  EXPECT_EQ(material.model, IlluminationModel::cookTorrance);
  EXPECT_EQ(material.baseColorFactor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(material.metallicFactor, 0.5f);
  EXPECT_EQ(material.perceptualRoughnessFactor, 0.25f);
  EXPECT_EQ(material.emissiveFactor, glm::vec3(1, 0.5f, 0));
  EXPECT_EQ(material.alphaMode, AlphaMode::mask);
  EXPECT_EQ(material.alphaCutoff, 0.75f);
  EXPECT_TRUE(material.doubleSided);
  const Material& plain = scene.materials.at(1);
  EXPECT_EQ(plain.baseColorFactor, glm::vec4(1));
  EXPECT_EQ(plain.metallicFactor, 1.0f);
  EXPECT_EQ(plain.alphaMode, AlphaMode::opaque);
  EXPECT_FALSE(plain.baseColorTexture.present());
  EXPECT_FALSE(plain.hasIor);
}

TEST(GltfMaterial, FactorsOutOfRangeAreRefusedWithTheirPath) {
  GltfFile file;
  file.json["materials"] = {{{"pbrMetallicRoughness", {{"roughnessFactor", 1.5}}}}};
  EXPECT_REFUSED(file, "/materials/0/pbrMetallicRoughness/roughnessFactor: must be in [0, 1], is 1.5");
  file.json["materials"] = {{{"alphaMode", "SOME"}}};
  EXPECT_REFUSED(file, "/materials/0/alphaMode");
  file.json["materials"] = {{{"doubleSided", 1}}};
  EXPECT_REFUSED(file, "/materials/0/doubleSided: must be true or false");
}

TEST(GltfMaterial, AllFiveTexturesKeepTheirSamplerSetScaleAndTransform) {
  GltfFile file;
  textured(file);
  file.extension("KHR_texture_transform");
  file.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9987}}};
  file.json["textures"].push_back({{"source", 0}, {"sampler", 0}});
  const Json transform = {{"offset", {0.5, 0.25}}, {"rotation", 1.5}, {"scale", {2, -3}}, {"texCoord", 1}};
  file.json["materials"] = {
      {{"pbrMetallicRoughness",
        {{"baseColorTexture", {{"index", 1}}}, {"metallicRoughnessTexture", {{"index", 0}, {"texCoord", 1}}}}},
       {"normalTexture", {{"index", 0}, {"scale", 0.5}}},
       {"occlusionTexture", {{"index", 0}, {"strength", 0.25}}},
       {"emissiveTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}}}};
  const Scene scene = file.load();
  const Material& material = scene.materials.at(0);
  ASSERT_EQ(scene.images.size(), 1u);  // decoded once
  EXPECT_EQ(material.baseColorTexture.image, 0);
  EXPECT_EQ(material.baseColorTexture.wrapU, Wrap::clampToEdge);
  EXPECT_EQ(material.baseColorTexture.wrapV, Wrap::mirroredRepeat);
  EXPECT_EQ(material.baseColorTexture.filter, Filter::nearest);
  EXPECT_EQ(material.metallicRoughnessTexture.wrapU, Wrap::repeat);
  EXPECT_EQ(material.metallicRoughnessTexture.filter, Filter::linear);
  EXPECT_EQ(material.metallicRoughnessTexture.texCoord, 1);
  EXPECT_EQ(material.normalScale, 0.5f);
  EXPECT_EQ(material.occlusionStrength, 0.25f);
  EXPECT_EQ(material.emissiveTexture.offset, glm::vec2(0.5f, 0.25f));
  EXPECT_EQ(material.emissiveTexture.rotation, 1.5f);
  EXPECT_EQ(material.emissiveTexture.scale, glm::vec2(2, -3));
  EXPECT_EQ(material.emissiveTexture.texCoord, 1);
}

TEST(GltfImage, PixelsAreDecodedAsStoredAtEightAndSixteenBits) {
  GltfFile file;
  textured(file);
  file.json["images"].push_back({{"uri", kPng16}});
  file.json["textures"].push_back({{"source", 1}});
  file.json["materials"] = {{{"normalTexture", {{"index", 0}}}, {"occlusionTexture", {{"index", 1}}}}};
  const Scene scene = file.load();
  ASSERT_EQ(scene.images.size(), 2u);
  EXPECT_EQ(scene.images[0].name, "picture");
  EXPECT_EQ(scene.images[0].width, 2u);
  EXPECT_EQ(scene.images[0].height, 1u);
  EXPECT_EQ(scene.images[0].rgba, (std::vector<float>{1, 0, 0, 1, 0, 128.0f / 255.0f, 1, 1}));
  const float gray = 32769.0f / 65535.0f;
  EXPECT_EQ(scene.images[1].rgba, (std::vector<float>{gray, gray, gray, 1}));
}

TEST(GltfImage, BrokenImagesThatAMaterialUsesAreRefused) {
  GltfFile file;
  textured(file);
  file.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
  file.json["images"][0]["uri"] = "data:image/png;base64,aGVsbG8=";
  EXPECT_REFUSED(file, "/images/0: is neither PNG nor JPEG");
  file.json["images"][0]["uri"] = std::string(kPng).substr(0, 80);
  EXPECT_REFUSED(file, "/images/0: its image");
  // A header that promises 16000 x 16000 pixels is not believed beyond the budget.
  file.json["images"][0]["uri"] = kPngThatLies;
  EXPECT_NE(refusal(file, {.maxBytes = std::uint64_t{1} << 30}).find("/images/0: needs 4096000000 more bytes"),
            std::string::npos);
}

TEST(GltfMaterial, KhronosExtensionsAreRead) {
  GltfFile file;
  file.json["materials"] = {
      {{"emissiveFactor", {1, 1, 1}},
       {"extensions",
        {{"KHR_materials_emissive_strength", {{"emissiveStrength", 7}}},
         {"KHR_materials_ior", {{"ior", 1.25}}},
         {"KHR_materials_transmission", {{"transmissionFactor", 0.5}}},
         {"KHR_materials_volume",
          {{"thicknessFactor", 1}, {"attenuationDistance", 2}, {"attenuationColor", {1, 0.5, 0.25}}}},
         {"KHR_materials_dispersion", {{"dispersion", 0.5}}},
         {"CROSSLIGHT_materials_dielectric", {{"priority", 3}}}}}},
      {{"extensions", {{"KHR_materials_unlit", Json::object()}, {"KHR_materials_volume", Json::object()}}}},
      {{"extensions", {{"KHR_materials_ior", {{"ior", 0}}}}}}};
  const Scene scene = file.load();
  EXPECT_EQ(scene.materials[0].emissiveStrength, 7.0f);
  EXPECT_EQ(scene.materials[0].indexOfRefraction, 1.25f);
  EXPECT_TRUE(scene.materials[0].hasIor);
  EXPECT_EQ(scene.materials[0].transmissionFactor, 0.5f);
  EXPECT_TRUE(scene.materials[0].hasVolume);
  EXPECT_EQ(scene.materials[0].attenuationDistance, 2.0f);
  EXPECT_EQ(scene.materials[0].attenuationColor, glm::vec3(1, 0.5f, 0.25f));
  EXPECT_EQ(scene.materials[0].dispersion, 0.5f);
  EXPECT_EQ(scene.materials[0].priority, 3);
  EXPECT_EQ(scene.materials[1].priority, std::nullopt);
  EXPECT_EQ(scene.materials[1].model, IlluminationModel::unlit);
  EXPECT_FALSE(scene.materials[1].hasVolume);  // thickness 0 is a thin wall
  EXPECT_EQ(scene.materials[2].indexOfRefraction, 0.0f);
  file.json["materials"][2]["extensions"]["KHR_materials_ior"]["ior"] = 0.5;
  EXPECT_REFUSED(file, "/materials/2/extensions/KHR_materials_ior/ior");
}

TEST(GltfMaterial, ScatteringWithinABodyIsRead) {
  GltfFile file;
  const auto scatter = [&](double anisotropy) {
    file.json["materials"] = {{{"extensions",
                                {{"KHR_materials_volume_scatter",
                                  {{"multiscatterColor", {0.5, 0.25, 1}}, {"scatterAnisotropy", anisotropy}}}}}}};
  };
  scatter(0.5);
  const Material m = file.load().materials[0];
  EXPECT_EQ(m.multiscatterColor, glm::vec3(0.5f, 0.25f, 1.0f));
  EXPECT_EQ(m.scatterAnisotropy, 0.5f);
  scatter(1.5);
  EXPECT_REFUSED(file, "/materials/0/extensions/KHR_materials_volume_scatter/scatterAnisotropy");
}

TEST(GltfMaterial, SpecularGlossinessKeepsDiffuseAndReflectance) {
  GltfFile file;
  file.extension("KHR_materials_pbrSpecularGlossiness");
  file.json["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
  const auto material = [&](Json diffuse, Json specular) {
    file.json["materials"] = {
        {{"extensions",
          {{"KHR_materials_pbrSpecularGlossiness",
            {{"diffuseFactor", diffuse}, {"specularFactor", specular}, {"glossinessFactor", 0.75}}}}}}};
    return materialOf(file);
  };
  // A dielectric: the reflectance is that of metallic-roughness already.
  const Material plastic = material({0.5, 0.25, 0, 0.5}, {0.04, 0.04, 0.04});
  EXPECT_NEAR(plastic.metallicFactor, 0.0f, 1e-6f);
  EXPECT_NEAR(plastic.baseColorFactor.x, 0.5f * 0.96f, 1e-6f);
  EXPECT_EQ(plastic.baseColorFactor.w, 0.5f);
  EXPECT_EQ(plastic.perceptualRoughnessFactor, 0.25f);
  // A metal: no diffuse color, the reflectance is the base color.
  const Material metal = material({0, 0, 0, 1}, {1, 0.75, 0.25});
  EXPECT_EQ(metal.metallicFactor, 1.0f);
  EXPECT_EQ(glm::vec3(metal.baseColorFactor), glm::vec3(1, 0.75f, 0.25f));
}

TEST(GltfExtensions, AnUnknownRequiredExtensionIsRefusedByName) {
  GltfFile file;
  file.json["extensionsRequired"] = {"VENDOR_magic"};
  EXPECT_REFUSED(file, "/extensionsRequired/0: the file requires the extension 'VENDOR_magic', which is not supported");
}

TEST(GltfExtensions, AnUnknownOptionalExtensionIsNamedInAWarning) {
  GltfFile file;
  file.json["extensionsUsed"] = {"VENDOR_optional"};
  const Scene scene = file.load();
  EXPECT_TRUE(
      warned(file.folder().path().string() + "/scene.gltf: /: the extension 'VENDOR_optional' is not supported"));
  EXPECT_EQ(scene.stats.extensionsUsed, std::vector<std::string>{"VENDOR_optional"});
}

TEST(GltfMaterial, TexturesThatAreOnlyPartlySupportedAreNamed) {
  GltfFile file;
  textured(file);
  file.json["materials"] = {
      {{"normalTexture", {{"index", 0}, {"texCoord", 2}}},
       {"extensions", {{"KHR_materials_volume", {{"thicknessFactor", 1}, {"thicknessTexture", {{"index", 0}}}}}}}}};
  EXPECT_FALSE(materialOf(file).normalTexture.present());
  const std::string place = file.folder().path().string() + "/scene.gltf: /materials/0/";
  EXPECT_TRUE(warned(place + "normalTexture: reads TEXCOORD_2"));
  EXPECT_TRUE(warned(place + "extensions/KHR_materials_volume/thicknessTexture: does not count"));
}

TEST(GltfMaterial, LayersAreReadWithTheirTexturesAndRanges) {
  GltfFile file;
  textured(file);
  const Json info = {{"index", 0}};
  file.json["materials"] = {
      {{"extensions",
        {{"KHR_materials_specular",
          {{"specularFactor", 0.5}, {"specularColorFactor", {2, 1, 0}}, {"specularTexture", info}}},
         {"KHR_materials_clearcoat",
          {{"clearcoatFactor", 0.75}, {"clearcoatNormalTexture", {{"index", 0}, {"scale", 0.5}}}}},
         {"KHR_materials_sheen", {{"sheenColorFactor", {0.25, 0.5, 1}}, {"sheenRoughnessTexture", info}}},
         {"KHR_materials_anisotropy", {{"anisotropyStrength", 0.25}, {"anisotropyRotation", 1}}},
         {"KHR_materials_iridescence", {{"iridescenceFactor", 1}, {"iridescenceIor", 1.75}}},
         {"KHR_materials_diffuse_transmission", {{"diffuseTransmissionFactor", 0.125}}},
         {"KHR_materials_diffuse_roughness", {{"diffuseRoughnessFactor", 0.375}}},
         {"KHR_materials_transmission", {{"transmissionFactor", 1}, {"transmissionTexture", info}}},
         {"EXT_materials_bump", {{"bumpFactor", -2}, {"bumpTexture", info}}},
         {"CROSSLIGHT_materials_displacement", {{"displacementTexture", info}, {"scale", 3}, {"bias", -1}}}}}}};
  const Material m = materialOf(file);
  EXPECT_EQ(m.layers.specularFactor, 0.5f);
  EXPECT_EQ(m.layers.specularColor, glm::vec3(2, 1, 0));
  EXPECT_TRUE(m.layers.specularTexture.present());
  EXPECT_FALSE(m.layers.specularColorTexture.present());
  EXPECT_EQ(m.layers.clearcoat, 0.75f);
  EXPECT_EQ(m.layers.clearcoatNormalScale, 0.5f);
  EXPECT_EQ(m.layers.sheenColor, glm::vec3(0.25f, 0.5f, 1));
  EXPECT_TRUE(m.layers.sheenRoughnessTexture.present());
  EXPECT_EQ(m.layers.anisotropy, 0.25f);
  EXPECT_EQ(m.layers.anisotropyRotation, 1.0f);
  EXPECT_EQ(m.layers.filmIndex, 1.75f);
  EXPECT_EQ(m.layers.filmThickest, 400.0f);
  EXPECT_EQ(m.layers.diffuseTransmission, 0.125f);
  EXPECT_EQ(m.layers.diffuseRoughness, 0.375f);
  EXPECT_TRUE(m.transmissionTexture.present());
  EXPECT_TRUE(m.bumpTexture.present());
  EXPECT_EQ(m.bumpFactor, -2.0f);
  EXPECT_TRUE(m.displacementTexture.present());
  EXPECT_EQ(m.displacementScale, 3.0f);
  EXPECT_EQ(m.displacementBias, -1.0f);
  file.json["materials"][0]["extensions"]["KHR_materials_iridescence"]["iridescenceIor"] = 0.5;
  EXPECT_REFUSED(file, "/materials/0/extensions/KHR_materials_iridescence/iridescenceIor");
}

TEST(GltfMaterial, MinificationFiltersChooseLevels) {
  GltfFile file;
  textured(file);
  file.json["textures"][0]["sampler"] = 0;
  file.json["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
  const auto with = [&](Json sampler) {
    file.json["samplers"] = {std::move(sampler)};
    return materialOf(file).emissiveTexture;
  };
  EXPECT_EQ(with({{"minFilter", 9728}}).mip, Mip::none);
  EXPECT_EQ(with({{"minFilter", 9729}}).mip, Mip::none);
  EXPECT_EQ(with({{"minFilter", 9984}}).mip, Mip::nearest);
  EXPECT_EQ(with({{"minFilter", 9984}}).minFilter, Filter::nearest);
  EXPECT_EQ(with({{"minFilter", 9985}}).mip, Mip::nearest);
  EXPECT_EQ(with({{"minFilter", 9985}}).minFilter, Filter::linear);
  EXPECT_EQ(with({{"minFilter", 9986}}).minFilter, Filter::nearest);
  EXPECT_EQ(with({{"minFilter", 9987}}).mip, Mip::linear);
  EXPECT_EQ(with(Json::object()).mip, Mip::none);
}

TEST(GltfMaterial, ANormalTextureWithoutTangentsMakesThem) {
  GltfFile file;
  textured(file);
  addTriangle(file);
  file.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
  Json& primitive = file.json["meshes"][0]["primitives"][0];
  primitive["material"] = 0;
  primitive["attributes"]["TEXCOORD_0"] = file.floats({0, 1, 1, 1, 0, 0}, "VEC2");
  const Scene scene = file.load();
  for (const glm::vec4& tangent : scene.meshes[0].primitives[0].tangents) EXPECT_EQ(tangent, glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(scene.meshes[0].primitives[0].tangents.size(), 3u);
}

}  // namespace
}  // namespace crosslight::test

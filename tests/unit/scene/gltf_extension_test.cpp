// The CROSSLIGHT_* extensions: what they mean, and that the JSON schemas say what the reader does.
#include <cmath>
#include <functional>

#include "scene/material_table.h"
#include "unit/scene/gltf_fixture.h"

namespace crosslight::test {
namespace {

Json schemaOf(const std::string& extension) {
  std::ifstream in(std::string(CROSSLIGHT_SOURCE_DIR) + "/scenes/schema/" + extension + ".schema.json");
  return Json::parse(in);
}

// A file that uses one extension, where it belongs.
struct Carrier {
  std::string extension;
  std::string path;                      // of the extension in the file
  std::function<Json(const Json&)> put;  // the whole file around it
  Json valid;                            // an object with every property
};

const std::vector<Carrier>& carriers() {
  const auto file = [](Json rest) {
    Json json = {{"asset", {{"version", "2.0"}}}};
    json.update(rest);
    return json;
  };
  static const std::vector<Carrier> all = {
      {"CROSSLIGHT_materials_classic",
       "/materials/0/extensions/CROSSLIGHT_materials_classic",
       [=](const Json& e) {
         return file({{"materials", {{{"extensions", {{"CROSSLIGHT_materials_classic", e}}}}}}});
       },
       {{"model", "phong"},
        {"preset", "gold"},
        {"ambientFactor", {0, 0.5, 1}},
        {"diffuseFactor", {0, 0.5, 1}},
        {"specularFactor", {0, 0.5, 1}},
        {"shininess", 3},
        {"transparency", 0.5},
        {"reflectionFactor", {0, 0.5, 1}},
        {"roughness", 0.5},
        {"specularCoefficient", "angular"},
        {"refractiveIndex", {1, 2, 3}},
        {"extinction", {0, 1, 2}}}},
      {"CROSSLIGHT_lights_classic",
       "/extensions/KHR_lights_punctual/lights/0/extensions/CROSSLIGHT_lights_classic",
       [=](const Json& e) {
         const Json light = {{"type", "point"}, {"extensions", {{"CROSSLIGHT_lights_classic", e}}}};
         return file({{"extensions", {{"KHR_lights_punctual", {{"lights", {light}}}}}},
                      {"nodes", {{{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}}}});
       },
       {{"attenuation", {1, 2, 3}},
        {"spotExponent", 5},
        {"spotCutoff", 30},
        {"ambient", {1, 2, 3}},
        {"diffuse", {1, 2, 3}},
        {"specular", {1, 2, 3}}}},
      {"CROSSLIGHT_lights_area",
       "/extensions/KHR_lights_punctual/lights/0/extensions/CROSSLIGHT_lights_area",
       [=](const Json& e) {
         const Json light = {{"type", "point"}, {"extensions", {{"CROSSLIGHT_lights_area", e}}}};
         return file({{"extensions", {{"KHR_lights_punctual", {{"lights", {light}}}}}},
                      {"nodes", {{{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}}}});
       },
       {{"radius", 2}}},
      {"CROSSLIGHT_scene_atmosphere",
       "/scenes/0/extensions/CROSSLIGHT_scene_atmosphere",
       [=](const Json& e) {
         return file({{"scenes", {{{"extensions", {{"CROSSLIGHT_scene_atmosphere", e}}}}}},
                      {"accessors", {{{"componentType", 5126}, {"count", 1}, {"type", "SCALAR"}}}}});  // zeros
       },
       {{"ambient", {1, 2, 3}},
        {"background", {1, 2, 3}},
        {"fog", {{"mode", "exp"}, {"color", {1, 2, 3}}, {"start", 1}, {"end", 2}, {"density", 3}}},
        {"environment", {{"uri", "sky.hdr"}, {"intensity", 2}, {"rotation", -1}}},
        {"smoke",
         {{"shape", "box"},
          {"center", {1, 2, 3}},
          {"size", {1, 2, 3}},
          {"radius", 2},
          {"absorption", {1, 2, 3}},
          {"scattering", {1, 2, 3}},
          {"anisotropy", 0.5},
          {"grid", {{"cellsX", 1}, {"cellsY", 1}, {"cellsZ", 1}, {"densities", 0}}}}}}},
      {"CROSSLIGHT_node_shape",
       "/nodes/0/extensions/CROSSLIGHT_node_shape",
       [=](const Json& e) {
         return file({{"materials", {Json::object()}}, {"nodes", {{{"extensions", {{"CROSSLIGHT_node_shape", e}}}}}}});
       },
       {{"kind", "sphere"}, {"radius", 1}, {"height", 2}, {"size", {1, 2, 3}}, {"tubeRadius", 0.5}, {"material", 0}}},
      {"CROSSLIGHT_materials_dielectric",
       "/materials/0/extensions/CROSSLIGHT_materials_dielectric",
       [=](const Json& e) {
         return file({{"materials", {{{"extensions", {{"CROSSLIGHT_materials_dielectric", e}}}}}}});
       },
       {{"priority", 3}}},
      {"CROSSLIGHT_materials_displacement",
       "/materials/0/extensions/CROSSLIGHT_materials_displacement",
       [=](const Json& e) {
         return file({{"textures", {Json::object()}},
                      {"materials", {{{"extensions", {{"CROSSLIGHT_materials_displacement", e}}}}}}});
       },
       {{"displacementTexture", {{"index", 0}, {"texCoord", 0}}}, {"scale", 2}, {"bias", -1}}}};
  return all;
}

class Schema : public testing::TestWithParam<std::size_t> {
 protected:
  const Carrier& carrier() const { return carriers()[GetParam()]; }

  std::string refusalOf(const Json& extension) {
    folder_.write("sky.hdr", "whoever draws reads it");
    try {
      loadScene(folder_.write("scene.gltf", carrier().put(extension).dump()));
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
  void expectRefused(const Json& extension, const std::string& path) {
    const std::string text = refusalOf(extension);
    EXPECT_NE(text.find("scene.gltf: " + carrier().path + path), std::string::npos)
        << extension.dump() << " gives \"" << text << '"';
  }
  void expectLoads(const Json& extension) { EXPECT_EQ(refusalOf(extension), "") << extension.dump(); }

  // Replaces the value at `pointer` and says whether it must be refused.
  void with(const std::string& pointer, const Json& value, bool refused) {
    Json extension = carrier().valid;
    extension[Json::json_pointer(pointer)] = value;
    if (refused) {
      expectRefused(extension, pointer.substr(0, pointer.rfind('/')));
    } else {
      expectLoads(extension);
    }
  }

  void number(const Json& schema, const std::string& pointer) {
    with(pointer, "text", true);
    with(pointer, Json::array(), true);
    if (schema.contains("minimum")) {
      const double minimum = schema["minimum"].get<double>();
      if (minimum != 0.0 || pointer != "/fog/end") with(pointer, schema["minimum"], false);
      with(pointer, schema["type"] == "integer" ? Json(-1) : Json(std::nextafter(minimum, -1.0)), true);
    }
    if (schema.contains("exclusiveMinimum")) with(pointer, schema["exclusiveMinimum"], true);
    if (schema.contains("maximum")) {
      if (pointer.find("/cells") == std::string::npos)
        with(pointer, schema["maximum"], false);  // needs as many densities
      with(pointer, std::nextafter(schema["maximum"].get<double>(), 1e9), true);
    }
    if (!schema.contains("minimum") && !schema.contains("exclusiveMinimum") && !schema.contains("anyOf")) {
      with(pointer, -1000.0, false);
    }
    if (schema.contains("anyOf")) anyOf(schema["anyOf"], pointer);
  }

  void anyOf(const Json& alternatives, const std::string& pointer) {
    for (const Json& alternative : alternatives) {
      if (alternative.contains("const")) {
        const double value = alternative["const"].get<double>();
        with(pointer, value, false);
        with(pointer, std::nextafter(value, 1e9), true);
        with(pointer, value - 1.0, true);
      } else {
        with(pointer, alternative["minimum"], false);
        with(pointer, alternative["maximum"], false);
        with(pointer, alternative["minimum"].get<double>() - 1.0, true);
        with(pointer, alternative["maximum"].get<double>() + 1.0, true);
      }
    }
  }

  void array(const Json& schema, const std::string& pointer) {
    const auto count = schema["minItems"].get<std::size_t>();
    EXPECT_EQ(schema["minItems"], schema["maxItems"]);
    with(pointer, std::vector<double>(count - 1, 0.5), true);
    with(pointer, std::vector<double>(count + 1, 0.5), true);
    with(pointer, 1, true);
    for (std::size_t i = 0; i < count; ++i) number(schema["items"], pointer + "/" + std::to_string(i));
  }

  void value(const Json& schema, const std::string& pointer) {
    if (!schema.contains("type")) return;  // extras: anything
    const std::string type = schema["type"];
    if (type == "number" || type == "integer") number(schema, pointer);
    if (type == "array") array(schema, pointer);
    if (type == "string") {
      with(pointer, "no such name", true);
      with(pointer, 3, true);
    }
    if (type == "object" && schema.contains("properties")) object(schema, pointer);
  }

  void object(const Json& schema, const std::string& pointer) {
    EXPECT_EQ(schema["additionalProperties"], false) << pointer;
    with(pointer + "/noSuchProperty", 1, true);
    with(pointer + "/extras", {{"anything", 1}}, false);
    with(pointer + "/extensions", 1, true);
    const Json at = carrier().valid[Json::json_pointer(pointer)];
    for (const auto& [name, property] : schema["properties"].items()) {
      if (name != "extras" && name != "extensions") {
        EXPECT_TRUE(at.contains(name)) << "the test's object lacks " << pointer << '/' << name;
        value(property, pointer + "/" + name);
      }
    }
    for (const Json& name : schema.value("required", Json::array())) {
      Json extension = carrier().valid;
      extension[Json::json_pointer(pointer)].erase(name.get<std::string>());
      expectRefused(extension, pointer);
    }
  }

  TempFolder folder_;
};

TEST_P(Schema, NamesAndLimitsAreThoseOfTheReader) {
  const Json schema = schemaOf(carrier().extension);
  EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
  expectLoads(carrier().valid);
  object(schema, "");
}

INSTANTIATE_TEST_SUITE_P(EveryExtension, Schema, testing::Range<std::size_t>(0, carriers().size()),
                         [](const auto& i) { return carriers()[i.param].extension; });

TEST(NodeShape, TheSchemaListsEveryKindWithTheLengthsThatItNeeds) {
  const Json schema = schemaOf("CROSSLIGHT_node_shape");
  std::vector<std::string> kinds;
#define CL_KIND_NAME(value, name, ...) kinds.push_back(#name);
  CL_SHAPE_KINDS(CL_KIND_NAME)
#undef CL_KIND_NAME
  EXPECT_EQ(schema["properties"]["kind"]["enum"].get<std::vector<std::string>>(), kinds);
  const Json lengths = {{"radius", 2}, {"height", 3}, {"size", {4, 5, 6}}, {"tubeRadius", 0.5}};
  for (const std::string& kind : kinds) {
    Json required = Json::array();
    for (const Json& rule : schema["allOf"]) {
      if (rule["if"]["properties"]["kind"]["const"] == kind) required = rule["then"]["required"];
    }
    for (const auto& [left, ignored] : lengths.items()) {
      GltfFile file;
      Json& extension = file.node({{"extensions", {{"CROSSLIGHT_node_shape", lengths}}}}) == 0
                            ? file.json["nodes"][0]["extensions"]["CROSSLIGHT_node_shape"]
                            : file.json;
      extension["kind"] = kind;
      extension.erase(left);
      const bool isRequired = std::find(required.begin(), required.end(), Json(left)) != required.end();
      EXPECT_EQ(refusal(file) != "", isRequired) << kind << " without " << left;
    }
  }
}

TEST(NodeShape, ParametersAreLaidOutAsTheShaderReadsThem) {
  const auto params = [](Json extension) {
    GltfFile file;
    file.node({{"extensions", {{"CROSSLIGHT_node_shape", extension}}}});
    return file.load().shapes.at(0).params;
  };
  EXPECT_EQ(params({{"kind", "sphere"}, {"radius", 2}}), glm::vec4(2, 0, 0, 0));
  EXPECT_EQ(params({{"kind", "plane"}}), glm::vec4(0));
  EXPECT_EQ(params({{"kind", "box"}, {"size", {1, 2, 3}}}), glm::vec4(1, 2, 3, 0));
  EXPECT_EQ(params({{"kind", "cone"}, {"radius", 2}, {"height", 5}}), glm::vec4(2, 5, 0, 0));
  EXPECT_EQ(params({{"kind", "torus"}, {"radius", 2}, {"tubeRadius", 0.5}}), glm::vec4(2, 0.5f, 0, 0));
}

TEST(NodeShape, AShapeSharesTheIdAndTheMaterialOfTheMeshThatItReplaces) {
  GltfFile file;
  addTriangle(file);
  file.json["materials"] = {Json::object(), {{"name", "own"}}};
  file.json["meshes"][0]["primitives"][0]["material"] = 1;
  file.json["nodes"][0]["extensions"]["CROSSLIGHT_node_shape"] = {{"kind", "sphere"}, {"radius", 3}};
  file.json["nodes"][0]["translation"] = {10, 0, 0};
  Scene scene = file.load();
  ASSERT_EQ(scene.shapes.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_TRUE(scene.instances[0].replacedByShape);
  EXPECT_EQ(scene.shapes[0].instanceId, scene.instances[0].instanceId);
  EXPECT_EQ(scene.shapes[0].material, 1);
  EXPECT_EQ(scene.instanceCount, 1u);
  EXPECT_EQ(scene.worldBounds.lower, glm::dvec3(7, -3, -3));
  file.json["nodes"][0]["extensions"]["CROSSLIGHT_node_shape"]["material"] = 0;
  EXPECT_EQ(file.load().shapes[0].material, 0);
  file.json["nodes"][0]["extensions"]["CROSSLIGHT_node_shape"]["material"] = 2;
  EXPECT_REFUSED(file, "/nodes/0/extensions/CROSSLIGHT_node_shape/material");
  file.json["nodes"][0]["extensions"]["CROSSLIGHT_node_shape"]["material"] = 0;
  file.json["nodes"][0]["scale"] = {1, 0, 1};
  EXPECT_REFUSED(file, "/nodes/0: its world transform flattens an analytic shape");
}

TEST(NodeShape, AShapeWithoutMeshOrMaterialGetsTheDefaultOne) {
  GltfFile file;
  file.node({{"extensions", {{"CROSSLIGHT_node_shape", {{"kind", "plane"}}}}}});
  const Scene scene = file.load();
  EXPECT_EQ(scene.shapes.at(0).material, 0);
  EXPECT_EQ(scene.materials.size(), 1u);
  EXPECT_TRUE(scene.worldBounds.empty());
}

TEST(ClassicMaterial, ExplicitValuesOverrideThoseOfThePreset) {
  GltfFile file;
  file.json["materials"] = {{{"extensions",
                              {{"CROSSLIGHT_materials_classic",
                                {{"model", "blinnPhong"}, {"preset", "polishedGold"}, {"diffuseFactor", {1, 0, 0}}}},
                               {"KHR_materials_unlit", Json::object()}}}}};
  const Material material = file.load().materials.at(0);
  EXPECT_EQ(material.model, IlluminationModel::blinnPhong);
  EXPECT_EQ(material.classic.preset, "polishedGold");
  EXPECT_EQ(material.classic.diffuseFactor, glm::vec3(1, 0, 0));
  EXPECT_EQ(material.classic.ambientFactor, glm::vec3(0.24725f, 0.2245f, 0.0645f));
  EXPECT_EQ(material.classic.shininess, 83.2f);
}

TEST(ClassicMaterial, TheSchemaListsThePresetsOfTheTable) {
  std::vector<std::string> names;
  for (const MaterialPreset& preset : materialPresets()) names.emplace_back(preset.name);
  EXPECT_EQ(schemaOf("CROSSLIGHT_materials_classic")["properties"]["preset"]["enum"].get<std::vector<std::string>>(),
            names);
}

TEST(MaterialTable, EveryRowIsUsableAndNamedOnce) {
  for (const MaterialPreset& preset : materialPresets()) {
    EXPECT_EQ(findMaterialPreset(preset.name)->shininess, preset.shininess);
    for (int i = 0; i < 3; ++i) {
      for (const glm::vec3& color : {preset.ambient, preset.diffuse, preset.specular}) {
        EXPECT_GE(color[i], 0.0f) << preset.name;
        EXPECT_LE(color[i], 1.0f) << preset.name;
      }
    }
    EXPECT_GT(preset.shininess, 0.0f) << preset.name;
  }
  EXPECT_FALSE(findMaterialPreset("Gold").has_value());
}

TEST(MaterialTable, TheMetalsAreTheLectures) {
  const MaterialPreset brass = *findMaterialPreset("brass");
  EXPECT_EQ(brass.ambient, glm::vec3(0.329412f, 0.223529f, 0.027451f));
  EXPECT_EQ(brass.diffuse, glm::vec3(0.780392f, 0.568627f, 0.113725f));
  EXPECT_EQ(brass.specular, glm::vec3(0.992157f, 0.941176f, 0.807843f));
  EXPECT_EQ(brass.shininess, 27.8974f);
  EXPECT_EQ(findMaterialPreset("polishedCopper")->specular, glm::vec3(0.580594f, 0.223257f, 0.0695701f));
  EXPECT_EQ(findMaterialPreset("bronze")->shininess, 25.6f);
  EXPECT_EQ(findMaterialPreset("chrome")->diffuse, glm::vec3(0.4f));
}

TEST(ClassicLight, ValuesArriveBesideThePunctualLight) {
  GltfFile file;
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"},
       {"spot", Json::object()},
       {"extensions",
        {{"CROSSLIGHT_lights_classic", {{"attenuation", {1, 0.5, 0.25}}, {"spotCutoff", 20}, {"spotExponent", 8}}}}}}};
  file.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  const Light light = file.load().lights.at(0);
  ASSERT_TRUE(light.classic.has_value());
  EXPECT_EQ(light.classic->attenuation, glm::vec3(1, 0.5f, 0.25f));
  EXPECT_EQ(light.classic->spotCutoff, 20.0f);
  EXPECT_EQ(light.classic->spotExponent, 8.0f);
  EXPECT_EQ(light.classic->diffuse, glm::vec3(1));
}

TEST(Atmosphere, BelongsToTheSceneThatIsLoaded) {
  GltfFile file;
  file.json["scenes"] = {Json::object(),
                         {{"extensions",
                           {{"CROSSLIGHT_scene_atmosphere",
                             {{"ambient", {0.1, 0.2, 0.3}},
                              {"background", {1, 0, 0}},
                              {"fog", {{"mode", "linear"}, {"start", 2}, {"end", 9}}}}}}}}};
  EXPECT_EQ(file.load().atmosphere.ambient, glm::vec3(0));
  LoadOptions second;
  second.scene = "1";
  const Atmosphere atmosphere = file.load(second).atmosphere;
  EXPECT_EQ(atmosphere.ambient, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(atmosphere.background, glm::vec3(1, 0, 0));
  EXPECT_EQ(atmosphere.fogMode, FogMode::linear);
  EXPECT_EQ(atmosphere.fogStart, 2.0);
  EXPECT_EQ(atmosphere.fogEnd, 9.0);
  EXPECT_FALSE(warned("fog"));
  file.json["scenes"][1]["extensions"]["CROSSLIGHT_scene_atmosphere"]["fog"]["end"] = 2;
  EXPECT_NE(refusal(file, second).find("/scenes/1/extensions/CROSSLIGHT_scene_atmosphere/fog"), std::string::npos);
}

}  // namespace
}  // namespace crosslight::test

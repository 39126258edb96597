// Node hierarchy, scenes, cameras, lights, instancing.
#include <cmath>
#include <glm/geometric.hpp>

#include "unit/scene/gltf_fixture.h"

namespace crosslight::test {
namespace {

glm::dvec3 transformed(const MeshInstance& instance, const glm::dvec3& p) {
  return glm::dvec3(instance.worldFromObject * glm::dvec4(p, 1.0));
}

// Rounding of a chain of a few products of numbers around 10 in double.
constexpr double kChainTolerance = 1e-14;

void expectNear(const glm::dvec3& got, const glm::dvec3& expected, double tolerance) {
  EXPECT_TRUE(glm::distance(got, expected) <= tolerance) << got.x << ' ' << got.y << ' ' << got.z << " instead of "
                                                         << expected.x << ' ' << expected.y << ' ' << expected.z;
}

TEST(GltfNodes, ATransformChainIsTranslationTimesRotationTimesScaleFromTheRootDown) {
  GltfFile file;
  addTriangle(file);
  const double half = std::sqrt(0.5);
  // Quarter turn around z: x -> y.
  file.node({{"children", {0}}, {"rotation", {0, 0, half, half}}, {"translation", {10, 0, 0}}, {"scale", {2, 3, 4}}});
  file.node({{"children", {1}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}}});
  const Scene scene = file.load();
  ASSERT_EQ(scene.instances.size(), 1u);
  expectNear(transformed(scene.instances[0], {1, 0, 0}), {10, 2, 5}, kChainTolerance);
  expectNear(transformed(scene.instances[0], {0, 1, 0}), {7, 0, 5}, kChainTolerance);
  expectNear(transformed(scene.instances[0], {0, 0, 1}), {10, 0, 9}, kChainTolerance);
}

TEST(GltfNodes, ANegativeScaleMirrorsTheInstanceAndLeavesTheMeshAlone) {
  GltfFile file;
  addTriangle(file);
  file.json["nodes"][0]["scale"] = {-1, 1, 1};
  const Scene scene = file.load();
  EXPECT_EQ(transformed(scene.instances[0], {1, 0, 0}), glm::dvec3(-1, 0, 0));
  EXPECT_EQ(scene.meshes[0].primitives[0].normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(scene.worldBounds.lower, glm::dvec3(-1, 0, 0));
  EXPECT_EQ(scene.worldBounds.upper, glm::dvec3(0, 1, 0));
}

TEST(GltfNodes, NodesThatShareAMeshShareItInTheScene) {
  GltfFile file;
  addTriangle(file);
  file.node({{"mesh", 0}, {"translation", {0, 0, 7}}});
  const Scene scene = file.load();
  EXPECT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[1].mesh, 0);
  EXPECT_NE(scene.instances[0].instanceId, scene.instances[1].instanceId);
  EXPECT_EQ(scene.instanceCount, 2u);
  EXPECT_EQ(scene.stats.triangles, 2u);
}

TEST(GltfNodes, AChainOfAHundredThousandNodesLoads) {
  GltfFile file;
  addTriangle(file);
  for (std::size_t i = 0; i < 100000; ++i) file.node({{"children", {i}}, {"translation", {1, 0, 0}}});
  const Scene scene = file.load();
  EXPECT_EQ(transformed(scene.instances[0], {0, 0, 0}), glm::dvec3(100000, 0, 0));
}

TEST(GltfNodes, LoopsSharedChildrenAndRepeatedRootsAreRefused) {
  GltfFile loop;
  loop.node({{"children", {1}}});
  loop.node({{"children", {0}}});
  EXPECT_REFUSED(loop, "/nodes/0");
  GltfFile shared;
  shared.json["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, Json::object()};
  EXPECT_REFUSED(shared, "/nodes/1/children/0");
  GltfFile twice;
  twice.node(Json::object());
  twice.json["scenes"] = {{{"nodes", {0, 0}}}};
  EXPECT_REFUSED(twice, "/scenes/0/nodes/1");
}

TEST(GltfNodes, CoordinatesWhoseSquaresOverflowAreRefused) {
  GltfFile file;
  addTriangle(file);
  file.json["nodes"][0]["scale"] = {1e19, 1, 1};
  EXPECT_REFUSED(file, "/nodes/0");
}

TEST(GltfScenes, TheNamedOrNumberedSceneIsLoadedElseTheDefaultOne) {
  GltfFile file;
  addTriangle(file);
  file.node({{"mesh", 0}, {"name", "second"}});
  file.json["scenes"] = {{{"name", "a"}, {"nodes", {0}}}, {{"name", "b"}, {"nodes", {1}}}, {{"name", "none"}}};
  file.json["scene"] = 1;
  EXPECT_EQ(file.load().name, "b");
  EXPECT_EQ(file.load({.scene = "a"}).name, "a");
  EXPECT_EQ(file.load({.scene = "0"}).name, "a");
  EXPECT_EQ(file.load().instances.at(0).name, "second");
  EXPECT_TRUE(file.load({.scene = "2"}).instances.empty());
  EXPECT_EQ(file.load().stats.sceneNames, (std::vector<std::string>{"a", "b", "none"}));
  EXPECT_THROW(file.load({.scene = "c"}), UsageError);
  EXPECT_THROW(file.load({.scene = "3"}), UsageError);
}

TEST(GltfCameras, LensesAreReadAndTheirPlaceIsRigidUnderScale) {
  GltfFile file;
  file.json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.25}, {"aspectRatio", 2}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 9}}}}};
  const double half = std::sqrt(0.5);
  // Looks along +X, because a quarter turn around -y carries -z there; the scale mirrors.
  file.node({{"camera", 0},
             {"name", "eye"},
             {"rotation", {0, -half, 0, half}},
             {"scale", {-2, 3, 4}},
             {"translation", {1, 2, 3}}});
  file.node({{"camera", 1}});
  const Scene scene = file.load();
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_FALSE(scene.defaultCamera);
  const Camera& eye = scene.cameras[0];
  EXPECT_EQ(eye.yFov, 0.5);
  EXPECT_EQ(eye.zNear, 0.25);
  EXPECT_FALSE(eye.zFar.has_value());
  EXPECT_EQ(eye.aspectRatio, 2.0);
  expectNear(-glm::dvec3(eye.worldFromCamera[2]), {1, 0, 0}, kChainTolerance);
  expectNear(glm::dvec3(eye.worldFromCamera[1]), {0, 1, 0}, kChainTolerance);
  expectNear(glm::cross(glm::dvec3(eye.worldFromCamera[0]), glm::dvec3(eye.worldFromCamera[1])),
             glm::dvec3(eye.worldFromCamera[2]), kChainTolerance);
  EXPECT_EQ(glm::dvec3(eye.worldFromCamera[3]), glm::dvec3(1, 2, 3));
  EXPECT_TRUE(scene.cameras[1].orthographic);
  EXPECT_EQ(scene.cameras[1].xMag, 3.0);
  EXPECT_EQ(scene.cameras[1].zFar, 9.0);
  EXPECT_EQ(findCamera(scene, "eye"), 0);
  EXPECT_EQ(findCamera(scene, "1"), 1);
  EXPECT_THROW(findCamera(scene, "2"), UsageError);
  EXPECT_THROW(findCamera(scene, "ear"), UsageError);
}

TEST(GltfCameras, WithoutCameraTheWholeSceneIsInView) {
  GltfFile file;
  addTriangle(file);
  file.json["nodes"][0]["translation"] = {100, 50, -20};
  const Scene scene = file.load();
  EXPECT_TRUE(scene.defaultCamera);
  const Camera& camera = scene.cameras.at(0);
  for (const glm::dvec3& p : {glm::dvec3(100, 50, -20), glm::dvec3(101, 50, -20), glm::dvec3(100, 51, -20)}) {
    const glm::dvec3 d = p - glm::dvec3(camera.worldFromCamera[3]);
    const double depth = -glm::dot(d, glm::dvec3(camera.worldFromCamera[2]));
    EXPECT_GT(depth, camera.zNear);
    EXPECT_LT(std::abs(glm::dot(d, glm::dvec3(camera.worldFromCamera[0]))), depth * std::tan(camera.yFov / 2));
    EXPECT_LT(std::abs(glm::dot(d, glm::dvec3(camera.worldFromCamera[1]))), depth * std::tan(camera.yFov / 2));
  }
}

TEST(GltfCameras, AnEmptySceneHasACameraAndALightAllTheSame) {
  GltfFile file;
  const Scene scene = file.load();
  EXPECT_TRUE(scene.worldBounds.empty());
  ASSERT_EQ(scene.cameras.size(), 1u);
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_TRUE(std::isfinite(scene.cameras[0].worldFromCamera[3][2]));
}

TEST(GltfLights, PunctualLightsStandInTheWorldAndScaleDoesNotTouchTheirDirection) {
  GltfFile file;
  file.extension("KHR_lights_punctual");
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"intensity", 20}, {"range", 5}, {"color", {1, 0.5, 0}}},
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.3}}}},
      {{"type", "directional"}, {"name", "sun"}}};
  const double half = std::sqrt(0.5);
  const auto lamp = [](int i) { return Json{{"KHR_lights_punctual", {{"light", i}}}}; };
  file.node({{"extensions", lamp(0)}, {"translation", {1, 2, 3}}, {"name", "bulb"}});
  file.node({{"extensions", lamp(1)}, {"rotation", {-half, 0, 0, half}}, {"scale", {5, 0.1, -3}}});
  file.node({{"extensions", lamp(2)}});
  const Scene scene = file.load();
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_FALSE(scene.defaultLight);
  EXPECT_EQ(scene.lights[0].name, "bulb");
  EXPECT_EQ(scene.lights[0].worldPosition, glm::dvec3(1, 2, 3));
  EXPECT_EQ(scene.lights[0].range, 5.0f);
  EXPECT_EQ(scene.lights[0].color, glm::vec3(1, 0.5f, 0));
  EXPECT_EQ(scene.lights[0].intensity, 20.0f);
  EXPECT_EQ(scene.lights[1].innerConeAngle, 0.1f);
  EXPECT_EQ(scene.lights[1].outerConeAngle, 0.3f);
  // -z turns to -y, the scale along z mirrors that.
  expectNear(scene.lights[1].worldDirection, {0, 1, 0}, kChainTolerance);
  EXPECT_EQ(scene.lights[2].worldDirection, glm::dvec3(0, 0, -1));
  EXPECT_EQ(scene.lights[2].name, "sun");
}

TEST(GltfLights, ASpotWhoseInnerConeIsWiderThanItsOuterIsRefused) {
  GltfFile file;
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.3}}}}};
  file.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  EXPECT_REFUSED(file, "/extensions/KHR_lights_punctual/lights/0/spot");
}

TEST(GltfLights, WithoutLightAHeadlightOfPiLuxFollowsTheFirstCamera) {
  GltfFile file;
  file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.25}}}}};
  const double half = std::sqrt(0.5);
  file.node({{"camera", 0}, {"rotation", {0, -half, 0, half}}});
  const Scene scene = file.load();
  EXPECT_TRUE(scene.defaultLight);
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].type, LightType::directional);
  EXPECT_FLOAT_EQ(scene.lights[0].intensity, 3.14159265f);
  expectNear(scene.lights[0].worldDirection, {1, 0, 0}, kChainTolerance);
}

TEST(GltfInstancing, EveryElementIsAnInstanceOfItsOwn) {
  GltfFile file;
  addTriangle(file);
  file.extension("EXT_mesh_gpu_instancing");
  const std::size_t translations = file.floats({0, 0, 0, 5, 0, 0, 0, 6, 0}, "VEC3");
  const std::size_t scales = file.floats({1, 1, 1, 2, 2, 2, 3, 3, 3}, "VEC3");
  const auto rotations = file.accessor<std::int8_t>({0, 0, 0, 127, 0, 0, 127, 0, 0, 0, 0, 127}, "VEC4", true);
  file.json["nodes"][0]["translation"] = {100, 0, 0};
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", translations}, {"SCALE", scales}, {"ROTATION", rotations}};
  const Scene scene = file.load();
  ASSERT_EQ(scene.instances.size(), 3u);
  EXPECT_EQ(transformed(scene.instances[0], {1, 0, 0}), glm::dvec3(101, 0, 0));
  expectNear(transformed(scene.instances[1], {1, 0, 0}), {103, 0, 0}, 1e-13);  // half a turn around z
  EXPECT_EQ(transformed(scene.instances[2], {1, 0, 0}), glm::dvec3(103, 6, 0));
  EXPECT_EQ(scene.instances[2].instanceId, 2u);
  EXPECT_EQ(scene.instanceCount, 3u);

  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] =
      file.floats({1, 1, 1}, "VEC3");
  EXPECT_REFUSED(file, "/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/SCALE");
}

}  // namespace
}  // namespace crosslight::test

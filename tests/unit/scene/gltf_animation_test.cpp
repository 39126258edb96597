// Animations, morph targets and skins against closed forms.
#include <cmath>
#include <glm/geometric.hpp>

#include "unit/scene/gltf_fixture.h"

namespace crosslight::test {
namespace {

// Keys are floats; what follows from them is computed in double and stored in float at the end.
constexpr double kFloatStep = 1.2e-7;

glm::dvec3 origin(const Scene& scene, std::size_t instance = 0) {
  return glm::dvec3(scene.instances.at(instance).worldFromObject[3]);
}

struct Animated {
  GltfFile file;
  Animated(const std::string& path, const std::vector<float>& times, const std::vector<float>& values,
           const std::string& type, const std::string& interpolation) {
    addTriangle(file);
    const std::size_t input = file.floats(times, "SCALAR");
    const std::size_t output = file.floats(values, type);
    file.json["animations"] = {
        {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}}};
  }
  Scene at(double seconds) { return file.load({.timeSeconds = seconds, .animate = true}); }
};

TEST(GltfAnimation, WithoutAnimateTheNodesStayAsStored) {
  Animated a("translation", {0, 1}, {5, 0, 0, 7, 0, 0}, "VEC3", "LINEAR");
  EXPECT_EQ(origin(a.file.load()), glm::dvec3(0));
  EXPECT_EQ(a.file.load().stats.animations, 1u);
}

TEST(GltfAnimation, LinearInterpolatesAndHoldsBeyondItsKeys) {
  Animated a("translation", {1, 3, 4}, {0, 0, 0, 4, 0, 0, 4, 8, 0}, "VEC3", "LINEAR");
  EXPECT_EQ(origin(a.at(0)), glm::dvec3(0));
  EXPECT_EQ(origin(a.at(1.5)), glm::dvec3(1, 0, 0));
  EXPECT_EQ(origin(a.at(3)), glm::dvec3(4, 0, 0));
  EXPECT_EQ(origin(a.at(3.75)), glm::dvec3(4, 6, 0));
  EXPECT_EQ(origin(a.at(100)), glm::dvec3(4, 8, 0));
}

TEST(GltfAnimation, StepHoldsTheLastKey) {
  Animated a("translation", {1, 3}, {1, 0, 0, 2, 0, 0}, "VEC3", "STEP");
  EXPECT_EQ(origin(a.at(2.999)), glm::dvec3(1, 0, 0));
  EXPECT_EQ(origin(a.at(3)), glm::dvec3(2, 0, 0));
}

TEST(GltfAnimation, CubicSplineReproducesACubic) {
  // f(t) = t^3 - 2 t + 1 on [1, 3]: f(1) = 0, f(3) = 22, f'(1) = 1, f'(3) = 25. Hermite's form is exact for cubics.
  Animated a("translation", {1, 3}, {9, 9, 9, 0, 0, 0, 1, 0, 0, 25, 0, 0, 22, 0, 0, 9, 9, 9}, "VEC3", "CUBICSPLINE");
  for (const double t : {1.0, 1.25, 2.0, 2.5, 3.0}) EXPECT_NEAR(origin(a.at(t)).x, t * t * t - 2 * t + 1, 1e-12) << t;
  EXPECT_EQ(origin(a.at(0)).x, 0.0);
}

TEST(GltfAnimation, RotationTurnsEvenlyAlongTheShorterArc) {
  const double half = std::sqrt(0.5);
  // From 0 to 90 degrees around z, the second quaternion with its sign turned: still the shorter way.
  Animated a("rotation", {0, 1}, {0, 0, 0, 1, 0, 0, float(-half), float(-half)}, "VEC4", "LINEAR");
  for (const double t : {0.25, 0.5, 0.75}) {
    const glm::dvec3 x(a.at(t).instances[0].worldFromObject[0]);
    const double angle = t * std::acos(0.0);
    EXPECT_NEAR(x.x, std::cos(angle), kFloatStep) << t;
    EXPECT_NEAR(x.y, std::sin(angle), kFloatStep) << t;
  }
}

TEST(GltfAnimation, NormalizedIntegersDriveRotations) {
  Animated a("rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 0, 1}, "VEC4", "LINEAR");
  a.file.json["animations"][0]["samplers"][0]["output"] =
      a.file.accessor<std::int16_t>({0, 0, 0, 32767, 0, 0, 32767, 0}, "VEC4", true);
  const glm::dvec3 x(a.at(0.5).instances[0].worldFromObject[0]);
  EXPECT_NEAR(x.y, 1.0, kFloatStep);  // half of 180 degrees
}

TEST(GltfAnimation, TheFirstChannelThatDrivesAPropertyWins) {
  Animated a("translation", {0}, {1, 0, 0}, "VEC3", "LINEAR");
  Json second = a.file.json["animations"][0];
  second["samplers"][0]["output"] = a.file.floats({2, 0, 0}, "VEC3");
  a.file.json["animations"].push_back(second);
  EXPECT_EQ(origin(a.at(0)), glm::dvec3(1, 0, 0));
}

TEST(GltfAnimation, TimesThatDoNotRiseAndValuesThatAreMissingAreRefused) {
  Animated times("translation", {0, 1, 1}, {0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3", "LINEAR");
  EXPECT_NE(refusal(times.file, {.animate = true}).find("/animations/0/samplers/0/input"), std::string::npos);
  Animated values("translation", {0, 1}, {0, 0, 0}, "VEC3", "LINEAR");
  EXPECT_REFUSED(values.file, "/animations/0/channels/0");
  Animated spline("translation", {0, 1}, {0, 0, 0, 0, 0, 0}, "VEC3", "CUBICSPLINE");
  EXPECT_REFUSED(spline.file, "/animations/0/samplers/0/output");
  Animated type("rotation", {0}, {0, 0, 0}, "VEC3", "LINEAR");
  EXPECT_REFUSED(type.file, "/animations/0/channels/0");
  EXPECT_THROW(type.at(std::nan("")), UsageError);
}

GltfFile& morphed(GltfFile& file) {
  addTriangle(file);
  const std::size_t up = file.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  const std::size_t wide = file.floats({0, 0, 0, 1, 0, 0, 0, 0, 0}, "VEC3");
  file.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", up}}, {{"POSITION", wide}}};
  return file;
}

TEST(GltfMorph, WeightsOfTheNodeCountBeforeThoseOfTheMesh) {
  GltfFile file;
  morphed(file);
  EXPECT_EQ(file.load().meshes[0].primitives[0].positions[1], glm::vec3(1, 0, 0));
  file.json["meshes"][0]["weights"] = {0.5, 2};
  file.node({{"mesh", 0}, {"weights", {0, 1}}});
  file.node({{"mesh", 0}});
  const Scene scene = file.load();
  EXPECT_EQ(scene.meshes[0].primitives[0].positions[1], glm::vec3(3, 0, 0.5f));
  EXPECT_EQ(scene.meshes[1].primitives[0].positions[1], glm::vec3(2, 0, 0));
  EXPECT_EQ(scene.instances[2].mesh, 0);  // the same pose is the same mesh
  file.json["nodes"][1]["weights"] = {1};
  EXPECT_REFUSED(file, "/nodes/1/weights");
}

TEST(GltfMorph, AnimatedWeightsMoveTheMeshAndFlatNormalsFollow) {
  GltfFile file;
  morphed(file);
  file.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] = file.floats({0, 0, 0, 0, 0, 0, 0, 0, 1}, "VEC3");
  const std::size_t input = file.floats({0, 2}, "SCALAR");
  const std::size_t output = file.floats({0, 0, 1, 0}, "SCALAR");
  file.json["animations"] = {{{"samplers", {{{"input", input}, {"output", output}}}},
                              {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
  const Scene scene = file.load({.timeSeconds = 2.0, .animate = true});
  const Primitive& primitive = scene.meshes[0].primitives[0];
  EXPECT_EQ(primitive.positions[2], glm::vec3(0, 1, 1));
  EXPECT_NEAR(primitive.normals[0].y, -std::sqrt(0.5), kFloatStep);
  EXPECT_NEAR(primitive.normals[0].z, std::sqrt(0.5), kFloatStep);
  EXPECT_EQ(file.load({.timeSeconds = 1.0, .animate = true}).meshes[0].primitives[0].positions[2],
            glm::vec3(0, 1, 0.5f));
}

// Triangle whose vertices follow joint 0, joint 1, and both halves.
struct Skinned {
  GltfFile file;
  Skinned() {
    addTriangle(file);
    Json& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = file.accessor<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
    attributes["WEIGHTS_0"] = file.floats({1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0}, "VEC4");
    attributes["NORMAL"] = file.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    file.node({{"translation", {10, 0, 0}}});
    file.node({{"translation", {0, 20, 0}}});
    file.json["skins"] = {{{"joints", {1, 2}}}};
    file.json["nodes"][0]["skin"] = 0;
    file.json["nodes"][0]["translation"] = {1000, 1000, 1000};  // ignored
  }
};

glm::dvec3 worldVertex(const Scene& scene, std::size_t vertex) {
  const MeshInstance& instance = scene.instances.at(0);
  const glm::vec3 p = scene.meshes.at(static_cast<std::size_t>(instance.mesh)).primitives.at(0).positions.at(vertex);
  return glm::dvec3(instance.worldFromObject * glm::dvec4(glm::dvec3(p), 1.0));
}

TEST(GltfSkin, VerticesFollowTheWeightedJointsAndNotTheirNode) {
  Skinned skinned;
  const Scene scene = skinned.file.load();
  EXPECT_EQ(worldVertex(scene, 0), glm::dvec3(10, 0, 0));
  EXPECT_EQ(worldVertex(scene, 1), glm::dvec3(1, 20, 0));
  EXPECT_EQ(worldVertex(scene, 2), glm::dvec3(5, 11, 0));
  EXPECT_EQ(scene.meshes[0].primitives[0].normals[2], glm::vec3(0, 0, 1));
}

TEST(GltfSkin, InverseBindMatricesComeFirst) {
  Skinned skinned;
  std::vector<float> matrices(32, 0.0f);
  for (std::size_t m = 0; m < 2; ++m) {
    for (std::size_t i = 0; i < 4; ++i) matrices[m * 16 + i * 5] = 1.0f;
  }
  matrices[12] = -10.0f;     // joint 0: takes its own translation back
  matrices[16 + 5] = -1.0f;  // joint 1: mirrors y
  skinned.file.json["skins"][0]["inverseBindMatrices"] = skinned.file.floats(matrices, "MAT4");
  const Scene scene = skinned.file.load();
  EXPECT_EQ(worldVertex(scene, 0), glm::dvec3(0, 0, 0));
  EXPECT_EQ(worldVertex(scene, 2), glm::dvec3(0, 0.5 * 1 + 0.5 * (20 - 1), 0));
  skinned.file.json["skins"][0]["inverseBindMatrices"] = skinned.file.floats(kTriangle, "VEC3");
  EXPECT_REFUSED(skinned.file, "/skins/0/inverseBindMatrices");
}

TEST(GltfSkin, AMirroringPoseKeepsFrontFacesInFront) {
  Skinned skinned;
  skinned.file.json["nodes"][1]["scale"] = {-1, 1, 1};
  skinned.file.json["nodes"][2]["scale"] = {-1, 1, 1};
  const Scene scene = skinned.file.load();
  const Primitive& primitive = scene.meshes[0].primitives[0];
  EXPECT_EQ(primitive.indices, (std::vector<std::uint32_t>{0, 2, 1}));
  EXPECT_EQ(primitive.normals[0], glm::vec3(0, 0, 1));
}

TEST(GltfSkin, VerticesFarFromTheOriginKeepTheirShape) {
  Skinned skinned;
  skinned.file.json["nodes"][1]["translation"] = {1e9, 0, 0};
  skinned.file.json["nodes"][2]["translation"] = {1e9, 0, 0};
  const Scene scene = skinned.file.load();
  EXPECT_EQ(worldVertex(scene, 1) - worldVertex(scene, 0), glm::dvec3(1, 0, 0));
}

TEST(GltfSkin, JointsThatTheSkinDoesNotHaveAreRefused) {
  Skinned skinned;
  skinned.file.json["skins"][0]["joints"] = {1};
  EXPECT_REFUSED(skinned.file, "/meshes/0/primitives/0: vertex 1 follows joint 1, the skin has 1");
}

}  // namespace
}  // namespace crosslight::test

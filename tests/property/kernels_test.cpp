// Packets, one ray per lane or the device's own search: the same image, bit for bit, and the same counts of rays.
#include "trace/kernels.h"
#include "base/error.h"
#include "effects/effects.h"
#include "scene/shape_mesh.h"
#include "support/render_fixture.h"
#include "upload/shared_trees.h"

namespace crosslight::testing {
namespace {

struct Pair {
  RenderResult perLane, packet;
};

Pair renderByBoth(const Scene& scene, RenderSettings settings) {
  settings.kernel = KernelFamily::perLane;
  RenderResult perLane = render(device(), scene, settings);
  settings.kernel = KernelFamily::packet;
  return {std::move(perLane), render(device(), scene, settings)};
}

void expectEqual(const Pair& pair) {
  const Difference d =
      largestDifference(pair.perLane.image, pair.packet.image, [](std::uint32_t, std::uint32_t) { return true; });
  EXPECT_TRUE(pair.perLane.image.picture().samples == pair.packet.image.picture().samples) << d;
  EXPECT_EQ(pair.perLane.report.rays, pair.packet.report.rays);
  EXPECT_EQ(pair.perLane.report.counters.at("traversalsCapped"), 0u);
  EXPECT_EQ(pair.packet.report.counters.at("traversalsCapped"), 0u);
}

bool deviceRunsPackets() { return device().info().subgroupSize == 8; }

class Kernels : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!deviceRunsPackets()) GTEST_SKIP() << "packets need subgroups of 8 lanes";
  }
};

// A size that no tile divides, so that tiles overhang both edges.
TEST_P(Kernels, makeTheSameImage) {
  RenderSettings settings = settingsFor(Method::whitted, 61, 43);
  settings.spp = 2;
  expectEqual(renderByBoth(sceneNamed(GetParam()), settings));
}

INSTANTIATE_TEST_SUITE_P(AllScenes, Kernels, ::testing::ValuesIn(allSceneNames()), [](const auto& i) {
  std::string name = i.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

class RayQueries : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const std::string reason = whyNot(KernelFamily::rayQuery, device().info());
    if (!reason.empty()) GTEST_SKIP() << "the family ray-query " << reason;
  }
};

// Of several transparent surfaces in a light's way the device chooses the order, and each factor rounds once: of n
// there are at most n roundings of 2^-24. Whatever lies behind mirrors adds up such pictures.
constexpr double kOrderOfFactors = 64 * 0x1p-24;

void expectSamePicture(const RenderResult& a, const RenderResult& b, double tolerance) {
  const Difference d = largestDifference(a.image, b.image, [](std::uint32_t, std::uint32_t) { return true; });
  EXPECT_TRUE(d.maximum <= tolerance * std::max({1.0, std::abs(double{d.a}), std::abs(double{d.b})})) << d;
  EXPECT_TRUE(tolerance > 0 || a.image.picture().samples == b.image.picture().samples) << d;
  EXPECT_EQ(a.report.rays, b.report.rays);
}

TEST_P(RayQueries, makeTheSameImage) {
  const Scene scene = sceneNamed(GetParam());
  RenderSettings settings = settingsFor(Method::whitted, 61, 43);
  settings.spp = 2;
  settings.aovs = {"depth", "primitiveId", "instanceId"};
  settings.kernel = KernelFamily::perLane;
  const RenderResult walked = render(device(), scene, settings);
  settings.kernel = KernelFamily::rayQuery;
  const RenderResult queried = render(device(), scene, settings);
  expectSamePicture(walked, queried, showsItsTree(makePlan(scene, settings)) ? kOrderOfFactors : 0.0);
  for (const char* ids : {"primitiveId", "instanceId"})
    EXPECT_EQ(walked.image.find(ids)->integers, queried.image.find(ids)->integers) << ids;
  EXPECT_TRUE(walked.image.find("depth")->samples == queried.image.find("depth")->samples);
}

INSTANTIATE_TEST_SUITE_P(AllScenes, RayQueries, ::testing::ValuesIn(allSceneNames()), [](const auto& i) {
  std::string name = i.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

// A sphere of triangles that stands in a few pixels: a packet would meet all of them.
Scene distantDenseSphere() {
  Scene scene;
  scene.source = "made in a test";
  scene.meshes.push_back({"dense", {tessellateShape(ShapeKind::sphere, glm::vec4(1), 512, 0)}});
  scene.materials.emplace_back().doubleSided = true;
  MeshInstance& far = scene.instances.emplace_back();
  far.worldFromObject[3] = glm::dvec4(0.1, 0.2, -30, 1);
  scene.instanceCount = 1;
  scene.cameras.emplace_back();
  Light& light = scene.lights.emplace_back();
  light.type = LightType::directional;
  return scene;
}

TEST(GivenUp, packetsLeaveTheirRaysToBeDoneOneByOne) {
  if (!deviceRunsPackets()) GTEST_SKIP() << "packets need subgroups of 8 lanes";
  const Scene scene = distantDenseSphere();
  const Pair pair = renderByBoth(scene, settingsFor(Method::whitted, 64, 64));
  EXPECT_GT(pair.packet.report.counters.at("packetsGivenUp"), 0u);
  expectEqual(pair);
}

// Rays within the plane x = 0, in which edges of a disk of triangles lie, seen ever flatter: who is nearest is decided
// by the triangles alone, not by whose box a kernel looks into first.
TEST(Edges, showTheSameTriangleWhateverTheKernel) {
  if (!deviceRunsPackets()) GTEST_SKIP() << "packets need subgroups of 8 lanes";
  Scene scene;
  scene.source = "made in a test";
  scene.meshes.push_back({"floor", {tessellateShape(ShapeKind::disk, glm::vec4(6), 32, 0)}});
  scene.materials.emplace_back().doubleSided = true;
  MeshInstance& floor = scene.instances.emplace_back();
  floor.worldFromObject[3] = glm::dvec4(0, -2.5, -6, 1);
  scene.instanceCount = 1;
  scene.cameras.emplace_back();
  Light& light = scene.lights.emplace_back();
  light.worldPosition = glm::dvec3(0, 5, 0);
  RenderSettings settings = settingsFor(Method::whitted, 161, 123);
  settings.aovs = {"depth", "primitiveId"};
  const Pair pair = renderByBoth(scene, settings);
  expectEqual(pair);
  EXPECT_TRUE(pair.perLane.image.find("depth")->samples == pair.packet.image.find("depth")->samples);
  EXPECT_EQ(pair.perLane.image.find("primitiveId")->integers, pair.packet.image.find("primitiveId")->integers);
}

TEST(Families, haveNamesThatLeadBack) {
  for (const std::string& name : kernelFamilyNames()) EXPECT_EQ(nameOf(kernelFamilyOf(name)), name);
  EXPECT_THROW(kernelFamilyOf("pocket"), std::exception);
}

TEST(Families, packetsAreRefusedWhereSubgroupsAreNotOfEight) {
  gpu::DeviceInfo wide;
  wide.name = "a GPU";
  wide.subgroupSize = 32;
  EXPECT_EQ(familyFor(wide), KernelFamily::perLane);
  RenderSettings settings;
  settings.kernel = KernelFamily::packet;
  EXPECT_THROW(chooseKernels(wide, Plan{}, settings), std::exception);
  settings.kernel = KernelFamily::rayQuery;
  EXPECT_THROW(chooseKernels(wide, Plan{}, settings), DeviceError);
  wide.rayQueryLacks.clear();
  EXPECT_EQ(familyFor(wide), KernelFamily::perLane);  // not before it is measured
  EXPECT_NO_THROW(chooseKernels(wide, Plan{}, settings));
  settings.kernel = KernelFamily::automatic;
  EXPECT_EQ(chooseKernels(wide, Plan{}, settings).camera, "camera.comp");
}

}  // namespace
}  // namespace crosslight::testing

// A pass of depth alone before the one that lights: the same image, bit for bit, and taken where it pays.
#include "scene/shape_mesh.h"
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

RenderResult renderWith(const Scene& scene, RenderSettings settings, DepthPrepass prepass) {
  settings.depthPrepass = prepass;
  return render(device(), scene, settings);
}

void expectSameBits(const Scene& scene, const RenderSettings& settings) {
  const RenderResult without = renderWith(scene, settings, DepthPrepass::off);
  const RenderResult with = renderWith(scene, settings, DepthPrepass::on);
  ASSERT_EQ(without.report.counters.at("depthPrepass"), 0u);
  ASSERT_EQ(with.report.counters.at("depthPrepass"), 1u);
  const Difference d = largestDifference(without.image, with.image, [](std::uint32_t, std::uint32_t) { return true; });
  EXPECT_TRUE(without.image.picture().samples == with.image.picture().samples) << d;
}

class Prepass : public ::testing::TestWithParam<std::string> {};

TEST_P(Prepass, changesNoBit) {
  RenderSettings settings = settingsFor(Method::phong, 61, 43);
  settings.spp = 2;
  expectSameBits(sceneNamed(GetParam()), settings);
  settings.spp = 1;
  settings.msaa = 4;
  expectSameBits(sceneNamed(GetParam()), settings);
}

INSTANTIATE_TEST_SUITE_P(AllScenes, Prepass, ::testing::ValuesIn(allSceneNames()), [](const auto& i) {
  std::string name = i.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

// Disks one behind the other, each twice at the same place in another color, under many lights.
Scene disks(bool nearestFirst) {
  Scene scene;
  scene.source = "made in a test";
  const int mesh = 0, layers = 8;
  scene.meshes.push_back({"disk", {tessellateShape(ShapeKind::disk, glm::vec4(3), 32, 0)}});
  for (Primitive& p : scene.meshes[mesh].primitives) p.material = 0;
  scene.meshes.push_back(scene.meshes[mesh]);
  for (Primitive& p : scene.meshes[1].primitives) p.material = 1;
  for (const glm::vec4& color : {glm::vec4(1, 0.2, 0.1, 1), glm::vec4(0.1, 0.2, 1, 1)}) {
    Material& m = scene.materials.emplace_back();
    m.baseColorFactor = color;
    m.doubleSided = true;
  }
  for (int i = 0; i < 2 * layers; ++i) {
    MeshInstance& disk = scene.instances.emplace_back();
    disk.mesh = i % 2;
    disk.instanceId = static_cast<std::uint32_t>(i);
    const int layer = nearestFirst ? i / 2 : layers - 1 - i / 2;
    // The disk lies in y = 0; it turns towards the camera, which looks along -z.
    disk.worldFromObject = glm::dmat4(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, 1, 0), glm::dvec4(0, -1, 0, 0),
                                      glm::dvec4(0, 0, -2 - 0.1 * layer, 1));
  }
  scene.instanceCount = 2 * layers;
  scene.cameras.emplace_back();
  for (int i = 0; i < 4; ++i) scene.lights.emplace_back().worldPosition = glm::dvec3(i - 1.5, 1, 0);
  return scene;
}

TEST(Prepass, isTakenWhereHiddenSurfacesWouldBeLit) {
  const RenderSettings settings = settingsFor(Method::phong, 256, 256);
  const auto takes = [&](bool nearestFirst) {
    return renderWith(disks(nearestFirst), settings, DepthPrepass::automatic).report.counters.at("depthPrepass");
  };
  EXPECT_EQ(takes(false), 1u);
  EXPECT_EQ(takes(true), 0u);
  RenderSettings gouraud = settings;
  gouraud.method = Method::gouraud;
  const Scene scene = disks(false);
  EXPECT_EQ(renderWith(scene, gouraud, DepthPrepass::on).report.counters.at("depthPrepass"), 0u) << "of phong only";
}

TEST(Prepass, leavesTheFirstOfCoincidentSurfacesInSight) {
  for (const bool nearestFirst : {false, true}) {
    const Scene scene = disks(nearestFirst);
    expectSameBits(scene, settingsFor(Method::phong, 64, 64));
    const auto pixel = pixelAt(renderWith(scene, settingsFor(Method::phong, 64, 64), DepthPrepass::on).image, 32, 32);
    EXPECT_GT(pixel[0], pixel[2]) << "the first of two is red";
  }
}

}  // namespace
}  // namespace crosslight::testing

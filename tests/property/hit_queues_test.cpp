// Hits in queues by class, each shaded by a kernel made for it: the same image and AOVs, bit for bit.
#include <cstring>

#include "effects/hit_classes.h"
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

void expectSameLayers(const Image& a, const Image& b) {
  ASSERT_EQ(a.layers.size(), b.layers.size());
  for (std::size_t i = 0; i < a.layers.size(); ++i) {
    const auto differs =
        std::mismatch(a.layers[i].samples.begin(), a.layers[i].samples.end(), b.layers[i].samples.begin(),
                      [](float x, float y) { return std::memcmp(&x, &y, sizeof x) == 0; });
    EXPECT_TRUE(differs.first == a.layers[i].samples.end())
        << a.layers[i].name << " at sample " << differs.first - a.layers[i].samples.begin() << ": " << *differs.first
        << " and " << *differs.second;
  }
}

class Queues : public ::testing::TestWithParam<std::string> {};

TEST_P(Queues, changeNoBitOfPictureAndAovs) {
  const Scene scene = sceneNamed(GetParam());
  RenderSettings settings = settingsFor(Method::whitted, 61, 43);
  settings.spp = 2;
  settings.aovs.assign(std::begin(kAovNames), std::end(kAovNames));
  settings.hitQueues = HitQueues::off;
  const RenderResult together = render(device(), scene, settings);
  settings.hitQueues = HitQueues::on;
  const RenderResult queued = render(device(), scene, settings);
  expectSameLayers(together.image, queued.image);
  auto without = together.report.rays, with = queued.report.rays;
  EXPECT_LE(with["shadow"], without["shadow"]);  // surfaces that show no light send none
  without.erase("shadow");
  with.erase("shadow");
  EXPECT_EQ(without, with);
}

INSTANTIATE_TEST_SUITE_P(AllScenes, Queues, ::testing::ValuesIn(allSceneNames()), [](const auto& i) {
  std::string name = i.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

// A row of spheres, one per material.
Scene spheresOf(const std::vector<Material>& materials) {
  Scene scene;
  scene.source = "made in a test";
  scene.materials = materials;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    ShapeInstance& shape = scene.shapes.emplace_back();
    shape.material = static_cast<int>(i);
    shape.params = {0.4f, 0, 0, 0};
    shape.worldFromObject[3] =
        glm::dvec4(static_cast<double>(i) - 0.5 * static_cast<double>(materials.size()), 0, -8, 1);
    shape.instanceId = static_cast<std::uint32_t>(i);
  }
  scene.instanceCount = static_cast<std::uint32_t>(materials.size());
  scene.cameras.emplace_back();
  scene.lights.emplace_back().type = LightType::directional;
  scene.atmosphere.ambient = glm::vec3(0.1f);
  return scene;
}

Material classic(IlluminationModel model, float kd, float kr, float kt) {
  Material m;
  m.model = model;
  m.classic.diffuseFactor = glm::vec3(kd);
  m.classic.specularFactor = m.classic.ambientFactor = glm::vec3(0);
  m.classic.reflectionFactor = glm::vec3(kr);
  m.classic.transparency = kt;
  return m;
}

std::vector<Material> manyKinds() {
  using enum IlluminationModel;
  Material unlitOne;
  unlitOne.model = unlit;
  return {classic(lambert, 0.7f, 0, 0),    classic(phong, 0.7f, 0, 0),      classic(blinnPhong, 0.7f, 0.3f, 0),
          classic(lambert, 0, 0.4f, 0.6f), classic(lambert, 0.5f, 0, 0.5f), unlitOne};
}

RenderSettings queued() {
  RenderSettings settings = settingsFor(Method::whitted, 64, 48);
  settings.hitQueues = HitQueues::on;
  return settings;
}

TEST(HitClasses, materialsThatAskForTheSameShareOne) {
  const Scene scene =
      spheresOf({classic(IlluminationModel::phong, 0.5f, 0, 0), classic(IlluminationModel::phong, 0.9f, 0, 0),
                 classic(IlluminationModel::phong, 0.5f, 0.5f, 0)});
  const HitClasses found = classifyHits(scene, makePlan(scene, queued()), queued());
  ASSERT_EQ(found.classes.size(), 2u);
  EXPECT_EQ(found.ofMaterial[0].y, found.ofMaterial[1].y);
  EXPECT_NE(found.ofMaterial[0].y, found.ofMaterial[2].y);
  EXPECT_EQ(found.ofMaterial[0].x, shared::kHitClasses) << "no mesh has this material";
}

TEST(HitClasses, plansHoldWhatTheirSurfacesAskForAndNoMore) {
  const Scene scene =
      spheresOf({classic(IlluminationModel::lambert, 0.5f, 0, 0), classic(IlluminationModel::phong, 0, 0.5f, 0)});
  const HitClasses found = classifyHits(scene, makePlan(scene, queued()), queued());
  ASSERT_EQ(found.classes.size(), 2u);
  const HitClass& matt = found.classes[found.ofMaterial[0].y];
  const HitClass& mirror = found.classes[found.ofMaterial[1].y];
  EXPECT_TRUE(matt.lit && matt.plan.has(Effect::shadows) && !matt.plan.has(Effect::reflection));
  EXPECT_TRUE(!mirror.lit && !mirror.plan.has(Effect::shadows) && mirror.plan.has(Effect::reflection));
  EXPECT_EQ(matt.plan.models, 1u << static_cast<std::uint32_t>(IlluminationModel::lambert));
  EXPECT_EQ(mirror.plan.lights, 0u) << "nothing of a light shows on it";
}

TEST(HitClasses, moreKindsThanClassesShareTheLast) {
  const Scene scene = spheresOf(manyKinds());
  RenderSettings settings = queued();
  const HitClasses found = classifyHits(scene, makePlan(scene, settings), settings);
  EXPECT_EQ(found.classes.size(), shared::kHitClasses);
  for (const glm::uvec4& c : found.ofMaterial) EXPECT_LT(c.y, shared::kHitClasses);
  const RenderResult with = render(device(), scene, settings);
  settings.hitQueues = HitQueues::off;
  expectSameLayers(with.image, render(device(), scene, settings).image);
}

// The kernel of what is within a body does not refract: there is no fog before it all the same.
TEST(HitClasses, knowOfTheBodyThatARayComesThrough) {
  Material glass;
  glass.transmissionFactor = 1.0f;
  glass.metallicFactor = glass.perceptualRoughnessFactor = 0.0f;
  glass.hasVolume = true;
  Scene scene = spheresOf({glass, classic(IlluminationModel::lambert, 0.7f, 0, 0)});
  for (ShapeInstance& shape : scene.shapes) shape.worldFromObject[3] = {0, 0, -4, 1};
  scene.shapes[0].params = glm::vec4(1.2f, 0, 0, 0);
  scene.atmosphere.fogMode = FogMode::linear;
  scene.atmosphere.fogEnd = 4.0;
  RenderSettings settings = queued();
  const RenderResult with = render(device(), scene, settings);
  settings.hitQueues = HitQueues::off;
  expectSameLayers(with.image, render(device(), scene, settings).image);
}

TEST(HitClasses, pictureOfFewRaysHasNone) {
  const Scene scene = spheresOf(manyKinds());
  RenderSettings settings = queued();
  settings.hitQueues = HitQueues::automatic;
  EXPECT_TRUE(classifyHits(scene, makePlan(scene, settings), settings).classes.empty());
  settings.width = settings.height = 1024;
  EXPECT_FALSE(classifyHits(scene, makePlan(scene, settings), settings).classes.empty());
}

}  // namespace
}  // namespace crosslight::testing

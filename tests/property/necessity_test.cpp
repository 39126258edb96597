// That the law of effects can fail: each effect is called for by its scene and not by the scene beside it, and a plan
// without it draws another picture by more than a stated amount. So a rule that judged it off, where it judges it on,
// would be caught by the comparison with the full pipeline. And what is off does no work.
#include <set>

#include "effects/effects.h"
#include "effects/forced.h"
#include "support/effect_scenes.h"

namespace crosslight::testing {
namespace {

using Make = Scene (*)();
using Ask = void (*)(RenderSettings&);

struct Row {
  const char* effect;
  Method method;
  const char* scene;     // calls for it
  const char* neighbor;  // does not
  double leastChange;    // of one channel of one pixel, in the picture without it
  Make make = nullptr;   // instead of the scene's file
  Ask ask = nullptr;     // settings that it takes
};

Scene withoutMeshes() {
  Scene scene = sceneNamed("feature/shapes");
  std::erase_if(scene.instances, [](const MeshInstance& i) { return !i.replacedByShape; });
  return scene;
}

Scene withoutLights() {
  Scene scene = sceneNamed("feature/point");
  scene.lights.clear();
  return scene;
}

constexpr const char* kWithoutMeshes = "without meshes";
constexpr const char* kWithoutLights = "without lights";

Scene neighborOf(const Row& row) {
  if (row.neighbor == kWithoutMeshes) return withoutMeshes();
  if (row.neighbor == kWithoutLights) return withoutLights();
  return sceneNamed(row.neighbor);
}

constexpr Method kRaster = Method::phong, kRays = Method::whitted;
constexpr Row kRows[] = {
    {"unlit", kRaster, "feature/unlit", "feature/lambert", 0.1},
    {"lambert", kRaster, "feature/lambert", "feature/point", 0.1},
    {"phong", kRaster, "feature/phong", "feature/point", 0.1},
    {"blinnPhong", kRaster, "feature/blinnPhong", "feature/point", 0.1},
    {"cookTorrance", kRaster, "feature/point", "feature/point_classic", 0.1},
    {"modifiedPhong", kRaster, "feature/modifiedPhong", "feature/phong", 0.1},
    {"orenNayar", kRaster, "feature/orenNayar", "feature/lambert", 0.1},
    {"cookTorrance1982", kRaster, "feature/cookTorrance1982", "feature/phong", 0.1},
    {"point", kRaster, "feature/point", "feature/directional", 0.1},
    {"directional", kRaster, "feature/directional", "feature/point", 0.1},
    {"spot", kRaster, "feature/spot", "feature/point", 0.1},
    {"areaRectangle", kRaster, "feature/areaRectangle", "feature/areaDisk", 0.1},
    {"areaDisk", kRaster, "feature/areaDisk", "feature/areaRectangle", 0.1},
    {"areaSphere", kRaster, "feature/areaSphere", "feature/areaDisk", 0.1},
    {"areaTriangle", kRaster, "feature/emission", "feature/emission", 0.01, glowing},
    {"sphere", kRays, "feature/shapes", "feature/mipmaps", 0.1},
    {"plane", kRays, "feature/shapes", "feature/point", 0.1},
    {"disk", kRays, "feature/shapes", "feature/point", 0.1},
    {"box", kRays, "feature/shapes", "feature/point", 0.1},
    {"cylinder", kRays, "feature/shapes", "feature/point", 0.1},
    {"cone", kRays, "feature/shapes", "feature/point", 0.1},
    {"torus", kRays, "feature/shapes", "feature/point", 0.1},
    {"baseColorTexture", kRaster, "feature/texture", "feature/lambert", 0.1},
    {"metallicRoughnessTexture", kRaster, "", "feature/lambert", 0.01, textured<&Material::metallicRoughnessTexture>},
    {"normalMap", kRaster, "feature/normal_map", "feature/texture", 0.1},
    {"occlusionTexture", kRaster, "", "feature/texture", 0.01, textured<&Material::occlusionTexture>},
    {"emissiveTexture", kRaster, "", "feature/texture", 0.01, textured<&Material::emissiveTexture>},
    {"vertexColors", kRaster, "feature/vertex_colors", "feature/lambert", 0.1},
    {"alphaMask", kRaster, "feature/alpha_mask", "feature/texture", 0.1},
    {"transparency", kRaster, "feature/transparency", "feature/phong", 0.1},
    {"twoSided", kRaster, "showcase/teapot", "feature/point", 0.01},
    {"shadows", kRays, "feature/point", kWithoutLights, 0.1},
    {"reflection", kRays, "feature/mirror", "feature/phong", 0.1},
    {"refraction", kRays, "feature/refraction", "feature/mirror", 0.1},
    {"absorption", kRays, "feature/colored_shadow", "feature/mirror", 0.1},
    {"shapes", kRays, "feature/shapes", "feature/mipmaps", 0.1},
    {"triangles", kRays, "feature/texture", kWithoutMeshes, 0.1},
    {"turnedShapes", kRays, "feature/shapes", "feature/point", 0.1},
    {"fog", kRaster, "feature/fog_exp", "feature/point", 0.1},
    {"smoke", kRaster, "feature/smoke", "feature/point", 0.1},
    {"volumeScatter", kRays, "feature/volume_scatter", "feature/refraction", 0.1},
    {"environment", kRaster, "feature/environment", "feature/point", 0.1},
    {"softShadows", kRays, "feature/areaDisk", "feature/point", 0.01},
    {"dispersion", kRays, "feature/dispersion", "feature/refraction", 0.01, nullptr,
     [](RenderSettings& s) { s.dispersion = Dispersion::rgb; }},
    {"nestedMedia", kRays, "feature/nested_media", "feature/refraction", 0.01},
    {"coloredShadows", kRays, "feature/colored_shadow", "feature/point", 0.01, nullptr,
     [](RenderSettings& s) { s.coloredShadows = true; }},
    {"bumpMap", kRaster, "feature/bump_map", "feature/texture", 0.01},
    {"clearcoat", kRaster, "feature/clearcoat", "feature/point", 0.01},
    {"sheen", kRaster, "feature/sheen", "feature/point", 0.01},
    {"anisotropy", kRaster, "feature/anisotropy", "feature/point", 0.01},
    {"iridescence", kRaster, "feature/iridescence", "feature/point", 0.01},
    {"diffuseTransmission", kRaster, "feature/diffuse_transmission", "feature/point", 0.01},
    {"mipmaps", kRaster, "feature/mipmaps", "feature/texture", 0.01},
    {"specularLayer", kRaster, "feature/specular", "feature/point", 0.01},
    {"transmissionTexture", kRaster, "feature/transmission_texture", "feature/point", 0.01},
    {"diffuseRoughness", kRaster, "feature/diffuse_roughness", "feature/point", 0.01},
    {"angularSpecular", kRaster, "feature/angular_specular", "feature/phong", 0.01},
    {"exactFresnel", kRaster, "feature/cookTorrance1982", "feature/phong", 0.001},
    {"energyCompensation", kRaster, "feature/area_glossy", "feature/phong", 0.001, nullptr,
     [](RenderSettings& s) { s.energyCompensation = true; }},
};

const Row* rowOf(const std::string& effect) {
  const auto row = std::find_if(std::begin(kRows), std::end(kRows), [&](const Row& r) { return r.effect == effect; });
  return row == std::end(kRows) ? nullptr : &*row;
}

EffectVerdict verdictOn(const std::string& effect, const Scene& scene, const RenderSettings& settings) {
  const Plan plan = makePlan(scene, settings);
  for (const EffectVerdict& v : plan.verdicts) {
    if (v.name == effect) return v;
  }
  ADD_FAILURE() << "no verdict on " << effect;
  return {};
}

RenderSettings settingsOf(const Row& row) {
  RenderSettings settings = settingsFor(row.method, 48, 36);
  settings.lightSamples = 4;
  if (row.ask != nullptr) row.ask(settings);
  return settings;
}

class Necessary : public ::testing::TestWithParam<std::string> {};

TEST_P(Necessary, calledForByItsSceneAloneAndMissedWhereLeftOut) {
  const Row* row = rowOf(GetParam());
  ASSERT_NE(row, nullptr) << "name its scene, the scene beside it, and by how much it changes the picture";
  const Scene scene = row->make != nullptr ? row->make() : sceneNamed(row->scene);
  RenderSettings settings = settingsOf(*row);
  const EffectVerdict here = verdictOn(row->effect, scene, settings);
  EXPECT_TRUE(here.on) << here.reason;
  const EffectVerdict there = verdictOn(row->effect, neighborOf(*row), settings);
  EXPECT_FALSE(there.on) << there.reason;
  EXPECT_NE(here.reason, there.reason);
  const Image with = render(device(), scene, settings).image;
  settings.forcedEffects = {{row->effect, false}};
  const Image without = render(device(), scene, settings).image;
  const Difference d = largestDifference(with, without, [](std::uint32_t, std::uint32_t) { return true; });
  EXPECT_TRUE(d.maximum >= row->leastChange) << d;
}

INSTANTIATE_TEST_SUITE_P(Effects, Necessary, ::testing::ValuesIn(effectNames()), [](const auto& i) { return i.param; });

TEST(Necessary, tableNamesNothingElse) {
  const std::vector<std::string> names = effectNames();
  for (const Row& row : kRows) EXPECT_NE(std::find(names.begin(), names.end(), row.effect), names.end()) << row.effect;
}

// Counters of work for what is off: rays by type, levels of the ray tree, shadow maps, transparent fragments.
TEST(WorkNotDone, countersOfWhatIsOffAreZero) {
  const Scene plain = sceneNamed("feature/lambert");
  RenderSettings settings = settingsFor(kRays, 48, 36);
  RenderReport report = render(device(), plain, settings).report;
  for (const char* kind : {"reflection", "refraction", "passThrough"}) EXPECT_EQ(report.rays[kind], 0u) << kind;
  EXPECT_GT(report.rays["shadow"], 0u);
  EXPECT_EQ(report.counters["rayLevels"], 1u);
  settings.shadows = false;
  EXPECT_EQ(render(device(), plain, settings).report.rays["shadow"], 0u);

  report = render(device(), plain, settingsFor(kRaster, 48, 36)).report;
  EXPECT_EQ(report.counters["shadowMaps"], 0u);
  EXPECT_EQ(report.counters["transparentFragments"], 0u);
  EXPECT_EQ(report.counters["bvhNodes"], 0u);  // no ray is sent
  settings = settingsFor(kRaster, 48, 36);
  settings.rasterShadows = RasterShadows::maps;
  EXPECT_EQ(render(device(), withoutLights(), settings).report.counters["shadowMaps"], 0u);
  EXPECT_GT(render(device(), plain, settings).report.counters["shadowMaps"], 0u);
}

// Passes that no effect needs are not recorded: their spans are missing from the times on the device.
TEST(WorkNotDone, passesOfWhatIsOffAreMissing) {
  const auto passes = [](const char* scene, Method method) {
    std::set<std::string> names;
    const RenderResult result = render(device(), sceneNamed(scene), settingsFor(method, 48, 36));
    for (const auto& [name, ms] : result.report.gpuMs) names.insert(name);
    return names;
  };
  const std::set<std::string> plain = passes("feature/lambert", kRays);
  for (const char* pass : {"gather", "smoke", "soft shadow", "classify"}) EXPECT_FALSE(plain.contains(pass)) << pass;
  EXPECT_TRUE(plain.contains("shade"));
  EXPECT_TRUE(passes("feature/mirror", kRays).contains("gather"));
  EXPECT_TRUE(passes("feature/smoke", kRays).contains("smoke"));
  EXPECT_TRUE(passes("feature/areaDisk", kRays).contains("soft shadow"));
  EXPECT_FALSE(passes("feature/texture", kRays).contains("shapes"));
  EXPECT_TRUE(passes("feature/lambert", kRays).contains("shapes"));
}

// Lists on the device of what is off have one element: the full plan of the same scene holds more.
TEST(WorkNotDone, memoryOfWhatIsOffIsNotTaken) {
  const Scene scene = sceneNamed("feature/lambert");
  gpu::DeviceOptions options;
  options.validation = true;
  const auto bytes = [&](bool all) {
    gpu::Device fresh = gpu::Device::open(options);  // a peak is the device's
    RenderSettings settings = settingsFor(kRays, 48, 36);
    settings.allEffects = all;
    return render(fresh, scene, settings).report.deviceBytes;
  };
  EXPECT_LT(bytes(false), bytes(true));
}

}  // namespace
}  // namespace crosslight::testing

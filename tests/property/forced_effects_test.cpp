// --effects +name and -name, for every name of the lists: on where nothing calls for it changes no bit; off where
// something does is said, safe, and another picture.
#include <set>

#include "app/render_session.h"
#include "base/error.h"
#include "effects/effects.h"
#include "effects/forced.h"
#include "support/effect_scenes.h"

namespace crosslight::testing {
namespace {

struct Asked {
  std::string scene;
  RenderSettings settings;
};

bool isOn(const Scene& scene, const RenderSettings& settings, const std::string& name) {
  const Plan plan = makePlan(scene, settings);
  const auto found =
      std::find_if(plan.verdicts.begin(), plan.verdicts.end(), [&](const EffectVerdict& v) { return v.name == name; });
  return found != plan.verdicts.end() && found->on;
}

// What must be asked for by settings before a scene calls for it.
RenderSettings settingsThatAsk(Method method) {
  RenderSettings s = settingsFor(method, 32, 24);
  s.dispersion = Dispersion::rgb;
  s.coloredShadows = true;
  s.energyCompensation = true;
  s.lightSamples = 4;
  return s;
}

const std::vector<std::pair<std::string, Scene>>& featureScenes() {
  static const auto scenes = [] {
    std::vector<std::pair<std::string, Scene>> all;
    all.emplace_back("metallic-roughness texture", textured<&Material::metallicRoughnessTexture>());
    all.emplace_back("occlusion texture", textured<&Material::occlusionTexture>());
    all.emplace_back("emissive texture", textured<&Material::emissiveTexture>());
    all.emplace_back("glowing surface", glowing());
    for (const std::string& name : allSceneNames()) {
      if (name.rfind("feature/", 0) == 0) all.emplace_back(name, sceneNamed(name));
    }
    return all;
  }();
  return scenes;
}

class Forced : public ::testing::TestWithParam<std::string> {};

TEST_P(Forced, offIsSafeAndSaidAndChangesThePicture) {
  bool found = false, changed = false;
  for (const auto& [name, scene] : featureScenes()) {
    for (const Method method : {Method::phong, Method::whitted}) {
      RenderSettings settings = settingsThatAsk(method);
      if (changed || !isOn(scene, settings, GetParam())) continue;
      found = true;
      const Image plain = render(device(), scene, settings).image;
      settings.forcedEffects = {{GetParam(), false}};
      const RenderResult without = render(device(), scene, settings);
      changed = without.image.picture().samples != plain.picture().samples;
      bool said = false;
      for (const EffectRecord& e : without.report.effects) {
        if (e.name != GetParam()) continue;
        EXPECT_FALSE(e.on) << name;
        EXPECT_TRUE(e.leftOut) << name;
        said = e.reason.rfind("left out because asked: ", 0) == 0;
      }
      EXPECT_TRUE(said) << name << " by " << nameOf(method);
      EXPECT_EQ(without.report.nonfinite, 0u) << name << " by " << nameOf(method);
    }
  }
  EXPECT_TRUE(found) << "no feature scene calls for it";
  EXPECT_TRUE(changed) << "no feature scene shows it";
}

TEST_P(Forced, onChangesNoBit) {
  std::set<Method> tried;  // with one scene each
  for (const auto& [name, scene] : featureScenes()) {
    for (const Method method : {Method::phong, Method::whitted}) {
      RenderSettings settings = settingsFor(method, 32, 24);
      if (tried.contains(method) || isOn(scene, settings, GetParam())) continue;
      tried.insert(method);
      const Image plain = render(device(), scene, settings).image;
      settings.forcedEffects = {{GetParam(), true}};
      const RenderResult with = render(device(), scene, settings);
      const auto all = [](std::uint32_t, std::uint32_t) { return true; };
      EXPECT_TRUE(with.image.picture().samples == plain.picture().samples)
          << name << " by " << nameOf(method) << ": " << largestDifference(with.image, plain, all);
      EXPECT_TRUE(isOn(scene, settings, GetParam()));
    }
  }
  EXPECT_FALSE(tried.empty()) << "every feature scene calls for it";
}

INSTANTIATE_TEST_SUITE_P(Names, Forced, ::testing::ValuesIn(effectNames()), [](const auto& i) { return i.param; });

TEST(ForcedTogether, everythingOffDrawsTheBackground) {
  for (const char* name : {"feature/mirror", "feature/shapes", "feature/refraction"}) {
    const Scene scene = sceneNamed(name);
    for (const Method method : allMethods()) {
      RenderSettings settings = settingsFor(method, 32, 24);
      for (const std::string& effect : effectNames()) settings.forcedEffects.push_back({effect, false});
      const Image image = render(device(), scene, settings).image;
      for (std::uint32_t y = 0; y < 24; ++y) {
        for (std::uint32_t x = 0; x < 32; ++x) {
          for (int c = 0; c < 3; ++c)
            ASSERT_EQ(pixelAt(image, x, y)[static_cast<std::size_t>(c)], scene.atmosphere.background[c])
                << name << " by " << nameOf(method) << " at " << x << ", " << y;
        }
      }
    }
  }
}

// A session keeps what it made: forcing must not find what was made for another plan.
TEST(ForcedTogether, oneSessionDrawsEachPlanAsIfAlone) {
  RenderSession session(device());
  const auto scene = std::make_shared<const Scene>(sceneNamed("feature/shapes"));
  for (const Method method : {Method::phong, Method::whitted}) {
    RenderSettings settings = settingsFor(method, 32, 24);
    settings.rasterShadows = RasterShadows::rays;
    for (const std::vector<ForcedEffect>& forced : std::vector<std::vector<ForcedEffect>>{
             {{"shadows", false}}, {}, {{"triangles", false}}, {{"shapes", false}}, {}}) {
      settings.forcedEffects = forced;
      const Image alone = render(device(), *scene, settings).image;
      const Image kept = session.render({scene, settings}).image;
      EXPECT_TRUE(alone.picture().samples == kept.picture().samples) << nameOf(method);
    }
  }
}

TEST(ForcedTogether, unknownNameIsRefused) {
  RenderSettings settings = settingsFor(Method::phong, 8, 8);
  settings.forcedEffects = {{"fogg", false}};
  EXPECT_THROW(render(device(), sceneNamed("feature/phong"), settings), UsageError);
}

}  // namespace
}  // namespace crosslight::testing

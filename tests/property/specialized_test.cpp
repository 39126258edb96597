// Law 1: what a scene does not call for changes no bit; what it does call for changes the picture when it is left out.
#include "app/render_session.h"
#include "effects/effects.h"
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

struct Case {
  std::string scene;
  Method method;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene << " by " << nameOf(c.method); }

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::string& name : allSceneNames()) {
    if (name.rfind("feature/", 0) != 0) continue;
    for (const Method method : {Method::phong, Method::whitted}) all.push_back({name, method});
  }
  return all;
}

class Specialized : public ::testing::TestWithParam<Case> {};

TEST_P(Specialized, imageEqualsTheFullOneBitForBit) {
  const Scene scene = sceneNamed(GetParam().scene);
  RenderSettings settings = settingsFor(GetParam().method, 48, 36);
  const RenderResult specialized = render(device(), scene, settings);
  settings.allEffects = true;
  const RenderResult full = render(device(), scene, settings);
  const Difference d =
      largestDifference(specialized.image, full.image, [](std::uint32_t, std::uint32_t) { return true; });
  EXPECT_TRUE(specialized.image.picture().samples == full.image.picture().samples) << d;
  for (const EffectRecord& effect : specialized.report.effects) EXPECT_FALSE(effect.reason.empty()) << effect.name;
}

INSTANTIATE_TEST_SUITE_P(Features, Specialized, ::testing::ValuesIn(cases()), [](const auto& i) {
  std::string name = i.param.scene + "_" + nameOf(i.param.method);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

// Shadows and reflections of the raster methods: the same law, and the codes of a shown picture are those of its
// floats.
struct RasterOption {
  const char* name;
  void (*set)(RenderSettings&);
};
constexpr RasterOption kRasterOptions[] = {
    {"rays", [](RenderSettings& s) { s.rasterShadows = RasterShadows::rays; }},
    {"maps",
     [](RenderSettings& s) {
       s.rasterShadows = RasterShadows::maps;
       s.shadowMaps.size = 256;
     }},
    {"softMaps",
     [](RenderSettings& s) {
       s.rasterShadows = RasterShadows::maps;
       s.shadowMaps.size = 256;
       s.shadowMaps.soft = true;
       s.shadowMaps.lightRadius = 0.2;
     }},
};

class RasterOptions : public ::testing::TestWithParam<RasterOption> {};

TEST_P(RasterOptions, specializedEqualsFullAndShownEqualsFloats) {
  RenderSession session(device());
  for (const char* name : {"showcase/three_lights", "feature/alpha_mask", "feature/transparency", "feature/mirror",
                           "feature/spot_attenuation", "feature/texture"}) {
    const Scene scene = sceneNamed(name);
    for (const Method method : {Method::flat, Method::gouraud, Method::phong}) {
      RenderSettings settings = settingsFor(method, 48, 36);
      const Image plain = render(device(), scene, settings).image;
      GetParam().set(settings);
      const Image specialized = render(device(), scene, settings).image;
      settings.allEffects = true;
      const Image full = render(device(), scene, settings).image;
      settings.allEffects = false;
      const auto all = [](std::uint32_t, std::uint32_t) { return true; };
      EXPECT_TRUE(specialized.picture().samples == full.picture().samples)
          << name << " by " << nameOf(method) << ": " << largestDifference(specialized, full, all);
      RenderRequest request{std::shared_ptr<const Scene>(std::shared_ptr<const Scene>(), &scene), settings};
      request.shownBy = DisplayTransform{};
      EXPECT_TRUE(displayPicture(session.render(request).image, {}).codes == displayPicture(specialized, {}).codes)
          << name << " by " << nameOf(method);
      if (name == std::string("showcase/three_lights")) {
        EXPECT_FALSE(specialized.picture().samples == plain.picture().samples) << name << ": nothing is done";
      }
      session.forget(scene);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Options, RasterOptions, ::testing::ValuesIn(kRasterOptions),
                         [](const auto& i) { return std::string(i.param.name); });

// The same seed gives the same bits, run after run.
TEST(Determinism, secondRunGivesTheSameBits) {
  const Scene scene = sceneNamed("showcase/spheres_checker");
  RenderSettings settings = settingsFor(Method::whitted, 64, 48);
  settings.spp = 4;
  settings.seed = 7;
  const RenderResult first = render(device(), scene, settings);
  const RenderResult second = render(device(), scene, settings);
  EXPECT_TRUE(first.image.picture().samples == second.image.picture().samples);
  EXPECT_EQ(first.report.rays, second.report.rays);
  settings.seed = 8;
  EXPECT_FALSE(render(device(), scene, settings).image.picture().samples == first.image.picture().samples);
}

}  // namespace
}  // namespace crosslight::testing

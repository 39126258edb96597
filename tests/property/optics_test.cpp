// What is asked for by option (dispersion, shadows in color) and bodies within bodies: what is specialized, how rays
// are traced and in which order changes no bit; the option does.
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

struct OpticsCase {
  const char* scene;
  void (*set)(RenderSettings&);
  void (*unset)(RenderSettings&);
};
constexpr OpticsCase kCases[] = {
    {"feature/dispersion", [](RenderSettings& s) { s.dispersion = Dispersion::rgb; },
     [](RenderSettings& s) { s.dispersion = Dispersion::off; }},
    {"feature/colored_shadow", [](RenderSettings& s) { s.coloredShadows = true; },
     [](RenderSettings& s) { s.coloredShadows = false; }},
    {"feature/nested_media", [](RenderSettings&) {}, [](RenderSettings& s) { s.refraction = false; }},
    {"feature/smoke", [](RenderSettings& s) { s.smokeSteps = 8; }, [](RenderSettings& s) { s.smokeSteps = 16; }},
};

class Optics : public ::testing::TestWithParam<OpticsCase> {};

TEST_P(Optics, sameBitsWhateverTracesThem) {
  const Scene scene = sceneNamed(GetParam().scene);
  const auto drawn = [&](const std::function<void(RenderSettings&)>& change) {
    RenderSettings s = settingsFor(Method::whitted, 48, 36);
    GetParam().set(s);
    change(s);
    return render(device(), scene, s).image.picture().samples;
  };
  const auto plain = drawn([](RenderSettings&) {});
  EXPECT_TRUE(drawn([](RenderSettings&) {}) == plain);
  EXPECT_TRUE(drawn([](RenderSettings& s) { s.allEffects = true; }) == plain);
  EXPECT_TRUE(drawn([](RenderSettings& s) { s.kernel = KernelFamily::perLane; }) == plain);
  EXPECT_TRUE(drawn([](RenderSettings& s) { s.hitQueues = HitQueues::on; }) == plain);
  EXPECT_TRUE(drawn([](RenderSettings& s) { s.hitQueues = HitQueues::off; }) == plain);
  EXPECT_FALSE(drawn(GetParam().unset) == plain);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Optics, ::testing::ValuesIn(kCases),
                         [](const auto& i) { return std::string(i.param.scene).substr(8); });

}  // namespace
}  // namespace crosslight::testing

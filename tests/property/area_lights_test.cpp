// Laws that lights with an area must keep: what is specialized, how rays are traced and in which order changes no bit;
// the seed does where a shadow is soft.
#include "scene/emissive_lights.h"
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

std::vector<float> drawn(const Scene& scene, Method method, const std::function<void(RenderSettings&)>& change = {}) {
  RenderSettings s = settingsFor(method, 48, 36);
  if (change) change(s);
  return render(device(), scene, s).image.picture().samples;
}

TEST(EmissiveLights, specializedImageEqualsTheFullOne) {
  Scene scene = sceneNamed("feature/emission");
  ASSERT_GT(addEmissiveLights(scene, 4), 0u);
  for (const Method method : {Method::phong, Method::whitted}) {
    const auto full = drawn(scene, method, [](RenderSettings& s) { s.allEffects = true; });
    EXPECT_TRUE(drawn(scene, method) == full) << nameOf(method);
    EXPECT_FALSE(drawn(sceneNamed("feature/emission"), method) == full) << "they light nothing";
  }
}

const char* const kSoftScenes[] = {"feature/areaRectangle", "feature/areaSphere", "feature/environment"};

TEST(SoftShadows, sameSeedSameBitsWhateverTracesThem) {
  for (const char* name : kSoftScenes) {
    const Scene scene = sceneNamed(name);
    const auto plain = drawn(scene, Method::whitted);
    EXPECT_TRUE(drawn(scene, Method::whitted) == plain) << name;
    EXPECT_TRUE(drawn(scene, Method::whitted, [](RenderSettings& s) { s.kernel = KernelFamily::perLane; }) == plain)
        << name;
    EXPECT_TRUE(drawn(scene, Method::whitted, [](RenderSettings& s) { s.hitQueues = HitQueues::on; }) == plain) << name;
    EXPECT_FALSE(drawn(scene, Method::whitted, [](RenderSettings& s) { s.seed = 9; }) == plain) << name;
    EXPECT_FALSE(drawn(scene, Method::whitted, [](RenderSettings& s) { s.lightSamples = 0; }) == plain) << name;
  }
}

}  // namespace
}  // namespace crosslight::testing

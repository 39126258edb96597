// --effects within=E: something is left out, and the picture is off by no more than the bound, which is no more than E.
#include "effects/effects.h"
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

double largestError(const Scene& scene, const RenderSettings& settings) {
  RenderSettings exact = settings;
  exact.effectsWithin = 0;
  const auto all = [](std::uint32_t, std::uint32_t) { return true; };
  return largestDifference(render(device(), scene, settings).image, render(device(), scene, exact).image, all).maximum;
}

// Two facing mirrors between classic surfaces.
Scene mirrors(float factor) {
  Scene scene = sceneNamed("feature/mirror");
  for (Material& m : scene.materials) {
    if (m.classic.reflectionFactor != glm::vec3(0.0f) || m.name == "red")
      m.classic.reflectionFactor = glm::vec3(factor);
  }
  return scene;
}

TEST(Within, boundHoldsAndSomethingIsLeftOut) {
  int cuts = 0, whole = 0;
  for (const float factor : {0.02f, 0.3f, 0.9f}) {
    const Scene scene = mirrors(factor);
    for (const double within : {0.5, 0.05, 0.005}) {
      RenderSettings settings = settingsFor(Method::whitted, 64, 48);
      settings.effectsWithin = within;
      const Plan plan = makePlan(scene, settings);
      EXPECT_LE(plan.bound, within) << plan.depthReason;
      const double error = largestError(scene, settings);
      EXPECT_TRUE(error <= plan.bound) << error << " above " << plan.bound << ": " << plan.depthReason;
      if (plan.bound == 0) continue;
      ++cuts;
      EXPECT_LT(plan.maxDepth, settings.maxDepth);
      whole += plan.has(Effect::reflection) ? 0 : 1;
    }
  }
  EXPECT_GE(cuts, 3);
  EXPECT_GE(whole, 1) << "reflection is never left out as a whole";
}

TEST(Within, nothingIsLeftOutWithoutABound) {
  for (const char* name : {"feature/refraction", "feature/smoke", "feature/environment", "showcase/spheres_checker"}) {
    RenderSettings settings = settingsFor(Method::whitted, 32, 24);
    settings.effectsWithin = 0.5;
    const Plan plan = makePlan(sceneNamed(name), settings);
    EXPECT_EQ(plan.bound, 0.0) << name << ": " << plan.depthReason;
  }
}

}  // namespace
}  // namespace crosslight::testing

// What is compiled serves every scene that calls for the same effects: switching between such scenes makes no pipeline.
#include <set>
#include <tuple>

#include "app/render_session.h"
#include "effects/effects.h"
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint64_t, std::size_t>;

// Fragments are lit in a loop over few lights whose count is known.
Key keyOf(const Scene& scene, const RenderSettings& settings) {
  const Plan plan = makePlan(scene, settings);
  return {plan.models, plan.lights, plan.shapes, plan.effects, scene.lights.size()};
}

// Packets of rays that give up are traced again one by one, by kernels that are made when the first one does.
RenderSettings settingsOf(Method method) {
  RenderSettings settings = settingsFor(method, 24, 18);
  settings.kernel = KernelFamily::perLane;
  return settings;
}

std::string namesOf(const std::vector<gpu::PipelineMaking>& makings) {
  std::string names;
  for (const gpu::PipelineMaking& making : makings) names += " " + making.name;
  return names;
}

struct Session {
  Session() : own(gpu::Device::open(validated())), session(own) {}

  static gpu::DeviceOptions validated() {
    gpu::DeviceOptions options;
    options.validation = true;
    return options;
  }

  // The pipelines that it made.
  std::vector<gpu::PipelineMaking> draw(const std::shared_ptr<const Scene>& scene, const RenderSettings& settings) {
    own.takePipelineMakings();
    session.render({scene, settings});
    return own.takePipelineMakings();
  }

  gpu::Device own;  // nobody else's pipelines
  RenderSession session;
};

class SamePlan : public ::testing::TestWithParam<Method> {};

TEST_P(SamePlan, compilesNothing) {
  Session one;
  const RenderSettings settings = settingsOf(GetParam());
  std::map<Key, std::vector<std::string>> scenes;
  for (const std::string& name : allSceneNames()) scenes[keyOf(sceneNamed(name), settings)].push_back(name);
  std::size_t switched = 0;
  for (const auto& [key, names] : scenes) {
    if (names.size() < 2) continue;
    const std::size_t made = one.draw(std::make_shared<const Scene>(sceneNamed(names[0])), settings).size();
    EXPECT_LT(0u, made) << names[0];
    const auto again = one.draw(std::make_shared<const Scene>(sceneNamed(names[1])), settings);
    EXPECT_TRUE(again.empty()) << names[1] << " after " << names[0] << " makes" << namesOf(again);
    ++switched;
  }
  EXPECT_LE(2u, switched) << "no scenes of the same plan";
}

// Another plan between them does not push the first one's pipelines out.
TEST_P(SamePlan, isKeptWhileOthersAreDrawn) {
  Session one;
  const RenderSettings settings = settingsOf(GetParam());
  const auto a = std::make_shared<const Scene>(sceneNamed("feature/point"));
  const auto b = std::make_shared<const Scene>(sceneNamed("feature/fog_exp"));
  ASSERT_NE(keyOf(*a, settings), keyOf(*b, settings));
  EXPECT_FALSE(one.draw(a, settings).empty());
  EXPECT_FALSE(one.draw(b, settings).empty());
  const auto again = one.draw(a, settings);
  EXPECT_TRUE(again.empty()) << namesOf(again);
}

INSTANTIATE_TEST_SUITE_P(Methods, SamePlan,
                         ::testing::Values(Method::flat, Method::gouraud, Method::phong, Method::whitted),
                         [](const auto& i) { return std::string(nameOf(i.param)); });

}  // namespace
}  // namespace crosslight::testing

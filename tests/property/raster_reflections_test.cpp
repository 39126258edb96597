// Mirrors of the raster methods: what is specialized changes no bit, bands and batches neither, and without mirrors
// nothing is drawn for them.
#include "app/render_session.h"
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

RenderSettings reflecting(Method method, RasterReflections reflections) {
  RenderSettings s = settingsFor(method, 64, 48);
  s.rasterReflections = reflections;
  s.probeSize = 32;
  return s;
}

TEST(RasterReflections, specializedImageEqualsTheFullOne) {
  using enum RasterReflections;
  const std::pair<const char*, RasterReflections> cases[] = {{"feature/flat_mirror", mirrors},
                                                             {"feature/flat_mirror", probes},
                                                             {"feature/mirror", environment},
                                                             {"feature/alpha_blend", mirrors}};
  for (const auto& [name, how] : cases) {
    const Scene scene = sceneNamed(name);
    for (const Method method : {Method::gouraud, Method::phong}) {
      RenderSettings s = reflecting(method, how);
      const auto lean = render(device(), scene, s).image.picture().samples;
      s.allEffects = true;
      EXPECT_TRUE(render(device(), scene, s).image.picture().samples == lean) << name << " " << nameOf(method);
    }
  }
}

TEST(RasterReflections, drawNothingForScenesWithoutMirrors) {
  const Scene scene = sceneNamed("feature/alpha_blend");
  RenderSettings s = reflecting(Method::phong, RasterReflections::mirrors);
  const RenderResult with = render(device(), scene, s);
  s.rasterReflections = RasterReflections::off;
  EXPECT_TRUE(render(device(), scene, s).image.picture().samples == with.image.picture().samples);
  EXPECT_EQ(with.report.counters.at("mirrorPictures"), 0u);
  EXPECT_EQ(with.report.counters.at("probes"), 0u);
}

TEST(RasterReflections, countWhatTheyDraw) {
  const auto counted = [](const char* scene, RasterReflections how) {
    const auto counters = render(device(), sceneNamed(scene), reflecting(Method::phong, how)).report.counters;
    return std::pair(counters.at("mirrorPictures"), counters.at("probes"));
  };
  using Counts = std::pair<std::uint64_t, std::uint64_t>;
  EXPECT_EQ(counted("feature/flat_mirror", RasterReflections::mirrors), Counts(1, 0));
  EXPECT_EQ(counted("feature/flat_mirror", RasterReflections::probes), Counts(0, 1));
  EXPECT_EQ(counted("feature/mirror", RasterReflections::mirrors), Counts(0, 1));
  EXPECT_EQ(counted("feature/mirror", RasterReflections::environment), Counts(0, 0));
}

TEST(RasterReflections, keepTheLargestMirrors) {
  Scene scene = sceneNamed("feature/flat_mirror");
  const auto wall = std::find_if(scene.instances.begin(), scene.instances.end(),
                                 [](const MeshInstance& i) { return i.name == "looking glass"; });
  ASSERT_NE(wall, scene.instances.end());
  const MeshInstance first = *wall;
  for (int i = 1; i < 6; ++i) {  // behind each other, smaller and smaller
    MeshInstance more = first;
    more.instanceId = scene.instanceCount++;
    more.worldFromObject = glm::dmat4(glm::dmat3(1.0 - 0.1 * i));
    more.worldFromObject[3] = {0.0, 0.0, -0.3 * i, 1.0};
    scene.instances.push_back(more);
  }
  const auto counters = render(device(), scene, reflecting(Method::phong, RasterReflections::mirrors)).report.counters;
  EXPECT_EQ(counters.at("mirrorPictures"), 4u);
  EXPECT_EQ(counters.at("probes"), 0u);
}

TEST(RasterReflections, rowsByThemselvesAreThoseOfTheWhole) {
  RenderRequest request{nullptr, {}};
  request.scene = std::make_shared<Scene>(sceneNamed("feature/flat_mirror"));
  request.settings = reflecting(Method::phong, RasterReflections::mirrors);
  const auto whole = render(device(), *request.scene, request.settings).image.picture().samples;
  request.rows = {{16, 16}};
  RenderSession session(device());
  const auto part = session.render(request).image.picture().samples;
  ASSERT_EQ(part.size(), std::size_t{4} * 64 * 16);
  EXPECT_TRUE(std::equal(part.begin(), part.end(), whole.begin() + 4 * 64 * 16));
}

}  // namespace
}  // namespace crosslight::testing

// Adaptive sampling: what it leaves out was known well enough, what it keeps has the bits of the whole.
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

constexpr std::uint32_t kWidth = 100, kHeight = 70;  // the last tiles overhang

RenderSettings settingsOf(Method method, std::uint32_t spp, float error) {
  RenderSettings s = settingsFor(method, kWidth, kHeight);
  s.spp = spp;
  s.adaptiveError = error;
  return s;
}

double rmseOf(const Image& a, const Image& b) {
  const std::vector<float>&p = a.picture().samples, &q = b.picture().samples;
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    sum += (static_cast<double>(p[i]) - q[i]) * (static_cast<double>(p[i]) - q[i]);
  return std::sqrt(sum / static_cast<double>(p.size()));
}

class Adaptive : public ::testing::TestWithParam<Method> {};

// No tile that shows an edge is ever good enough, and those without an edge have nothing to gain.
TEST_P(Adaptive, withNoErrorAllowedHasTheMeansOfAllSamples) {
  const Scene scene = sceneNamed("showcase/spheres_checker");
  const RenderResult all = render(device(), scene, settingsOf(GetParam(), 16, 0.0f));
  const RenderResult adaptive = render(device(), scene, settingsOf(GetParam(), 16, 1e-30f));
  EXPECT_LE(rmseOf(all.image, adaptive.image), 1e-7) << "tiles of one color throughout may stop";
  EXPECT_GT(adaptive.report.counters.at("samples"), all.report.counters.at("samples") / 2);
}

TEST_P(Adaptive, leavesOutWhatIsKnownWellEnough) {
  const Scene scene = sceneNamed("showcase/teapot");
  constexpr float kError = 0.02f;
  const RenderResult reference = render(device(), scene, settingsOf(GetParam(), 256, 0.0f));
  const RenderResult adaptive = render(device(), scene, settingsOf(GetParam(), 64, kError));
  const std::uint64_t pixels = std::uint64_t{kWidth} * kHeight;
  EXPECT_LT(adaptive.report.counters.at("samples"), 64 * pixels * 3 / 4);
  EXPECT_GE(adaptive.report.counters.at("samples"), 8 * pixels);
  EXPECT_LE(rmseOf(reference.image, adaptive.image), kError);
}

TEST_P(Adaptive, secondRunHasTheSameBits) {
  const Scene scene = sceneNamed("showcase/three_lights");
  const RenderSettings s = settingsOf(GetParam(), 32, 0.01f);
  const RenderResult first = render(device(), scene, s), second = render(device(), scene, s);
  EXPECT_EQ(first.image.picture().samples, second.image.picture().samples);
  EXPECT_EQ(first.report.counters.at("samples"), second.report.counters.at("samples"));
}

TEST_P(Adaptive, recordsOfPixelsCentersAreThoseOfEverySampling) {
  const Scene scene = sceneNamed("showcase/spheres_checker");
  RenderSettings s = settingsOf(GetParam(), 16, 0.05f);
  s.aovs = {"depth", "instanceId", "albedo"};
  const Image adaptive = render(device(), scene, s).image;
  s.adaptiveError = 0;
  const Image all = render(device(), scene, s).image;
  EXPECT_EQ(adaptive.find("depth")->samples, all.find("depth")->samples);
  EXPECT_EQ(adaptive.find("instanceId")->integers, all.find("instanceId")->integers);
}

INSTANTIATE_TEST_SUITE_P(Each, Adaptive, ::testing::Values(Method::phong, Method::whitted),
                         [](const auto& i) { return std::string(nameOf(i.param)); });

// Rays of tiles that have enough are not made at all.
TEST(AdaptiveRays, areMadeForTheSamplesAlone) {
  const Scene scene = sceneNamed("showcase/spheres_checker");
  const RenderResult r = render(device(), scene, settingsOf(Method::whitted, 64, 0.05f));
  EXPECT_EQ(r.report.rays.at("primary"), r.report.counters.at("samples"));
}

}  // namespace
}  // namespace crosslight::testing

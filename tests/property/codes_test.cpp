// A raster picture that is only shown is drawn as 8-bit codes: each equals what the display transform makes of the
// picture drawn in floats, in every scene, by every method, whatever the exposure. Rarer settings see the scenes that
// are not made for a single feature.
#include <algorithm>

#include "app/render_session.h"
#include "raster/raster.h"
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

// The session borrows the scene.
RenderResult shown(RenderSession& session, const Scene& scene, const RenderSettings& settings,
                   const DisplayTransform& display) {
  RenderRequest request{std::shared_ptr<const Scene>(std::shared_ptr<const Scene>(), &scene), settings};
  request.shownBy = display;
  return session.render(request);
}

struct Variant {
  const char* name;
  void (*set)(RenderSettings&);
  bool everyScene = false;
};
constexpr Variant kVariants[] = {{"flat", [](RenderSettings& s) { s.method = Method::flat; }, true},
                                 {"flatLastTwoSided",
                                  [](RenderSettings& s) {
                                    s.method = Method::flat;
                                    s.flatVertex = FlatVertex::last;
                                    s.twoSided = TwoSided::always;
                                  }},
                                 {"flatCentroid",
                                  [](RenderSettings& s) {
                                    s.method = Method::flat;
                                    s.flatVertex = FlatVertex::centroid;
                                  }},
                                 {"flatClamped",
                                  [](RenderSettings& s) {
                                    s.method = Method::flat;
                                    s.clampVertexColors = true;
                                  }},
                                 {"gouraud", [](RenderSettings& s) { s.method = Method::gouraud; }, true},
                                 {"gouraudClampedTwoSided",
                                  [](RenderSettings& s) {
                                    s.method = Method::gouraud;
                                    s.clampVertexColors = true;
                                    s.twoSided = TwoSided::always;
                                  }},
                                 {"phong", [](RenderSettings& s) { s.method = Method::phong; }, true}};

std::size_t differences(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  if (a.size() != b.size()) return std::max(a.size(), b.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] == b[i] ? 0 : 1;
  return count;
}

class Codes : public ::testing::TestWithParam<Variant> {};

TEST_P(Codes, equalTheDisplayTransformOfTheFloats) {
  RenderSession session(device());
  RenderSettings settings = settingsFor(Method::flat, 64, 48);
  GetParam().set(settings);
  std::size_t drawnAsCodes = 0, drawn = 0;
  for (const std::string& name : allSceneNames()) {
    if (!GetParam().everyScene && name.rfind("feature/", 0) == 0) continue;
    const Scene scene = sceneNamed(name);
    const Image floats = render(device(), scene, settings).image;
    for (const float stops : {0.0f, -1.3f, 2.0f}) {
      const DisplayTransform display{.toneMap = ToneMap::clamp, .exposureStops = stops};
      const RenderResult result = shown(session, scene, settings, display);
      const bool codes = !result.image.shownCodes.empty();
      EXPECT_EQ(codes, canDrawCodes(makePlan(scene, settings), settings)) << name;
      drawnAsCodes += codes ? 1 : 0;
      ++drawn;
      EXPECT_EQ(differences(displayPicture(result.image, display).codes, displayPicture(floats, display).codes), 0u)
          << name << ", " << stops << " stops";
    }
    session.forget(scene);
  }
  EXPECT_GT(2 * drawnAsCodes, drawn) << "nearly all were drawn in floats: nothing was compared";
}
INSTANTIATE_TEST_SUITE_P(Methods, Codes, ::testing::ValuesIn(kVariants),
                         [](const auto& variant) { return std::string(variant.param.name); });

// Through targets that are copied into the film, and strips.
TEST(CodesOf, someRowsEqualThoseOfTheWhole) {
  const Scene scene = sceneNamed("stress/thin_triangles");
  RenderSession session(device());
  const RenderSettings settings = settingsFor(Method::gouraud, 160, 120);
  const std::vector<std::uint8_t> whole = shown(session, scene, settings, {}).image.shownCodes;
  ASSERT_EQ(whole.size(), 3u * 160 * 120);
  RenderRequest request{std::shared_ptr<const Scene>(std::shared_ptr<const Scene>(), &scene), settings};
  request.shownBy = DisplayTransform{};
  std::vector<std::uint8_t> parts;
  for (const Band& rows : {Band{0, 41}, Band{41, 79}}) {
    request.rows = {rows};
    const std::vector<std::uint8_t> part = session.render(request).image.shownCodes;
    parts.insert(parts.end(), part.begin(), part.end());
  }
  EXPECT_EQ(differences(parts, whole), 0u);
}

TEST(CodesOf, aPictureAreNotMadeWhereFloatsAreNeeded) {
  const Scene scene = sceneNamed("feature/directional");
  RenderSession session(device());
  const RenderSettings plain = settingsFor(Method::phong, 16, 12);
  ASSERT_FALSE(shown(session, scene, plain, {}).image.shownCodes.empty());
  const auto inFloats = [&](RenderSettings settings, const DisplayTransform& display) {
    return shown(session, scene, settings, display).image.shownCodes.empty();
  };
  EXPECT_TRUE(inFloats(plain, {.toneMap = ToneMap::reinhard}));
  EXPECT_TRUE(inFloats(plain, {.withAlpha = true}));
  RenderSettings settings = plain;
  settings.spp = 2;
  EXPECT_TRUE(inFloats(settings, {}));
  settings = plain;
  settings.aovs = {"depth"};
  EXPECT_TRUE(inFloats(settings, {}));
  settings = plain;
  settings.allowNonfinite = true;
  EXPECT_TRUE(inFloats(settings, {}));
  settings = plain;
  settings.method = Method::whitted;
  EXPECT_TRUE(inFloats(settings, {}));
  settings.method = Method::wireframe;
  EXPECT_TRUE(inFloats(settings, {}));
}

}  // namespace
}  // namespace crosslight::testing

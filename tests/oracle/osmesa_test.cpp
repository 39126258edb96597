// Gouraud and flat shading against OpenGL's own fixed function (OSMesa, test-only): the same triangles, materials and
// lights, lit by code that is not ours. OpenGL's model is Blinn-Phong with N.H, specular gated by N.L > 0.
#include <set>
#include <tuple>

#include "oracle/compare_fixed_function.h"

namespace crosslight::testing {
namespace {

constexpr std::uint32_t kWidth = 256, kHeight = 192;
const char* const kSphere = "analytic/exercise_blinn_phong";
const char* const kTeapot = "showcase/teapot";

struct Draw {
  bool flat = false;
  bool localViewer = true;
  bool clampColors = false;
};

RenderSettings settingsOf(const Draw& draw) {
  RenderSettings s = settingsFor(draw.flat ? Method::flat : Method::gouraud, kWidth, kHeight);
  s.flatVertex = FlatVertex::last;
  s.infiniteViewer = !draw.localViewer;
  s.clampVertexColors = draw.clampColors;
  s.aovs = {"instanceId", "primitiveId"};
  return s;
}

FixedFunctionImage openGl(const Scene& scene, const Draw& draw) {
  return drawFixedFunction(scene, {kWidth, kHeight, draw.flat, draw.localViewer, draw.clampColors});
}

Comparison compareWith(const Draw& theirs, const Scene& scene, const RenderSettings& ours) {
  return compare(render(device(), scene, ours).image, openGl(scene, theirs), scene);
}

using Case = std::tuple<const char*, LightType, bool, bool>;  // scene, lights, flat, local viewer

class FixedFunction : public ::testing::TestWithParam<Case> {};

TEST_P(FixedFunction, lightsVerticesAsWeDo) {
  const auto& [name, type, flat, localViewer] = GetParam();
  const Draw draw{flat, localViewer, false};
  const Scene scene = sceneLitBy(name, type);
  expectAgreement(compareWith(draw, scene, settingsOf(draw)));
}

std::string caseName(const ::testing::TestParamInfo<Case>& info) {
  const auto& [name, type, flat, localViewer] = info.param;
  const char* lights = type == LightType::point ? "point" : type == LightType::spot ? "spot" : "directional";
  return std::string(name == kSphere ? "sphere_" : "teapot_") + lights + (flat ? "_flat" : "_smooth") +
         (localViewer ? "_local" : "_infinite");
}

INSTANTIATE_TEST_SUITE_P(Each, FixedFunction,
                         ::testing::Combine(::testing::Values(kSphere, kTeapot),
                                            ::testing::Values(LightType::directional, LightType::point,
                                                              LightType::spot),
                                            ::testing::Bool(), ::testing::Bool()),
                         caseName);

// Half of the sphere, seen from inside: OpenGL lights a back face with the normal turned round.
TEST(FixedFunctionSides, insideOfAHalfSphereIsLitFromInside) {
  Scene scene = sceneLitBy(kSphere, LightType::point);
  std::vector<std::uint32_t>& indices = scene.meshes.at(0).primitives.at(0).indices;
  const std::vector<glm::vec3>& positions = scene.meshes.at(0).primitives.at(0).positions;
  std::vector<std::uint32_t> lower;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const bool below = positions[indices[i]].y + positions[indices[i + 1]].y + positions[indices[i + 2]].y < 0;
    if (below) lower.insert(lower.end(), {indices[i], indices[i + 1], indices[i + 2]});
  }
  indices = lower;
  for (Material& m : scene.materials) m.doubleSided = true;
  for (const bool flat : {false, true}) {
    const Draw draw{flat, true, false};
    expectAgreement(compareWith(draw, scene, settingsOf(draw)));
  }
}

class ClampedColors : public ::testing::TestWithParam<bool> {};

// Lights twice as strong: the highlights' vertices exceed 1 and are cut before they are interpolated.
TEST_P(ClampedColors, equalOpenGlsWhereTheyShow) {
  for (const char* name : {kSphere, kTeapot}) {
    const Scene scene = sceneLitBy(name, LightType::point, 2.0f);
    const Draw clamped{GetParam(), true, true};
    const Comparison same = compareWith(clamped, scene, settingsOf(clamped));
    expectAgreement(same);
    EXPECT_LE(same.peak, 1.0 + 1e-6) << "interpolation alone may exceed what it interpolates, by rounding";
    const Comparison unlike = compareWith(clamped, scene, settingsOf({GetParam(), true, false}));
    EXPECT_GT(unlike.rmse, kWrongRmse) << "without the clamp: " << unlike;
  }
}

INSTANTIATE_TEST_SUITE_P(Each, ClampedColors, ::testing::Bool(),
                         [](const auto& i) { return std::string(i.param ? "flat" : "smooth"); });

// The centroid is no vertex of OpenGL's; its color is clamped all the same.
TEST(ClampedColorsOurs, centroidIsClampedToo) {
  const Scene scene = sceneLitBy(kSphere, LightType::point, 2.0f);
  RenderSettings s = settingsOf({true, true, false});
  s.flatVertex = FlatVertex::centroid;
  Image free = render(device(), scene, s).image;
  s.clampVertexColors = true;
  const Image clamped = render(device(), scene, s).image;
  const std::vector<float> before = free.picture().samples;
  for (float& v : free.picture().samples) v = std::min(v, 1.0f);
  EXPECT_NE(before, free.picture().samples) << "nothing exceeds 1: the test shows nothing";
  EXPECT_EQ(clamped.picture().samples, free.picture().samples);
}

// GL_MODULATE: the texture multiplies the clamped color. Where nothing exceeds 1 and there is no specular part, that
// is what lighting the textured surface gives; float rounding is all that differs.
TEST(ClampedColorsOurs, texturesMultiplyTheClampedColor) {
  Scene scene = sceneLitBy("feature/texture", LightType::directional, 0.4f);
  for (Material& m : scene.materials) {
    m.model = IlluminationModel::lambert;
    m.classic.ambientFactor = m.classic.diffuseFactor = glm::vec3(0.7f);
    m.emissiveFactor = glm::vec3(0.0f);
  }
  RenderSettings s = settingsOf({});
  const Image free = render(device(), scene, s).image;
  s.clampVertexColors = true;
  const Image clamped = render(device(), scene, s).image;
  const Difference d = largestDifference(free, clamped, [](std::uint32_t, std::uint32_t) { return true; });
  EXPECT_TRUE(d.maximum <= 1e-6) << d;  // a product of three factors below 1, taken in another order
  std::set<float> reds;
  for (std::size_t i = 0; i < clamped.picture().samples.size(); i += 4) reds.insert(clamped.picture().samples[i]);
  EXPECT_GT(reds.size(), 10u) << "no texture shows";
}

// The comparison is sharp enough to tell the conventions apart.
TEST(FixedFunctionTells, rDotVFromNDotH) {
  Scene scene = sceneLitBy(kSphere, LightType::point);
  const FixedFunctionImage theirs = openGl(scene, {});
  for (Material& m : scene.materials) m.model = IlluminationModel::phong;
  const Comparison c = compare(render(device(), scene, settingsOf({})).image, theirs, scene);
  EXPECT_GT(c.rmse, kWrongRmse) << c;
}

TEST(FixedFunctionTells, firstVertexFromLast) {
  const Scene scene = sceneLitBy(kSphere, LightType::point);
  RenderSettings s = settingsOf({true, true, false});
  s.flatVertex = FlatVertex::first;
  const Comparison c = compareWith({true, true, false}, scene, s);
  EXPECT_GT(c.rmse, kWrongRmse) << c;
}

TEST(FixedFunctionTells, localFromInfiniteViewer) {
  const Scene scene = sceneLitBy(kSphere, LightType::directional);
  const Comparison c = compareWith({false, true, false}, scene, settingsOf({false, false, false}));
  EXPECT_GT(c.rmse, kWrongRmse) << c;
}

}  // namespace
}  // namespace crosslight::testing

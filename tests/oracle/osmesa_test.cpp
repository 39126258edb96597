// Gouraud and flat shading against OpenGL's own fixed function (OSMesa, test-only): the same triangles, materials and
// lights, lit by code that is not ours. OpenGL's model is Blinn-Phong with N.H, specular gated by N.L > 0.
#include <glm/geometric.hpp>
#include <set>
#include <tuple>

#include "oracle/fixed_function.h"
#include "structs.h"
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

constexpr std::uint32_t kWidth = 256, kHeight = 192;
const char* const kSphere = "analytic/exercise_blinn_phong";
const char* const kTeapot = "showcase/teapot";

// What is left between two float pipelines. A vertex's color goes through about twelve roundings on its way to N.L and
// N.H (two transforms, three normalisations): gamma_12 = 7e-7 of it. The exponent multiplies that by n, 77 for the
// teapot's bronze, but in the few pixels of a highlight only; squared and averaged it stays below the diffuse part's
// share of 1e-6. Twice that holds; 3.3e-7 was measured (llvmpipe on both sides, 2026-11-22).
constexpr double kSoftwareRmse = 2e-6;
// Hardware snaps vertices and interpolates on grids of its own, 1/256 pixel at best: what OSMesa itself shows against
// the exact image of the mesh, 1.3e-3, is what such a grid costs.
constexpr double kHardwareRmse = 2e-3;
// A convention taken the other way (R.V for N.H, the first vertex for the last, a local viewer for an infinite one)
// shows by at least this: five hundred times what is allowed, so that the tests above can fail.
constexpr double kWrongRmse = 1e-3;
constexpr double kSameTriangle = 0.999;  // of interior pixels

double allowedRmse() { return device().info().isSoftware ? kSoftwareRmse : kHardwareRmse; }

// Directions are askew, so that no vertex of a symmetric mesh lies on the terminator, where the last bit decides
// whether a highlight is cut off. Positions reach about 2 from the origin; cones of 12 degrees show their edge there.
Light lightFrom(LightType type, const glm::dvec3& towards, double distance, float strength) {
  Light light;
  light.type = type;
  light.worldPosition = glm::normalize(towards) * distance;
  light.worldDirection = -glm::normalize(towards);
  ClassicLight c;
  c.ambient = glm::vec3(0.02f, 0.03f, 0.05f) * strength;
  c.diffuse = glm::vec3(0.7f, 0.6f, 0.5f) * strength;
  c.specular = glm::vec3(0.5f, 0.6f, 0.7f) * strength;
  if (type != LightType::directional) c.attenuation = {0.4f, 0.03f, 0.002f};
  if (type == LightType::spot) c.spotExponent = 3.0f, c.spotCutoff = 12.0f;
  light.classic = c;
  return light;
}

Scene sceneLitBy(const std::string& name, LightType type, float strength = 1.0f) {
  Scene scene = sceneNamed(name);
  for (MeshInstance& instance : scene.instances) instance.replacedByShape = false;
  scene.shapes.clear();
  scene.lights = {lightFrom(type, {0.43, 0.77, 0.59}, 9.0, strength),
                  lightFrom(type, {-0.71, 0.53, 0.37}, 11.0, strength)};
  return scene;
}

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

// First triangle of each instance in the numbering of the oracle.
std::vector<std::uint32_t> firstTriangles(const Scene& scene) {
  std::vector<std::uint32_t> first(scene.instanceCount, 0);
  std::uint32_t next = 0;
  for (const MeshInstance& instance : scene.instances) {
    first[instance.instanceId] = next;
    for (const Primitive& p : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
      next += static_cast<std::uint32_t>(p.indices.size() / 3);
    }
  }
  return first;
}

struct Comparison {
  double rmse = 0;             // over the interior pixels that show the same triangle
  std::size_t interior = 0;    // pixels whose 3x3 neighbourhood shows one object
  std::size_t same = 0;        // of these, those that show the same triangle in both
  double peak = 0;             // largest value of ours
  std::uint32_t x = 0, y = 0;  // where they differ most
  double worst = 0;
};

std::ostream& operator<<(std::ostream& out, const Comparison& c) {
  return out << "RMSE " << c.rmse << ", worst " << c.worst << " at (" << c.x << ", " << c.y << "), same triangle in "
             << c.same << " of " << c.interior << " interior pixels, peak " << c.peak;
}

void addPixel(Comparison& c, const std::array<float, 4>& ours, const std::array<float, 4>& theirs, std::uint32_t x,
              std::uint32_t y) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double d = std::abs(static_cast<double>(ours[k]) - theirs[k]);
    c.rmse += d * d;  // the sum for now
    c.peak = std::max(c.peak, static_cast<double>(ours[k]));
    if (!(d <= c.worst)) c.worst = d, c.x = x, c.y = y;
  }
}

Comparison compare(const Image& ours, const FixedFunctionImage& theirs, const Scene& scene) {
  const Interior isInterior(ours);
  const std::vector<std::uint32_t> first = firstTriangles(scene);
  const std::vector<std::uint32_t>& primitives = ours.find("primitiveId")->integers;
  Comparison c;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const std::uint32_t id = isInterior.idAt(x, y);
      if (!isInterior(x, y) || id == shared::kNoId) continue;
      const std::size_t at = std::size_t{y} * kWidth + x;
      ++c.interior;
      if (first[id] + primitives[at] != theirs.triangle[at]) continue;
      ++c.same;
      addPixel(c, pixelAt(ours, x, y), theirs.color[at], x, y);
    }
  }
  c.rmse = std::sqrt(c.rmse / static_cast<double>(3 * c.same));
  return c;
}

Comparison compareWith(const Draw& theirs, const Scene& scene, const RenderSettings& ours) {
  return compare(render(device(), scene, ours).image, openGl(scene, theirs), scene);
}

void expectAgreement(const Comparison& c) {
  ::testing::Test::RecordProperty("rmse", std::to_string(c.rmse));
  EXPECT_GT(c.interior, 4000u) << c;
  EXPECT_TRUE(static_cast<double>(c.same) >= kSameTriangle * static_cast<double>(c.interior)) << c;
  EXPECT_TRUE(c.rmse <= allowedRmse()) << c << "; float rounding in two pipelines explains " << allowedRmse();
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

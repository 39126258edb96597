// `--lighting opengl` against OpenGL: sphere, teapot and torus under the parameters of glLight, glMaterial,
// glLightModel, glShadeModel and glFog.
#include <fmt/format.h>

#include <map>
#include <set>

#include "app/lighting_preset.h"
#include "oracle/compare_fixed_function.h"
#include "scene/shape_mesh.h"

namespace crosslight::testing {
namespace {

constexpr std::uint32_t kWidth = 256, kHeight = 192;
// Fog's factor is computed by Mesa with its own exp2, exact to some 2e-6 at most (an interpolated polynomial in
// llvmpipe's gallivm); it multiplies colors below 1.
constexpr double kFogRmse = 5e-6;

const glm::dvec3 kLeft(-0.71, 0.53, 0.37), kRight(0.43, 0.77, 0.59), kAbove(0.11, 0.93, 0.67);

struct Setting {
  std::string name;
  std::vector<std::pair<LightType, glm::dvec3>> lights;
  bool flat = false;
  bool localViewer = false;
  bool halved = false;  // only half of the mesh, whose inside shows, lit from both sides
  FogMode fog = FogMode::none;
};
void PrintTo(const Setting& s, std::ostream* out) { *out << s.name; }

const std::vector<Setting> kSettings = {
    {"directional", {{LightType::directional, kRight}}},
    {"directional_localViewer", {{LightType::directional, kRight}}, false, true},
    {"directional_flat", {{LightType::directional, kRight}}, true},
    {"pointWithAttenuation", {{LightType::point, kRight}}, false, true},
    {"spot", {{LightType::spot, kRight}}, false, true},
    {"spot_flat_infiniteViewer", {{LightType::spot, kRight}}, true},
    {"severalLights",
     {{LightType::directional, kRight}, {LightType::point, kLeft}, {LightType::spot, kAbove}},
     false,
     true},
    {"severalLights_flat",
     {{LightType::directional, kRight}, {LightType::point, kLeft}, {LightType::spot, kAbove}},
     true,
     true},
    {"twoSided", {{LightType::point, kRight}, {LightType::point, kLeft}}, false, true, true},
    {"fogLinear", {{LightType::point, kRight}}, false, true, false, FogMode::linear},
    {"fogExp", {{LightType::point, kRight}}, false, false, false, FogMode::exp},
    {"fogExp2", {{LightType::point, kRight}}, true, false, false, FogMode::exp2}};

// A torus on the sphere's stage, in polished copper.
Scene torusScene() {
  Scene scene = sceneNamed("analytic/exercise_blinn_phong");
  Primitive torus = tessellateShape(ShapeKind::torus, {1.3f, 0.55f, 0, 0}, 64);
  scene.materials = {sceneNamed("showcase/teapot").materials.at(0)};
  scene.meshes = {{"torus", {torus}}};
  scene.instances.resize(1);
  MeshInstance& instance = scene.instances[0];
  instance.mesh = 0;
  instance.replacedByShape = false;
  // Askew: no ring of vertices lies on a light's terminator.
  const double c = std::cos(0.71), s = std::sin(0.71);
  instance.worldFromObject = glm::dmat4(1, 0, 0, 0, 0, c, s, 0, 0, -s, c, 0, 0, 0, 0, 1);
  return scene;
}

Scene meshNamed(const std::string& name) {
  return name == "torus" ? torusScene()
                         : sceneNamed(name == "sphere" ? "analytic/exercise_blinn_phong" : "showcase/teapot");
}

// What lies below the middle.
void keepHalf(Primitive& p) {
  float low = p.positions[0].y, high = low;
  for (const glm::vec3& v : p.positions) low = std::min(low, v.y), high = std::max(high, v.y);
  const auto isBelow = [&](std::size_t corner) { return 2.0f * p.positions[p.indices[corner]].y < low + high; };
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
    if (!isBelow(i) || !isBelow(i + 1) || !isBelow(i + 2)) continue;
    for (std::size_t corner = i; corner < i + 3; ++corner) kept.push_back(p.indices[corner]);
  }
  p.indices = kept;
}

Scene sceneOf(const std::string& mesh, const Setting& setting) {
  Scene scene = meshNamed(mesh);
  for (MeshInstance& instance : scene.instances) instance.replacedByShape = false;
  scene.shapes.clear();
  scene.lights.clear();
  for (const auto& [type, towards] : setting.lights) scene.lights.push_back(lightFrom(type, towards, 9.0, 0.8f));
  scene.atmosphere.ambient = {0.2f, 0.2f, 0.2f};  // GL_LIGHT_MODEL_AMBIENT of a new context
  if (setting.halved) {
    for (Material& m : scene.materials) m.doubleSided = true;
    for (Mesh& m : scene.meshes) {
      for (Primitive& p : m.primitives) keepHalf(p);
    }
  }
  if (setting.fog != FogMode::none) {
    const double distance = glm::length(glm::dvec3(scene.cameras.at(0).worldFromCamera[3]));
    scene.atmosphere.fogMode = setting.fog;
    scene.atmosphere.fogColor = {0.5f, 0.6f, 0.7f};
    scene.atmosphere.fogStart = distance - 2.5;
    scene.atmosphere.fogEnd = distance + 2.5;
    scene.atmosphere.fogDensity = 0.7 / distance;
  }
  return scene;
}

Comparison compareWith(const Scene& scene, const Setting& setting) {
  RenderSettings ours = settingsFor(setting.flat ? Method::flat : Method::gouraud, kWidth, kHeight);
  lightAsOpenGl(ours);
  ours.infiniteViewer = !setting.localViewer;
  ours.aovs = {"instanceId", "primitiveId"};
  EXPECT_TRUE(unlikeOpenGl(scene, ours).empty());
  return compare(render(device(), scene, ours).image,
                 drawFixedFunction(scene, {kWidth, kHeight, setting.flat, setting.localViewer, true}), scene);
}

using Case = std::tuple<std::string, Setting>;
class OpenGlLighting : public ::testing::TestWithParam<Case> {};

TEST_P(OpenGlLighting, isWhatOpenGlDraws) {
  const auto& [mesh, setting] = GetParam();
  const Comparison c = compareWith(sceneOf(mesh, setting), setting);
  RecordProperty("rmse", fmt::format("{:.2e}", c.rmse));
  EXPECT_GT(c.interior, 1500u) << c;
  EXPECT_TRUE(static_cast<double>(c.same) >= kSameTriangle * static_cast<double>(c.interior)) << c;
  const double allowed = std::max(allowedRmse(), setting.fog == FogMode::none ? 0.0 : kFogRmse);
  EXPECT_LE(c.rmse, allowed) << c;
}

INSTANTIATE_TEST_SUITE_P(Each, OpenGlLighting,
                         ::testing::Combine(::testing::Values("sphere", "teapot", "torus"),
                                            ::testing::ValuesIn(kSettings)),
                         [](const auto& i) { return std::get<0>(i.param) + "_" + std::get<1>(i.param).name; });

// Each parameter of the set counts: taken the other way it shows.
TEST(OpenGlLightingTells, eachOfItsParameters) {
  const std::map<std::string, std::pair<Setting, void (*)(RenderSettings&)>> changes = {
      {"clamp", {kSettings[6], [](RenderSettings& s) { s.clampVertexColors = false; }}},
      {"last vertex", {kSettings[2], [](RenderSettings& s) { s.flatVertex = FlatVertex::first; }}},
      {"viewer", {kSettings[0], [](RenderSettings& s) { s.infiniteViewer = false; }}},
      {"fog's distance", {kSettings[9], [](RenderSettings& s) { s.fogDistance = FogDistance::ray; }}}};
  for (const auto& [name, change] : changes) {
    const auto& [setting, turn] = change;
    Scene scene = sceneOf("sphere", setting);
    for (Light& light : scene.lights) {  // bright enough that something is clamped
      light.classic->diffuse *= 2.0f;
      light.classic->specular *= 2.0f;
    }
    RenderSettings s = settingsFor(setting.flat ? Method::flat : Method::gouraud, kWidth, kHeight);
    lightAsOpenGl(s);
    s.aovs = {"instanceId", "primitiveId"};
    turn(s);
    const Comparison c = compare(render(device(), scene, s).image,
                                 drawFixedFunction(scene, {kWidth, kHeight, setting.flat, false, true}), scene);
    EXPECT_GT(c.rmse, kWrongRmse) << name << " taken the other way: " << c;
  }
}

TEST(OpenGlLightingTells, whatOpenGlHasNoWordFor) {
  Scene scene = sceneNamed("feature/phong");
  RenderSettings s = settingsFor(Method::gouraud, 8, 8);
  lightAsOpenGl(s);
  const std::vector<std::string> said = unlikeOpenGl(scene, s);
  ASSERT_FALSE(said.empty());
  EXPECT_NE(said[0].find("blinnPhong"), std::string::npos) << said[0];
  s.method = Method::phong;
  EXPECT_EQ(unlikeOpenGl(scene, s).size(), said.size() + 1) << "a method that lights no vertices";
}

}  // namespace
}  // namespace crosslight::testing

// Whitted's method against POV-Ray, on what both can say: finishes, lights, shadows, mirrors, glass, transparency, fog.
// POV-Ray computes in double and writes 16 bits, which alone leaves a root mean square of 2^-16 / sqrt(12) = 4.4e-6.
#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "oracle/povray.h"
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

constexpr std::uint32_t kWidth = 240, kHeight = 180;
// Of linear values up to 1, over all pixels, silhouettes and shadow edges included. One pixel on the other side of an
// edge of contrast 0.2 shows as 5e-4: there is none.
constexpr double kSameRmse = 2e-5;
constexpr double kWrongRmse = 1e-3;  // what a convention taken the other way shows by, at least

Material classic(IlluminationModel model, const glm::vec3& kd, float ks = 0, float shininess = 0) {
  Material m;
  m.model = model;
  m.classic.ambientFactor = kd;
  m.classic.diffuseFactor = kd;
  m.classic.specularFactor = glm::vec3(ks);
  m.classic.shininess = shininess;
  return m;
}

Material mirror(float kr) {
  Material m = classic(IlluminationModel::lambert, {0.12f, 0.1f, 0.14f});
  m.classic.reflectionFactor = glm::vec3(kr);
  return m;
}

Material glass(float ior) {
  Material m;
  m.model = IlluminationModel::cookTorrance;
  m.metallicFactor = 0;
  m.perceptualRoughnessFactor = 0;
  m.transmissionFactor = 1;
  m.indexOfRefraction = ior;
  m.hasIor = m.hasVolume = true;
  return m;
}

// Numbers are askew, so that no edge runs along pixel centers and no pixel needs the last bit to be decided.
struct Set {
  Scene scene;

  Set() {
    scene.source = "made in a test";
    Camera camera;
    const glm::dvec3 eye(0.63, 2.71, 5.37), towards = glm::normalize(glm::dvec3(0.07, 0.61, 0.03) - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(towards, glm::dvec3(0, 1, 0)));
    camera.worldFromCamera = glm::dmat4(glm::dvec4(right, 0), glm::dvec4(glm::cross(right, towards), 0),
                                        glm::dvec4(-towards, 0), glm::dvec4(eye, 1));
    camera.yFov = 0.83;
    scene.cameras.push_back(camera);
    scene.atmosphere.background = {0.11f, 0.17f, 0.29f};
    scene.atmosphere.ambient = glm::vec3(0.15f);
  }

  int add(const Material& material) {
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
  }

  void addShape(ShapeKind kind, const glm::vec4& params, const glm::dvec3& at, const Material& material) {
    ShapeInstance shape;
    shape.kind = kind;
    shape.params = params;
    shape.material = add(material);
    shape.worldFromObject[3] = glm::dvec4(at, 1.0);
    shape.instanceId = scene.instanceCount++;
    scene.shapes.push_back(shape);
  }

  void addFloor() {
    addShape(ShapeKind::plane, {}, {0, -0.013, 0}, classic(IlluminationModel::lambert, {0.5f, 0.55f, 0.45f}));
  }

  // 16 x 16 squares of side 0.83, two materials.
  void addChecker(float light, float dark) {
    constexpr int kSquares = 16;
    constexpr double kSide = 0.83;
    for (int color = 0; color < 2; ++color) {
      Primitive p;
      for (int i = 0; i < kSquares * kSquares; ++i) {
        const int x = i % kSquares, z = i / kSquares;
        if ((x + z) % 2 != color) continue;
        const auto first = static_cast<std::uint32_t>(p.positions.size());
        for (const glm::dvec2& c : {glm::dvec2(0, 0), glm::dvec2(0, 1), glm::dvec2(1, 1), glm::dvec2(1, 0)}) {
          p.positions.emplace_back(
              glm::vec3((x + c.x - kSquares / 2 + 0.37) * kSide, -0.013, (z + c.y - kSquares / 2) * kSide));
        }
        p.normals.insert(p.normals.end(), 4, glm::vec3(0, 1, 0));
        for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) p.indices.push_back(first + k);
      }
      p.material = add(classic(IlluminationModel::lambert, glm::vec3(color == 0 ? light : dark)));
      scene.meshes.push_back({"checker", {p}});
      MeshInstance instance;
      instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
      instance.instanceId = scene.instanceCount++;
      scene.instances.push_back(instance);
    }
  }

  Light& addLight(LightType type, const glm::dvec3& at, float strength) {
    Light light;
    light.type = type;
    light.worldPosition = at;
    light.worldDirection = glm::normalize(glm::dvec3(0.07, 0.7, 0.03) - at);
    light.classic = ClassicLight{};
    light.classic->diffuse = light.classic->specular = glm::vec3(strength, 0.9f * strength, 0.8f * strength);
    scene.lights.push_back(light);
    return scene.lights.back();
  }
};

class Povray : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!havePovray()) GTEST_SKIP() << "POV-Ray is not installed";
    scratch_ = std::filesystem::temp_directory_path() /
               ("crosslight_povray_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(scratch_);
  }
  void TearDown() override {
    if (!HasFailure() && !scratch_.empty()) std::filesystem::remove_all(scratch_);
  }

  static RenderSettings settings(std::uint32_t maxDepth = 5) {
    RenderSettings s = settingsFor(Method::whitted, kWidth, kHeight);
    s.maxDepth = maxDepth;
    return s;
  }

  double rmse(const Scene& scene, const RenderSettings& s) {
    const Image ours = render(device(), scene, s).image;
    const auto theirs = drawPovray(scene, {kWidth, kHeight, s.maxDepth, s.shadows}, scratch_);
    double sum = 0, worst = 0;
    std::uint32_t x = 0, y = 0;
    for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) {
      const auto p = pixelAt(ours, i % kWidth, i / kWidth);
      for (std::size_t c = 0; c < 3; ++c) {
        const double d = static_cast<double>(p[c]) - theirs[i][c];
        sum += d * d;
        if (std::abs(d) > worst) worst = std::abs(d), x = i % kWidth, y = i / kWidth;
      }
    }
    const double result = std::sqrt(sum / (3.0 * kWidth * kHeight));
    worst_ = fmt::format("worst {} at ({}, {}): ours {}, theirs {}; {}", worst, x, y, pixelAt(ours, x, y)[0],
                         theirs[y * kWidth + x][0], scratch_.string());
    RecordProperty("rmse", std::to_string(result));
    return result;
  }

  void expectSame(const Scene& scene, const RenderSettings& s) { EXPECT_LE(rmse(scene, s), kSameRmse) << worst_; }

  std::filesystem::path scratch_;
  std::string worst_;
};

Set ballOnFloor(const Material& ball) {
  Set set;
  set.addFloor();
  set.addShape(ShapeKind::sphere, {1.07f, 0, 0, 0}, {0.11, 1.03, -0.07}, ball);
  return set;
}

TEST_F(Povray, phongFinishIsRDotV) {
  Set set = ballOnFloor(classic(IlluminationModel::phong, {0.5f, 0.3f, 0.2f}, 0.35f, 17.0f));
  set.addLight(LightType::point, {3.1, 4.7, 3.3}, 0.7f);
  RenderSettings s = settings();
  s.shadows = false;
  expectSame(set.scene, s);
  for (Material& m : set.scene.materials) {
    if (m.model == IlluminationModel::phong) m.model = IlluminationModel::blinnPhong;
  }
  const Image other = render(device(), set.scene, s).image;
  for (Material& m : set.scene.materials) {
    if (m.model == IlluminationModel::blinnPhong) m.model = IlluminationModel::phong;
  }
  const Image ours = render(device(), set.scene, s).image;
  EXPECT_GT(largestDifference(ours, other, [](auto, auto) { return true; }).maximum, kWrongRmse);
}

TEST_F(Povray, specularFinishIsNDotH) {
  Set set = ballOnFloor(classic(IlluminationModel::blinnPhong, {0.3f, 0.5f, 0.2f}, 0.35f, 40.0f));
  set.addLight(LightType::point, {3.1, 4.7, 3.3}, 0.7f);
  RenderSettings s = settings();
  s.shadows = false;
  expectSame(set.scene, s);
}

TEST_F(Povray, quadraticAttenuation) {
  Set set = ballOnFloor(classic(IlluminationModel::phong, {0.5f, 0.3f, 0.2f}, 0.2f, 12.0f));
  set.addLight(LightType::point, {2.1, 3.7, 2.3}, 0.9f).classic->attenuation = {0.5f, 0.0f, 0.031f};
  expectSame(set.scene, settings());
}

TEST_F(Povray, linearAttenuation) {
  Set set = ballOnFloor(classic(IlluminationModel::phong, {0.5f, 0.3f, 0.2f}, 0.2f, 12.0f));
  set.addLight(LightType::point, {2.1, 3.7, 2.3}, 0.9f).classic->attenuation = {0.5f, 0.13f, 0.0f};
  expectSame(set.scene, settings());
}

TEST_F(Povray, spotWithHardEdgeAndExponent) {
  Set set = ballOnFloor(classic(IlluminationModel::phong, {0.5f, 0.3f, 0.2f}, 0.2f, 12.0f));
  Light& spot = set.addLight(LightType::spot, {2.1, 4.7, 2.3}, 0.9f);
  spot.classic->spotCutoff = 21.0f;
  spot.classic->spotExponent = 8.0f;
  expectSame(set.scene, settings());
}

TEST_F(Povray, shadowsOfOneAndOfTwoLights) {
  Set set = ballOnFloor(classic(IlluminationModel::lambert, {0.5f, 0.3f, 0.2f}));
  set.addShape(ShapeKind::box, {0.7f, 1.9f, 0.6f, 0}, {-1.63, 0.95, 0.41},
               classic(IlluminationModel::lambert, {0.3f, 0.3f, 0.5f}));
  set.addShape(ShapeKind::cylinder, {0.31f, 1.4f, 0, 0}, {1.73, 0.71, 0.83},
               classic(IlluminationModel::lambert, {0.4f, 0.3f, 0.5f}));
  set.addLight(LightType::point, {3.1, 4.7, 3.3}, 0.6f);
  expectSame(set.scene, settings());
  set.addLight(LightType::point, {-2.7, 3.9, 2.9}, 0.4f);
  expectSame(set.scene, settings());
}

class PovrayDepths : public Povray, public ::testing::WithParamInterface<std::uint32_t> {};

TEST_P(PovrayDepths, mirrorsOverAChecker) {
  Set set;
  set.addChecker(0.7f, 0.1f);
  set.addShape(ShapeKind::sphere, {0.87f, 0, 0, 0}, {-0.91, 0.86, -0.31}, mirror(0.7f));
  set.addShape(ShapeKind::sphere, {0.79f, 0, 0, 0}, {0.97, 0.78, 0.13}, mirror(0.6f));
  set.addLight(LightType::point, {3.1, 4.7, 3.3}, 0.7f);
  expectSame(set.scene, settings(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Depth, PovrayDepths, ::testing::Values(0u, 1u, 2u, 3u, 4u));

// Light comes from the ambient term alone: highlights on glass are a matter of taste (ours are GGX, theirs would be
// Phong's).
Set lightless() {
  Set set;
  set.scene.atmosphere.ambient = glm::vec3(0.9f);
  set.addChecker(0.8f, 0.15f);
  return set;
}

TEST_F(Povray, glassSphereOverAChecker) {
  Set set = lightless();
  set.addShape(ShapeKind::sphere, {0.97f, 0, 0, 0}, {0.11, 1.13, 0.17}, glass(1.5f));
  expectSame(set.scene, settings(6));
}

TEST_F(Povray, glassSlab) {
  Set set = lightless();
  set.addShape(ShapeKind::box, {2.3f, 1.7f, 0.41f, 0}, {0.11, 1.13, 0.67}, glass(1.33f));
  expectSame(set.scene, settings(6));
}

TEST_F(Povray, transparencyScalesWhatTheSurfaceSendsBack) {
  Set set;
  set.addChecker(0.7f, 0.1f);
  Material pane = classic(IlluminationModel::lambert, {0.2f, 0.3f, 0.5f});
  pane.classic.transparency = 0.6f;
  pane.doubleSided = true;  // POV-Ray's surfaces all are: the ball's inside shows too
  set.addShape(ShapeKind::sphere, {0.97f, 0, 0, 0}, {0.11, 1.13, 0.17}, pane);
  set.addLight(LightType::point, {3.1, 4.7, 3.3}, 0.7f);
  RenderSettings s = settings();
  s.shadows = false;  // theirs would be colored by the pigment
  expectSame(set.scene, s);
}

TEST_F(Povray, exponentialFogAlongEveryRay) {
  Set set;
  set.addChecker(0.7f, 0.1f);
  set.scene.atmosphere.fogMode = FogMode::exp;
  set.scene.atmosphere.fogColor = {0.4f, 0.45f, 0.5f};
  set.scene.atmosphere.fogDensity = 0.09;
  set.addShape(ShapeKind::sphere, {0.97f, 0, 0, 0}, {0.11, 1.13, 0.17}, mirror(0.6f));
  set.addLight(LightType::point, {3.1, 4.7, 3.3}, 0.7f);
  expectSame(set.scene, settings());
}

}  // namespace
}  // namespace crosslight::testing

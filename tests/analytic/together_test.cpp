// Effects of the air, of light and of bodies together: what one of them says must hold in the presence of the others.
#include <cmath>

#include "support/area_stage.h"

namespace crosslight::testing {
namespace {

constexpr double kRounding = 2e-6;
constexpr glm::dvec3 kTint{0.25, 0.75, 0.5};
constexpr Method kPhongAndRays[] = {Method::phong, Method::whitted};

Smoke smokeBox(float absorption, float scattering) {
  Smoke s;
  s.shape = SmokeShape::box;
  s.center = {0, 0, -4};
  s.size = {6, 2, 2};
  s.absorption = glm::vec3(absorption);
  s.scattering = glm::vec3(scattering);
  return s;
}

std::shared_ptr<EnvironmentMap> evenMap(float radiance) {
  auto map = std::make_shared<EnvironmentMap>();
  map->width = 8;
  map->height = 4;
  map->radiance.assign(32, glm::vec3(radiance));
  return map;
}

std::array<float, 4> center(const Scene& scene, Method method, const std::function<void(RenderSettings&)>& set = {}) {
  RenderSettings s = settingsFor(method, 9, 9);
  if (set) set(s);
  return pixelAt(render(device(), scene, s).image, 4, 4);
}

// Smoke lies over what fog leaves; fog adds its color to what lies behind the smoke.
TEST(Together, fogIsSeenThroughSmoke) {
  Stage stage;
  Atmosphere& air = stage.scene.atmosphere;
  air.smoke = smokeBox(0.3f, 0.0f);
  air.fogMode = FogMode::exp;
  air.fogDensity = 0.1;
  air.fogColor = glm::vec3(0.5f);
  stage.addWall(-6.0, stage.add(emitter(1.0f)));
  const double clear = std::exp(-0.6), expected = std::exp(-0.6) * (clear + 0.5 * (1.0 - clear));
  for (const Method method : kPhongAndRays)
    EXPECT_NEAR(center(stage.scene, method)[0], expected, kRounding) << nameOf(method);
}

// An environment of radiance 1 is ambient light of 1 to smoke, and the background behind it.
TEST(Together, smokeScattersTheEnvironment) {
  Stage stage;
  stage.scene.atmosphere.smoke = smokeBox(0.1f, 0.4f);
  stage.scene.atmosphere.environment = {"made in a test", 1.0, 0.0, evenMap(1.0f)};
  stage.addWall(3.0, stage.add(emitter(0.0f)));  // behind the camera
  const double clear = std::exp(-1.0), expected = clear + 0.8 * (1.0 - clear);
  for (const Method method : kPhongAndRays)
    EXPECT_NEAR(center(stage.scene, method)[0], expected, kRounding) << nameOf(method);
}

// What a light with an area scatters into the view, by brute force over the light and the way.
double scattered(const Smoke& smoke, const Light& light) {
  const double sigmaS = double{smoke.scattering.x}, sigmaT = sigmaS + double{smoke.absorption.x};
  constexpr int kSteps = 400;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = 3.0 + 2.0 * (i + 0.5) / kSteps;
    const glm::dvec3 p(0, 0, -t);
    sum += overLight(light, p, 24, [&](const glm::dvec3& wi, const glm::dvec3&) {
      const double within = 1.0 / wi.y;  // up to the top of the box; the light lies above it
      return std::exp(-sigmaT * (t - 3.0 + within)) * sigmaS / (4 * kTestPi);
    });
  }
  return sum * 2.0 / kSteps;
}

TEST(Together, smokeScattersTheLightOfAreas) {
  const Smoke smoke = smokeBox(0.1f, 0.4f);
  const Light lights[] = {rectangleLight({0, 3, -4}, {0.1, -1, 0.2}, 1.0, 0.6),
                          roundLight(LightType::areaDisk, {0, 3, -4}, {0.1, -1, 0.2}, 0.5),
                          roundLight(LightType::areaSphere, {0, 3, -4}, {0, -1, 0}, 0.4),
                          triangleLight({-0.4, 3, -4.4}, {0, 0, 1}, {1, 0, 0})};
  for (const Light& light : lights) {
    Stage stage;
    stage.scene.atmosphere.smoke = smoke;
    stage.scene.lights = {light};
    stage.addWall(3.0, stage.add(emitter(0.0f)));
    const double expected = scattered(smoke, light);
    ASSERT_GT(expected, 0.0);
    for (const Method method : kPhongAndRays) {
      const auto set = [](RenderSettings& s) { s.smokeSteps = 64; };
      // 64 places on the light, spread evenly: within a few percent of a light as large as this.
      EXPECT_NEAR(center(stage.scene, method, set)[0] / expected, 1.0, 0.02)
          << nameOf(method) << ", light type " << static_cast<int>(light.type);
    }
  }
}

// A pane between a wall and all of a light with an area: what arrives has the pane's color, softly or not.
TEST(Together, softShadowsTakeOnColors) {
  const auto draw = [](bool pane, bool colored, std::uint32_t lightSamples) {
    LitWall wall(rectangleLight({0, 2.5, -2.0}, {0, -1, -0.4}, 0.6, 0.6));
    Material green = glass(1.5f);
    green.hasVolume = false;
    green.baseColorFactor = glm::vec4(glm::vec3(kTint), 1.0f);
    if (pane) wall.addShape(ShapeKind::disk, {2.0f, 0, 0, 0}, {0, 1.5, -2.0}, wall.add(green));
    return center(wall.scene, Method::whitted, [&](RenderSettings& s) {
      s.coloredShadows = colored;
      s.lightSamples = lightSamples;
    });
  };
  const auto open = draw(false, true, 16);
  ASSERT_GT(open[0], 0.0f);
  for (const std::uint32_t lightSamples : {0u, 16u}) {
    const auto colored = draw(true, true, lightSamples), pale = draw(true, false, lightSamples);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(colored[c] / open[c], kTint[static_cast<glm::length_t>(c)], 1e-5)
          << lightSamples << " rays, channel " << c;
      EXPECT_NEAR(pale[c] / open[c], 1.0, 1e-5);
    }
  }
}

TEST(Together, theEnvironmentsShadowsTakeOnColors) {
  const auto draw = [](bool pane) {
    Stage stage;
    stage.addWall(-3.0, stage.add(lambert(0.3f)));
    Material green = glass(1.5f);
    green.hasVolume = false;
    green.baseColorFactor = glm::vec4(glm::vec3(kTint), 1.0f);
    green.doubleSided = true;
    if (pane) stage.addShape(ShapeKind::sphere, {40.0f, 0, 0, 0}, {0, 0, 0}, stage.add(green));
    stage.scene.atmosphere.environment = {"made in a test", 1.0, 0.0, evenMap(1.0f)};
    return center(stage.scene, Method::whitted, [](RenderSettings& s) { s.coloredShadows = true; });
  };
  const auto open = draw(false), tinted = draw(true);
  ASSERT_GT(open[0], 0.0f);
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(tinted[c] / open[c], kTint[static_cast<glm::length_t>(c)], 1e-5) << "channel " << c;
}

// Smoke behind a red pane is lit in red, where shadows have colors.
TEST(Together, smokeIsLitInTheColorOfShadows) {
  const auto draw = [](bool colored) {
    Stage stage;
    stage.scene.atmosphere.smoke = smokeBox(0.1f, 0.4f);
    Light sun;
    sun.type = LightType::directional;
    sun.worldDirection = {0, -1, 0};
    stage.scene.lights = {sun};
    Material red = glass(1.5f);
    red.hasVolume = false;
    red.baseColorFactor = glm::vec4(glm::vec3(kTint), 1.0f);
    stage.addShape(ShapeKind::disk, {20.0f, 0, 0, 0}, {0, 3, -4}, stage.add(red));
    return center(stage.scene, Method::whitted, [&](RenderSettings& s) { s.coloredShadows = colored; });
  };
  const auto pale = draw(false), red = draw(true);
  ASSERT_GT(pale[0], 0.0f);
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(red[c] / pale[c], kTint[static_cast<glm::length_t>(c)], 1e-5) << "channel " << c;
}

// To a camera within water an even environment is the same as a background of its radiance.
TEST(Together, theEnvironmentIsSeenFromWithinBodies) {
  const auto draw = [](bool around) {
    Stage stage;
    Material water = glass(1.33f);
    water.attenuationColor = {0.5f, 0.7f, 0.9f};
    water.attenuationDistance = 1.0f;
    stage.addShape(ShapeKind::box, {40, 40, 4, 0}, {0, 0, 0}, stage.add(water));
    stage.scene.atmosphere.background = glm::vec3(0.5f);
    if (around) stage.scene.atmosphere.environment = {"made in a test", 1.0, 0.0, evenMap(0.5f)};
    return render(device(), stage.scene, settingsFor(Method::whitted, 16, 16)).image;
  };
  const Difference d = largestDifference(draw(false), draw(true), [](std::uint32_t, std::uint32_t) { return true; });
  EXPECT_TRUE(d.maximum <= kRounding) << d;
}

}  // namespace
}  // namespace crosslight::testing

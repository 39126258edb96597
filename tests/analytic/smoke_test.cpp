// Smoke against closed forms and a double-precision quadrature of single scattering.
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "support/stage.h"

namespace crosslight::testing {
namespace {

constexpr double kRounding = 2e-6;
constexpr Method kMethods[] = {Method::flat, Method::gouraud, Method::phong, Method::whitted};

Smoke smokeIn(SmokeShape shape, const glm::vec3& absorption, const glm::vec3& scattering) {
  Smoke s;
  s.shape = shape;
  s.center = {0, 0, -4};
  s.size = {6, 2, 2};
  s.radius = 1.5;
  s.absorption = absorption;
  s.scattering = scattering;
  return s;
}

glm::dvec3 rayOf(std::uint32_t x, std::uint32_t y, std::uint32_t size) {
  const double half = std::tan(0.5 * 0.7853981633974483);
  return glm::normalize(glm::dvec3((2.0 * (x + 0.5) / size - 1.0) * half, (1.0 - 2.0 * (y + 0.5) / size) * half, -1.0));
}

// Where a ray from `origin` is in the smoke, up to `most`.
std::pair<double, double> spanOf(const Smoke& s, const glm::dvec3& origin, const glm::dvec3& d, double most) {
  double begin = 0.0, end = most;
  if (s.shape == SmokeShape::box) {
    for (int i = 0; i < 3; ++i) {
      const double a = (s.center[i] - 0.5 * s.size[i] - origin[i]) / d[i];
      const double b = (s.center[i] + 0.5 * s.size[i] - origin[i]) / d[i];
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
  }
  if (s.shape == SmokeShape::sphere) {
    const double middle = glm::dot(s.center - origin, d);
    const double rest = s.radius * s.radius - glm::dot(s.center - origin, s.center - origin) + middle * middle;
    if (!(rest > 0.0)) return {0.0, 0.0};
    begin = std::max(begin, middle - std::sqrt(rest));
    end = std::min(end, middle + std::sqrt(rest));
  }
  return end > begin ? std::pair(begin, end) : std::pair(0.0, 0.0);
}

// Without scattering it is Beer's law, for surfaces and for the background, whatever the method.
TEST(Smoke, thatOnlyAbsorbsFollowsBeersLaw) {
  const glm::vec3 absorption{0.0f, 0.3f, 2.0f};
  for (const SmokeShape shape : {SmokeShape::everywhere, SmokeShape::box, SmokeShape::sphere}) {
    Stage stage;
    stage.scene.atmosphere.smoke = smokeIn(shape, absorption, glm::vec3(0.0f));
    stage.scene.atmosphere.background = glm::vec3(0.5f);
    stage.addShape(ShapeKind::disk, {1.0f, 0, 0, 0}, {0, 0, -4.5}, stage.add(emitter(1.0f)));
    stage.scene.shapes[0].worldFromObject =
        glm::dmat4(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, 1, 0), glm::dvec4(0, -1, 0, 0), glm::dvec4(0, 0, -4.5, 1));
    for (const Method method : kMethods) {
      const Image image = render(device(), stage.scene, settingsFor(method, 16, 16)).image;
      for (const std::uint32_t at : {0u, 3u, 7u, 8u, 15u}) {
        const glm::dvec3 d = rayOf(at, at, 16);
        const bool hit = pixelAt(image, at, at)[3] > 0.0f;
        const double wall = -4.5 / d.z;
        const auto [begin, end] = spanOf(stage.scene.atmosphere.smoke, glm::dvec3(0), d, hit ? wall : 1e30);
        EXPECT_EQ(hit, at == 7 || at == 8) << nameOf(method);
        for (int c = 0; c < 3; ++c) {
          const double sigma = static_cast<double>(absorption[c]);
          // Without an end it is cut at 16 optical depths of the clearest channel that absorbs.
          const double expected = (hit ? 1.0 : 0.5) * std::exp(-sigma * (end - begin));
          EXPECT_NEAR(pixelAt(image, at, at)[static_cast<std::size_t>(c)], expected, kRounding)
              << nameOf(method) << " at " << at << ", channel " << c << ", shape " << static_cast<int>(shape);
        }
      }
    }
  }
}

// One point light of 1 candela, seen through scattering smoke before a black background.
double scattered(const Smoke& s, const glm::dvec3& d, const glm::dvec3& light, double intensity) {
  const double sigmaS = static_cast<double>(s.scattering.x), sigmaT = sigmaS + static_cast<double>(s.absorption.x);
  const double g = static_cast<double>(s.anisotropy);
  const auto [begin, end] = spanOf(s, glm::dvec3(0), d, 40.0 / sigmaT);
  constexpr int kSteps = 20000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = begin + (end - begin) * (i + 0.5) / kSteps;
    const glm::dvec3 toLight = light - t * d;
    const double distance = glm::length(toLight);
    const glm::dvec3 wi = toLight / distance;
    const auto [from, to] = spanOf(s, t * d, wi, distance);
    const double cosine = glm::dot(wi, d);
    const double phase = (1 - g * g) / (4 * std::numbers::pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
    sum += sigmaS * phase * intensity / (distance * distance) * std::exp(-sigmaT * (t - begin + to - from));
  }
  return sum * (end - begin) / kSteps;
}

Stage lampInSmoke(const Smoke& smoke) {
  Stage stage;
  stage.scene.atmosphere.smoke = smoke;
  Light lamp;
  lamp.intensity = 5.0f;
  lamp.worldPosition = {1.0, 2.0, -4.5};
  stage.scene.lights.push_back(lamp);
  stage.addWall(3.0, stage.add(emitter(0.0f)));  // behind the camera
  return stage;
}

TEST(Smoke, scattersALampsLightOnceAsTheIntegralSays) {
  for (const SmokeShape shape : {SmokeShape::everywhere, SmokeShape::box, SmokeShape::sphere}) {
    for (const float g : {-0.5f, 0.0f, 0.7f}) {
      Smoke smoke = smokeIn(shape, glm::vec3(0.1f), glm::vec3(0.4f));
      smoke.anisotropy = g;
      const Stage stage = lampInSmoke(smoke);
      for (const Method method : {Method::phong, Method::whitted}) {
        RenderSettings settings = settingsFor(method, 8, 8);
        settings.smokeSteps = 128;
        settings.shadows = false;
        const Image image = render(device(), stage.scene, settings).image;
        for (const std::uint32_t at : {1u, 3u, 5u}) {
          const double expected = scattered(smoke, rayOf(at, 3, 8), {1.0, 2.0, -4.5}, 5.0);
          EXPECT_NEAR(pixelAt(image, at, 3)[0] / expected, 1.0, 2e-3)
              << nameOf(method) << " at " << at << ", g " << g << ", shape " << static_cast<int>(shape);
        }
      }
    }
  }
}

// A sun from above, and a roof over the nearer half: from there nothing comes. Light falls through one unit of smoke.
TEST(Smoke, isDarkWhereALightIsHidden) {
  Smoke smoke = smokeIn(SmokeShape::box, glm::vec3(0.1f), glm::vec3(0.4f));
  Stage stage;
  stage.scene.atmosphere.smoke = smoke;
  Light sun;
  sun.type = LightType::directional;
  sun.worldDirection = {0, -1, 0};
  sun.intensity = 3.0f;
  stage.scene.lights.push_back(sun);
  stage.addShape(ShapeKind::box, {20, 0.5f, 2, 0}, {0, 3, -3}, stage.add(emitter(0.0f)));  // ends at z = -4
  const double sigma = 0.5, scale = 0.4 / (4 * std::numbers::pi) * 3.0 * std::exp(-sigma * 1.0);
  const double whole = scale * (1 - std::exp(-2 * sigma)) / sigma;
  const double farHalf = scale * (std::exp(-sigma) - std::exp(-2 * sigma)) / sigma;
  RenderSettings settings = settingsFor(Method::whitted, 9, 9);
  settings.smokeSteps = 256;
  const auto center = [&] { return pixelAt(render(device(), stage.scene, settings).image, 4, 4)[0]; };
  EXPECT_NEAR(center() / farHalf, 1.0, 0.01);  // a step of the shadow's edge, of 256
  settings.shadows = false;
  EXPECT_NEAR(center() / whole, 1.0, 1e-4);
  settings.method = Method::phong;
  EXPECT_NEAR(center() / whole, 1.0, 1e-4) << "raster has no shadows in smoke";
}

TEST(Smoke, ofAGridOfOnesIsEven) {
  Smoke even = smokeIn(SmokeShape::box, glm::vec3(0.3f, 0.1f, 0.2f), glm::vec3(0.4f));
  Smoke grid = even;
  grid.grid = {3, 2, 5};
  grid.densities.assign(30, 1.0f);
  const auto draw = [&](const Smoke& smoke, Method method) {
    RenderSettings settings = settingsFor(method, 16, 12);
    settings.smokeSteps = 64;
    return render(device(), lampInSmoke(smoke).scene, settings).image;
  };
  for (const Method method : {Method::phong, Method::whitted}) {
    const Difference d =
        largestDifference(draw(even, method), draw(grid, method), [](std::uint32_t, std::uint32_t) { return true; });
    EXPECT_TRUE(d.maximum <= 1e-3) << nameOf(method) << ": " << d;
  }
}

// Two cells along the view, 0 and 2: half a cell flat, a ramp, half a cell flat. The amount is that of density 1.
TEST(Smoke, ofAGridIsInterpolatedBetweenTheMiddlesOfCells) {
  Stage stage;
  Smoke smoke = smokeIn(SmokeShape::box, glm::vec3(0.5f), glm::vec3(0.0f));
  smoke.grid = {1, 1, 2};
  smoke.densities = {2.0f, 0.0f};  // z grows towards the camera
  stage.scene.atmosphere.smoke = smoke;
  stage.addWall(-4.0, stage.add(emitter(1.0f)));  // in the middle: half of the box lies behind
  // The nearer half, of length 1: 0 over half a unit, then up to 1 over the other.
  for (const Method method : kMethods) {
    RenderSettings settings = settingsFor(method, 9, 9);
    settings.smokeSteps = 256;
    EXPECT_NEAR(pixelAt(render(device(), stage.scene, settings).image, 4, 4)[0], std::exp(-0.5 * 0.25), 1e-4)
        << nameOf(method);
  }
}

TEST(Smoke, lightsUpByTheScenesAmbientLight) {
  Stage stage;
  stage.scene.atmosphere.smoke = smokeIn(SmokeShape::box, glm::vec3(0.1f), glm::vec3(0.4f));
  stage.scene.atmosphere.ambient = glm::vec3(0.5f);
  stage.addWall(3.0, stage.add(emitter(0.0f)));
  const double expected = 0.5 * 0.8 * (1 - std::exp(-0.5 * 2));  // albedo 0.8
  for (const Method method : kMethods) EXPECT_NEAR(stage.center(method, 0)[0], expected, kRounding) << nameOf(method);
}

// A mirror shows smoke twice; what a pane lets through is seen through all of it.
TEST(Smoke, liesOnEverySegment) {
  Stage stage;
  stage.scene.atmosphere.smoke = smokeIn(SmokeShape::everywhere, glm::vec3(0.2f), glm::vec3(0.0f));
  Material mirror = emitter(0.25f);
  mirror.classic.reflectionFactor = glm::vec3(0.5f);
  stage.addWall(-3.0, stage.add(mirror));
  stage.addWall(2.0, stage.add(emitter(1.0f)), false);
  EXPECT_NEAR(stage.center(Method::whitted, 5)[0], std::exp(-0.6) * (0.25 + 0.5 * std::exp(-1.0)), kRounding);
}

TEST(Smoke, behindTransparentThingsIsTheSameInRasterAndRays) {
  Stage stage = lampInSmoke(smokeIn(SmokeShape::box, glm::vec3(0.1f), glm::vec3(0.4f)));
  Material pane = emitter(0.5f);
  pane.classic.transparency = 0.4f;
  stage.addWall(-3.5, stage.add(pane));
  stage.addWall(-4.5, stage.add(emitter(1.0f)));
  RenderSettings settings = settingsFor(Method::whitted, 9, 9);
  settings.shadows = false;
  settings.smokeSteps = 128;
  const auto rays = pixelAt(render(device(), stage.scene, settings).image, 4, 4);
  settings.method = Method::phong;
  const auto raster = pixelAt(render(device(), stage.scene, settings).image, 4, 4);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(raster[c], rays[c], 1e-4);
}

TEST(Smoke, inAnyUnitLooksTheSame) {
  const auto draw = [](Method method, double unit) {
    Smoke smoke = smokeIn(SmokeShape::sphere, glm::vec3(0.1f), glm::vec3(0.4f));
    smoke.center *= unit;
    smoke.radius *= unit;
    smoke.absorption /= static_cast<float>(unit);
    smoke.scattering /= static_cast<float>(unit);
    Stage stage = lampInSmoke(smoke);
    stage.scene.lights[0].worldPosition *= unit;
    stage.scene.lights[0].intensity *= static_cast<float>(unit * unit);
    stage.scene.instances[0].worldFromObject[3] *= glm::dvec4(unit, unit, unit, 1);
    stage.scene.cameras[0].zNear *= unit;
    return render(device(), stage.scene, settingsFor(method, 16, 12)).image;
  };
  for (const Method method : {Method::phong, Method::whitted}) {
    const Image reference = draw(method, 1.0);
    for (const double unit : {0x1p-20, 0x1p20}) {
      const Difference d =
          largestDifference(reference, draw(method, unit), [](std::uint32_t, std::uint32_t) { return true; });
      EXPECT_TRUE(d.maximum <= 1e-4) << nameOf(method) << ", unit " << unit << ": " << d;
    }
  }
}

}  // namespace
}  // namespace crosslight::testing

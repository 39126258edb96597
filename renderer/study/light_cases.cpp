// Cases of lights: none left at a point, none that falls off, cones of a hundredth of a degree, ten thousand at once.
#include <fmt/format.h>

#include <numbers>

#include "study/cases.h"
#include "study/pictures.h"

namespace crosslight::study {
namespace {

constexpr std::uint32_t kSize = 65;  // odd: a pixel's center lies in the middle

Material halfAmbient() {
  Material m = lambert(0.5f);
  m.classic.ambientFactor = glm::vec3(0.5f);
  return m;
}

// The wall z = -2, seen and lit.
Stage wallUnder(const std::vector<Light>& lights) {
  Stage stage;
  stage.addWall(-2.0, stage.add(halfAmbient()));
  stage.scene.atmosphere.ambient = glm::vec3(0.2f);
  stage.scene.lights = lights;
  return stage;
}

void lampInTheSurface(const Bench& bench, CaseResult& result) {
  for (const Method method : kRasterAndRays) {
    const Light lamp;  // glTF's: inverse square, infinite at its own place
    Light inside = lamp;
    inside.worldPosition = {0, 0, -2};
    const Shot shot = bench.draw(wallUnder({inside}).scene, settingsFor(method, kSize, kSize));
    Worst middle;
    middle.addAbsolute(pixelAt(shot.image, kSize / 2, kSize / 2)[0], 0.1);
    const float d = 0, attenuation = 1 / (d * d);
    middle.addNaive(std::abs(0.5f * attenuation * 0.0f));
    result.measure(techniqueOf(method), "brightness of the very point that a lamp is in: ambient light alone", middle,
                   4 * kU, "absolute");
    result.count(techniqueOf(method), "values that are not finite", shot.nonfinite, shot.image.pixels());
  }
}

void noAttenuation(const Bench& bench, CaseResult& result) {
  Light none = lampAt({1, 1, 0}), constant = none;
  none.classic->attenuation = glm::vec3(0.0f);
  for (const Method method : kRasterAndRays) {
    const Shot shot = bench.draw(wallUnder({none}).scene, settingsFor(method, kSize, kSize));
    Worst worst;
    compareColors(shot.image, bench.draw(wallUnder({constant}).scene, settingsFor(method, kSize, kSize)).image, worst);
    const float zero = none.classic->attenuation.x;
    worst.addNaive(static_cast<double>(1 / (zero + zero * 2 + zero * 4)));
    result.measure(techniqueOf(method), "a lamp of attenuation (0, 0, 0) against one of (1, 0, 0)", worst, 0,
                   "absolute");
    result.count(techniqueOf(method), "values that are not finite", shot.nonfinite, shot.image.pixels());
  }
}

// Pixels on the wrong side of a cone's edge: the cone's circle has a radius of 20 pixels on the wall at distance 2.
std::uint64_t wrongCone(const Bench& bench, Method method, double degrees, CaseResult& result) {
  const double angle = degrees * std::numbers::pi / 180;
  Light spot;
  spot.type = LightType::spot;
  spot.intensity = 4;
  spot.innerConeAngle = spot.outerConeAngle = static_cast<float>(angle);
  Stage stage = wallUnder({spot});
  const double pixel = 2 * std::tan(static_cast<double>(spot.outerConeAngle)) / 20;
  Camera& camera = stage.scene.cameras[0];
  camera.orthographic = true;
  camera.xMag = camera.yMag = pixel * kSize / 2;
  camera.zFar = 10;
  const Shot shot = bench.draw(stage.scene, settingsFor(method, kSize, kSize));
  std::uint64_t wrong = 0;
  for (std::uint32_t y = 0; y < kSize; ++y) {
    for (std::uint32_t x = 0; x < kSize; ++x) {
      const double radius = std::hypot(x - 0.5 * (kSize - 1), y - 0.5 * (kSize - 1));
      if (std::abs(radius - 20) < 0.5) continue;
      wrong += (pixelAt(shot.image, x, y)[0] > 0.11f) != (radius < 20);
    }
  }
  if (wrong > 0)
    result.show(fmt::format("{}: cone of {:g} degrees, radius 20 pixels", techniqueOf(method), degrees), shot.image);
  return wrong;
}

// acos of the cosine against the angle, in single precision.
std::uint64_t wrongConeByAngles(double degrees) {
  const auto outer = static_cast<float>(degrees * std::numbers::pi / 180);
  std::uint64_t wrong = 0;
  for (int i = 0; i < 40; ++i) {
    if (i == 19 || i == 20) continue;
    const double radius = std::tan(static_cast<double>(outer)) * i / 19.5;
    const glm::vec3 wi(glm::normalize(glm::dvec3(radius, 0, 1)));
    wrong += (std::acos(std::min(wi.z, 1.0f)) <= outer) != (i < 19.5);
  }
  return wrong;
}

void spotCones(const Bench& bench, CaseResult& result) {
  for (const Method method : kRasterAndRays) {
    for (const double degrees : {0.01, 0.1, 1.0, 10.0, 60.0}) {
      const std::uint64_t wrong = wrongCone(bench, method, degrees, result);
      result.count(techniqueOf(method), fmt::format("pixels beyond the edge of a cone of {:g} degrees", degrees), wrong,
                   kSize * kSize, static_cast<double>(wrongConeByAngles(degrees)));
    }
  }
}

// A glowing ball of radius 1 at a distance d before a wall: pi / d^2.
void farBall(const Bench& bench, CaseResult& result) {
  for (const Method method : kRasterAndRays) {
    Worst worst;
    for (const double distance : {1e2, 1e3, 1e4, 1e6}) {
      Light ball;
      ball.type = LightType::areaSphere;
      ball.radius = 1;
      ball.worldPosition = {0, 0, distance - 2};
      Stage stage;
      stage.addWall(-2.0, stage.add(lambert(1)));
      for (int axis = 0; axis < 2; ++axis) stage.scene.instances[0].worldFromObject[axis] /= 4096.0;
      stage.scene.lights = {ball};
      RenderSettings s = settingsFor(method, 9, 9);
      s.shadows = false;
      const double exact = std::numbers::pi / (distance * distance);
      worst.addRelative(pixelAt(bench.draw(stage.scene, s).image, 4, 4)[0], exact);
      // By the cone's cosine, pi (1 - cos^2), in single precision.
      const float sine = 1 / static_cast<float>(distance), cosine = std::sqrt(1 - sine * sine);
      worst.addNaive(std::abs(3.14159265f * (1 - cosine * cosine) / exact - 1));
    }
    result.measure(techniqueOf(method), "light of a ball 100 to 1,000,000 radii away", worst, 3e-6, "relative");
  }
}

// A triangle of half a unit's area at a distance before a wall: area / d^2.
void farTriangle(const Bench& bench, CaseResult& result) {
  for (const Method method : kRasterAndRays) {
    Worst worst;
    for (const double distance : {1e3, 1e4, 1e6}) {
      Light lamp;
      lamp.type = LightType::areaTriangle;
      lamp.worldPosition = {0, 0, distance - 2};
      lamp.worldDirection = {0, 0, -1};
      lamp.worldU = {1, 0, 0};  // u x v against the way of the light
      lamp.worldV = {0, 1, 0};
      Stage stage;
      stage.addWall(-2.0, stage.add(lambert(1)));
      for (int axis = 0; axis < 2; ++axis) stage.scene.instances[0].worldFromObject[axis] /= 4096.0;
      stage.scene.lights = {lamp};
      RenderSettings s = settingsFor(method, 9, 9);
      s.shadows = false;
      const double exact = 0.5 / (distance * distance);
      worst.addRelative(pixelAt(bench.draw(stage.scene, s).image, 4, 4)[0], exact);
      // Girard 1629: the excess of three angles by acos, in single precision.
      const auto d = static_cast<float>(distance);
      const glm::vec3 a = glm::normalize(glm::vec3(0, 0, d)), b = glm::normalize(glm::vec3(1, 0, d)),
                      c = glm::normalize(glm::vec3(0, 1, d));
      const auto at = [](const glm::vec3& p, const glm::vec3& q, const glm::vec3& r) {
        return std::acos(glm::dot(glm::normalize(glm::cross(p, q)), glm::normalize(glm::cross(p, r))));
      };
      const float excess = at(a, b, c) + at(b, c, a) + at(c, a, b) - 3.14159265f;
      worst.addNaive(std::abs(excess / exact - 1));
    }
    // Not in its middle: the triangle's own size, 1 / d, squared; and a dozen roundings.
    result.measure(techniqueOf(method), "light of a triangle 1,000 to 1,000,000 away", worst, 3e-6 + 2e-6, "relative");
  }
}

// Ten thousand lamps of a ten-thousandth.
void manyLights(const Bench& bench, CaseResult& result) {
  const int count = 10000;
  const Light lamp = [] {
    Light l = sunAlong({0, 0, -1});
    l.classic->diffuse = l.classic->specular = glm::vec3(1e-4f);
    return l;
  }();
  Stage stage;
  stage.addWall(-2.0, stage.add(lambert(1)));
  stage.scene.lights.assign(count, lamp);
  const double exact = static_cast<double>(1e-4f) * count;
  float sum = 0;
  for (int i = 0; i < count; ++i) sum += 1e-4f;
  for (const Method method : kRasterAndRays) {
    RenderSettings s = settingsFor(method, 9, 9);
    s.shadows = false;
    Worst worst;
    worst.addRelative(pixelAt(bench.draw(stage.scene, s).image, 4, 4)[0], exact);
    worst.addNaive(std::abs(sum / exact - 1));
    result.measure(techniqueOf(method), "sum of 10,000 equal lights", worst, 4 * kU, "relative");
  }
}

}  // namespace

std::vector<HardCase> lightCases() {
  return {
      {"I3", "a lamp within the surface",
       "at its own place a lamp has no direction and infinite strength: 0 times infinity",
       "ambient light alone, two products", true, lampInTheSurface},
      {"I7", "attenuation of zero", "1 / (0 + 0 d + 0 d^2) is infinite", "taken as no attenuation: the same bits", true,
       noAttenuation},
      {"I9", "cones of spot lights",
       "the cosine of 0.01 degrees is 1, and the angle by acos is worth nothing near the axis",
       "half a pixel of a cone 20 pixels wide", true, spotCones},
      {"G6", "lights with an area, far away",
       "the cosine of a small cone rounds to 1: the light is gone, or its density infinite",
       "a dozen roundings; the sphere itself is exact", true, farBall},
      {"G12", "small solid angles", "the sum of a spherical triangle's angles less pi cancels to nothing",
       "a dozen roundings, and the square of size over distance", true, farTriangle},
      {"I21", "ten thousand lights", "a plain sum loses the digits of small terms: n roundings of the total",
       "compensated summation: 2 u, and as much for the factors", false, manyLights,
       "lights are summed plainly in single precision; compensated sums wait for the precision levels"},
  };
}

}  // namespace crosslight::study

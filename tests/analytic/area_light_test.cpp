// Lights with an area against closed forms of the literature and against brute force in double precision.
#include "support/area_stage.h"

namespace crosslight::testing {
namespace {

const glm::dvec3 kWallNormal(0, 0, 1);

double cosineAt(const glm::dvec3& wi) { return std::max(glm::dot(kWallNormal, wi), 0.0); }

// What the center of the wall, (0, 0, -3), receives; small, so that its vertices are there too.
double centerOf(const Light& light, Method method) {
  LitWall wall(light);
  for (int axis = 0; axis < 2; ++axis) wall.scene.instances[0].worldFromObject[axis] /= 4096.0;
  return wall.center(method, 0)[0];
}

// Siegel, Howell 2001, "Thermal Radiation Heat Transfer", appendix of configuration factors, times pi.
struct Known {
  const char* name;
  Light light;
  double irradiance;
};
std::vector<Known> knownLights() {
  const glm::dvec3 down(0, 0, -1);
  const double square = 4.0 / std::sqrt(2.0) * std::atan(1.0 / std::sqrt(2.0));
  return {{"sphereAbove", roundLight(LightType::areaSphere, {0, 0, -1}, down, 1.0), kTestPi / 4},
          {"sphereTilted", roundLight(LightType::areaSphere, {1.2, 0, -1.4}, down, 1.0), kTestPi / 4 * 0.8},
          {"disk", roundLight(LightType::areaDisk, {0, 0, -2}, down, 1.0), kTestPi / 2},
          {"square", rectangleLight({0, 0, -2}, down, 2.0, 2.0), square}};
}

TEST(AreaLight, irradianceIsTheClosedForm) {
  for (const Known& known : knownLights()) {
    for (const Method method : {Method::flat, Method::gouraud, Method::phong, Method::whitted}) {
      // Flat shading lights a vertex beside the point; where the light is not straight above, that shows.
      const bool besideThePoint = method == Method::flat && std::string(known.name) == "sphereTilted";
      EXPECT_NEAR(centerOf(known.light, method), known.irradiance, (besideThePoint ? 1e-3 : 2e-6) * kTestPi)
          << known.name << " " << nameOf(method);
    }
  }
}

// A sphere whose middle lies on the horizon, under half angle a: (a - sin a cos a) of the cap's vector (its part along
// the horizon is Snyder 1996's "Area Light Sources for Real-Time Graphics", case of theta = 90 degrees).
TEST(AreaLight, halfSetSphereIsTheClosedForm) {
  const double a = std::asin(0.5);
  const double expected = a - std::sin(a) * std::cos(a);
  const Light light = roundLight(LightType::areaSphere, {2, 0, -3}, {0, 0, -1}, 1.0);
  EXPECT_NEAR(overLight(light, {0, 0, -3}, 1000, [](const auto& wi, const auto&) { return cosineAt(wi); }), expected,
              1e-5);
  for (const Method method : {Method::phong, Method::whitted}) {
    EXPECT_NEAR(centerOf(light, method), expected, 2e-6 * kTestPi) << nameOf(method);
  }
}

// From afar a sphere is the point light that its candela say, and so are the others by their projected area.
TEST(AreaLight, farAwayTheyArePoints) {
  const glm::dvec3 down(0, 0, -1);
  for (const double distance : {100.0, 1e4, 1e6}) {
    const glm::dvec3 at(0, 0, distance - 3);
    const double square = 1.0 / (distance * distance);
    const Light sphere = roundLight(LightType::areaSphere, at, down, 1.0);
    const Light disk = roundLight(LightType::areaDisk, at, down, 1.0);
    const Light rectangle = rectangleLight(at, down, 1.0, 0.5);
    const Light triangle = triangleLight(at, {1, 0, 0}, {0, 1, 0});
    const double size2 = square;  // of (size / distance)^2, the terms left out
    for (const Method method : {Method::phong, Method::whitted}) {
      const auto expectRatio = [&](const Light& light, double area) {
        EXPECT_NEAR(centerOf(light, method) / (area * square), 1.0, 3e-6 + 2 * size2)
            << nameOf(light.type) << " at " << distance << " by " << nameOf(method);
      };
      expectRatio(sphere, kTestPi);
      expectRatio(disk, kTestPi);
      expectRatio(rectangle, 0.5);
      expectRatio(triangle, 0.5);
    }
  }
}

// Tilted, near, and partly behind the wall's own plane, all over the wall.
std::vector<Light> crossingLights() {
  std::vector<Light> lights = {rectangleLight({0.3, -0.9, -2.7}, {-0.2, 0.9, -0.3}, 1.4, 1.0),
                               triangleLight({-0.9, -0.9, -2.6}, {0.2, 1.6, -0.9}, {1.5, 0.1, 0.3}),
                               roundLight(LightType::areaDisk, {-0.4, 0.95, -2.8}, {0.2, -1.0, -0.3}, 0.8),
                               roundLight(LightType::areaDisk, {0.2, 0.1, -2.2}, {0.1, 0.05, -1.0}, 0.5),
                               roundLight(LightType::areaSphere, {0.5, -0.7, -2.9}, {0, 0, -1}, 0.3)};
  lights[1].twoSided = true;
  return lights;
}

// As near as ten of brute force's steps, a three-hundredth of the light's size each.
bool isBesideTheFace(const Light& light, const glm::dvec3& p) {
  const glm::dvec3 d = p - light.worldPosition;
  const bool flat = light.type != LightType::areaSphere;
  return glm::length(d) < 0.15 || (flat && std::abs(glm::dot(d, glm::normalize(light.worldDirection))) < 0.03);
}

TEST(AreaLight, irradianceAgreesWithBruteForceAcrossTheHorizon) {
  constexpr int kPlaces = 300;
  for (const Light& light : crossingLights()) {
    const LitWall wall(light);
    for (const Method method : {Method::phong, Method::whitted}) {
      const Image image = wall.draw(method, 16, 12, [](RenderSettings& s) { s.shadows = false; });
      double largest = 0, worst = 0;
      for (std::uint32_t y = 0; y < 12; ++y) {
        for (std::uint32_t x = 0; x < 16; ++x) {
          const glm::dvec3 p = LitWall::placeOf(image, x, y);
          // Next to where the light meets the wall brute force sees too few places: 1/d^2 changes from one to the next.
          if (isBesideTheFace(light, p)) continue;
          const double expected =
              overLight(light, p, kPlaces, [](const auto& wi, const auto&) { return cosineAt(wi); });
          const double off = std::abs(pixelAt(image, x, y)[0] - expected);
          largest = std::max(largest, expected);
          if (!(off <= worst)) worst = off;
        }
      }
      EXPECT_GT(largest, 0.1);
      // Brute force has kinks at the horizon and at the side: steps of 1/300 of a part of the light.
      EXPECT_TRUE(worst <= 1e-3 * kTestPi) << nameOf(light.type) << " by " << nameOf(method) << ": " << worst;
      RecordProperty(std::string(nameOf(light.type)) + nameOf(method), std::to_string(worst));
    }
  }
}

Material glossy(IlluminationModel model, float value) {
  Material m;
  m.model = model;
  m.classic.ambientFactor = m.classic.diffuseFactor = glm::vec3(0.0f);
  m.classic.specularFactor = glm::vec3(1.0f);
  m.classic.shininess = value;
  m.metallicFactor = 1.0f;
  m.perceptualRoughnessFactor = value;
  return m;
}

double specularAt(const Material& m, const glm::dvec3& wo, const glm::dvec3& wi) {
  const double nl = glm::dot(kWallNormal, wi);
  if (nl <= 0) return 0;
  const glm::dvec3 h = glm::normalize(wo + wi);
  const double nh = glm::dot(kWallNormal, h), nv = glm::dot(kWallNormal, wo);
  if (m.model == IlluminationModel::phong) {
    return std::pow(std::max(0.0, glm::dot(2 * nl * kWallNormal - wi, wo)), m.classic.shininess);
  }
  if (m.model == IlluminationModel::blinnPhong) return std::pow(std::max(0.0, nh), m.classic.shininess);
  const double a = m.perceptualRoughnessFactor * m.perceptualRoughnessFactor, a2 = a * a;
  const double q = nh * nh * (a2 - 1) + 1;
  const double v = 0.5 / (nl * std::sqrt(nv * nv * (1 - a2) + a2) + nv * std::sqrt(nl * nl * (1 - a2) + a2));
  return a2 / (kTestPi * q * q) * v * nl;  // F0 = 1
}

// The quadrature's error, of the largest value on the wall: each bound is about twice what is found.
struct Lobe {
  const char* name;
  IlluminationModel model;
  float value;
  double bound;
};
const Lobe kLobes[] = {{"phong5", IlluminationModel::phong, 5, 7e-4},
                       {"phong50", IlluminationModel::phong, 50, 1e-3},
                       {"phong400", IlluminationModel::phong, 400, 6e-3},
                       {"blinnPhong20", IlluminationModel::blinnPhong, 20, 1e-3},
                       {"blinnPhong200", IlluminationModel::blinnPhong, 200, 6e-3},
                       {"ggx02", IlluminationModel::cookTorrance, 0.2f, 1e-2},
                       {"ggx05", IlluminationModel::cookTorrance, 0.5f, 2e-3},
                       {"ggx1", IlluminationModel::cookTorrance, 1.0f, 5e-4}};

class GlossyLobe : public ::testing::TestWithParam<Lobe> {};

TEST_P(GlossyLobe, integralAgreesWithBruteForce) {
  const Material material = glossy(GetParam().model, GetParam().value);
  double worst = 0;
  const Light lights[] = {rectangleLight({0.6, 0.2, -0.6}, {-0.3, 0, -1.0}, 1.2, 0.7),
                          roundLight(LightType::areaDisk, {-0.5, 0.4, -1.2}, {0.3, -0.4, -1.0}, 0.4),
                          roundLight(LightType::areaSphere, {0.2, -0.5, -1.5}, {0, 0, -1}, 0.3),
                          triangleLight({0.1, 0.1, -1.0}, {0.7, 0.1, 0.2}, {0.0, 0.9, 0.1})};
  for (const Light& light : lights) {
    const LitWall wall(light, material);
    const Image image = wall.draw(Method::phong, 10, 8);
    double largest = 0, off = 0;
    for (std::uint32_t y = 0; y < 8; ++y) {
      for (std::uint32_t x = 0; x < 10; ++x) {
        const glm::dvec3 p = LitWall::placeOf(image, x, y);
        const glm::dvec3 wo = glm::normalize(-p);
        const double expected =
            overLight(light, p, 500, [&](const auto& wi, const auto&) { return specularAt(material, wo, wi); });
        largest = std::max(largest, expected);
        off = std::max(off, std::abs(pixelAt(image, x, y)[0] - expected));
      }
    }
    ASSERT_GT(largest, 0.0) << nameOf(light.type);
    const double relative = off / largest;
    if (!(relative <= worst)) worst = relative;
    EXPECT_TRUE(relative <= GetParam().bound) << nameOf(light.type) << ": " << relative;
  }
  RecordProperty("worst", std::to_string(worst));
}

INSTANTIATE_TEST_SUITE_P(Each, GlossyLobe, ::testing::ValuesIn(kLobes), [](const auto& i) { return i.param.name; });

// Two triangles are the rectangle that they make up.
TEST(AreaLight, twoTrianglesAreARectangle) {
  const Light whole = rectangleLight({0.2, -0.6, -2.4}, {-0.2, 0.6, -0.7}, 1.5, 0.9);
  const glm::dvec3 corner = whole.worldPosition - whole.worldU - whole.worldV;
  const glm::dvec3 u = 2.0 * whole.worldU, v = 2.0 * whole.worldV;
  for (const Material& material : {lambert(1.0f), glossy(IlluminationModel::blinnPhong, 30)}) {
    LitWall one(whole, material), two(whole, material);
    two.scene.lights = {triangleLight(corner, u, v), triangleLight(corner + u + v, -u, -v)};
    for (const Method method : {Method::phong, Method::whitted}) {
      const Image a = one.draw(method, 24, 18), b = two.draw(method, 24, 18);
      const Difference d = largestDifference(a, b, [](std::uint32_t, std::uint32_t) { return true; });
      EXPECT_TRUE(d.maximum <= (material.model == IlluminationModel::lambert ? 3e-6 : 2e-3)) << d;
    }
  }
}

// The same picture in every unit: lengths by powers of two change no bit.
TEST(AreaLight, anyUnitGivesTheSameBits) {
  for (const Light& light : crossingLights()) {
    const auto inUnit = [&](double unit) {
      LitWall wall(light, glossy(IlluminationModel::phong, 20));
      wall.scene.cameras[0].zNear *= unit;
      wall.scene.instances[0].worldFromObject = glm::dmat4(unit) * wall.scene.instances[0].worldFromObject;
      wall.scene.instances[0].worldFromObject[3][3] = 1.0;
      Light& l = wall.scene.lights[0];
      l.worldPosition *= unit, l.worldU *= unit, l.worldV *= unit, l.radius *= unit;
      return wall.draw(Method::whitted, 16, 12).picture().samples;
    };
    const auto one = inUnit(1.0);
    EXPECT_TRUE(inUnit(std::ldexp(1.0, -20)) == one) << nameOf(light.type);
    EXPECT_TRUE(inUnit(std::ldexp(1.0, 20)) == one) << nameOf(light.type);
  }
}

// A plate before half of the light: what is left is seen by brute force as well.
TEST(SoftShadow, penumbraOfAHalfPlaneAgreesWithBruteForce) {
  const double kPlateX = 2.0;
  for (const Light& light : {rectangleLight({3.0, 0.1, -1.6}, {-1, 0, -0.5}, 1.0, 1.2),
                             roundLight(LightType::areaSphere, {3.0, 0.0, -1.6}, {0, 0, -1}, 0.6),
                             roundLight(LightType::areaDisk, {3.0, 0.1, -1.6}, {-1, 0.1, -0.4}, 0.6)}) {
    LitWall wall(light);
    Primitive plate;
    plate.positions = {{kPlateX, -20, -20}, {kPlateX, 0, -20}, {kPlateX, 0, 20}, {kPlateX, -20, 20}};
    plate.normals.assign(4, {1, 0, 0});
    plate.indices = {0, 1, 2, 0, 2, 3};
    wall.scene.meshes.push_back({"plate", {plate}});
    MeshInstance instance;
    instance.mesh = 1;
    instance.instanceId = wall.scene.instanceCount++;
    wall.scene.instances.push_back(instance);
    const auto errors = [&](std::uint32_t samples) {
      const Image image = wall.draw(Method::whitted, 12, 16, [&](RenderSettings& s) { s.lightSamples = samples; });
      double sum2 = 0, penumbra = 0;
      for (std::uint32_t y = 0; y < 16; ++y) {
        for (std::uint32_t x = 0; x < 12; ++x) {
          const glm::dvec3 p = LitWall::placeOf(image, x, y);
          const auto seen = [&](const glm::dvec3& wi, const glm::dvec3& q) {
            const double t = (kPlateX - p.x) / (q.x - p.x);
            return p.y + t * (q.y - p.y) > 0 ? cosineAt(wi) : 0.0;
          };
          const double expected = overLight(light, p, 300, seen);
          const double whole = overLight(light, p, 100, [](const auto& wi, const auto&) { return cosineAt(wi); });
          if (expected > 0.02 * whole && expected < 0.98 * whole) ++penumbra;
          sum2 += std::pow((pixelAt(image, x, y)[0] - expected) / whole, 2);
        }
      }
      EXPECT_GT(penumbra, 20) << "too little of the wall is in penumbra";
      return std::sqrt(sum2 / 192);
    };
    const double few = errors(16), many = errors(1024);
    EXPECT_TRUE(few <= 0.06) << nameOf(light.type) << ": " << few;
    EXPECT_TRUE(many <= 0.004) << nameOf(light.type) << ": " << many;
    EXPECT_LT(many, 0.4 * few) << nameOf(light.type);
    RecordProperty(std::string(nameOf(light.type)) + "16", std::to_string(few));
    RecordProperty(std::string(nameOf(light.type)) + "1024", std::to_string(many));
  }
}

// Without blockers shadow rays change no bit: the ratio is 1 exactly, whatever the samples.
TEST(SoftShadow, unshadowedIsFreeOfNoise) {
  for (const Light& light : crossingLights()) {
    const LitWall wall(light, glossy(IlluminationModel::phong, 20));
    const auto drawn = [&](bool shadows, std::uint64_t seed) {
      return wall
          .draw(Method::whitted, 24, 18,
                [&](RenderSettings& s) {
                  s.shadows = shadows;
                  s.seed = seed;
                })
          .picture()
          .samples;
    };
    const auto plain = drawn(false, 0);
    EXPECT_TRUE(drawn(true, 0) == plain) << nameOf(light.type);
    EXPECT_TRUE(drawn(true, 5) == plain) << nameOf(light.type);
  }
}

}  // namespace
}  // namespace crosslight::testing

// Light from all around: furnaces, a single bright texel, which way is where, and how rays are sent into it.
#include "support/area_stage.h"
#include "upload/environment_tables.h"

namespace crosslight::testing {
namespace {

std::shared_ptr<EnvironmentMap> constantMap(std::uint32_t width, const glm::vec3& radiance) {
  auto map = std::make_shared<EnvironmentMap>();
  map->width = width;
  map->height = width / 2;
  map->radiance.assign(std::size_t{width} * map->height, radiance);
  return map;
}

// The wall z = -3 before the camera, without lights.
struct SurroundedWall : Stage {
  SurroundedWall(std::shared_ptr<const EnvironmentMap> map, const Material& material) {
    addWall(-3.0, add(material));
    for (int axis = 0; axis < 2; ++axis) scene.instances[0].worldFromObject[axis] /= 64.0;
    scene.atmosphere.environment = {"made in a test", 1.0, 0.0, std::move(map)};
  }
};

const std::vector<Method> kLit = {Method::flat, Method::gouraud, Method::phong, Method::whitted};

TEST(Environment, whiteFurnaceIsWhite) {
  for (const float radiance : {1.0f, 0.25f, 100.0f}) {
    const SurroundedWall wall(constantMap(8, glm::vec3(radiance)), lambert(static_cast<float>(1.0 / kTestPi)));
    for (const Method method : kLit) {
      // Three roundings: of 1/pi, of pi, and of their product.
      EXPECT_NEAR(wall.center(method, 0)[0] / radiance, 1.0, 2e-7) << nameOf(method) << " under " << radiance;
    }
  }
}

Material metal(float roughness) {
  Material m;
  m.metallicFactor = 1.0f;
  m.perceptualRoughnessFactor = roughness;
  return m;
}

// A white metal reflects what single scattering leaves: the lobe's integral, by brute force.
TEST(Environment, metalInAFurnaceReflectsTheLobesIntegral) {
  for (const float roughness : {0.1f, 0.3f, 0.5f, 0.8f, 1.0f}) {
    const double a = std::max(1e-3, std::pow(static_cast<double>(roughness), 2)), a2 = a * a;
    double expected = 0;
    constexpr int kSteps = 4000;
    for (int i = 0; i < kSteps; ++i) {  // along the normal: by the half vector's angle, spread as the distribution is
      const double u = (i + 0.5) / kSteps, tangent2 = a2 * u / (1 - u), c = 1 / std::sqrt(1 + tangent2);
      const double nl = 2 * c * c - 1;
      if (nl <= 0) continue;
      const double v = 0.5 / (nl * std::sqrt(1 - a2 + a2) + std::sqrt(nl * nl * (1 - a2) + a2));
      expected += v * nl * 4 / kSteps;
    }
    const SurroundedWall wall(constantMap(8, glm::vec3(1.0f)), metal(roughness));
    for (const Method method : {Method::phong, Method::whitted}) {
      EXPECT_NEAR(wall.center(method, 0)[0], expected, 3e-3) << roughness << " by " << nameOf(method);
    }
  }
}

// All light in one texel: a directional light from its middle. The map of irradiance is interpolated over 2.8 degrees.
TEST(Environment, oneBrightTexelIsADirectionalLight) {
  const std::pair<std::uint32_t, std::uint32_t> places[] = {{0, 16}, {5, 13}, {63, 18}, {10, 10}, {2, 24}, {12, 14}};
  for (const auto& [x, y] : places) {
    auto map = constantMap(64, glm::vec3(0.0f));
    const double solidAngle = texelSolidAngle(*map, y);
    map->radiance[std::size_t{y} * 64 + x] = glm::vec3(static_cast<float>(1.0 / solidAngle));
    const glm::dvec3 towards = environmentDirection((x + 0.5) / 64, (y + 0.5) / 32);
    ASSERT_GT(towards.z, 0.1) << "the wall faces +Z";
    const SurroundedWall wall(map, lambert(1.0f));
    SurroundedWall sun(constantMap(8, glm::vec3(0.0f)), lambert(1.0f));
    sun.scene.atmosphere.environment = {};
    Light light;
    light.type = LightType::directional;
    light.worldDirection = -towards;
    sun.scene.lights = {light};
    for (const Method method : kLit) {
      EXPECT_NEAR(wall.center(method, 0)[0], sun.center(method, 0)[0], 2e-3)
          << "texel " << x << ", " << y << " by " << nameOf(method);
    }
  }
}

// Red ahead (-Z), green to the right (+X), blue behind, white to the left, black above and gray below.
std::shared_ptr<const EnvironmentMap> signpost() {
  auto map = constantMap(64, glm::vec3(0.0f));
  const glm::vec3 colors[4] = {{0, 0, 1}, {1, 1, 1}, {1, 0, 0}, {0, 1, 0}};
  for (std::uint32_t y = 0; y < 32; ++y) {
    for (std::uint32_t x = 0; x < 64; ++x) {
      glm::vec3& c = map->radiance[std::size_t{y} * 64 + x];
      if (y >= 8) c = y < 24 ? colors[((x + 8) % 64) / 16] : glm::vec3(0.5f);
    }
  }
  return map;
}

TEST(Environment, aheadIsMinusZAndRightIsPlusX) {
  struct View {
    glm::dvec3 back, right;
    double rotation;
    glm::vec3 color;
  };
  const double quarter = kTestPi / 2;
  const View views[] = {{{0, 0, 1}, {1, 0, 0}, 0, {1, 0, 0}},      {{-1, 0, 0}, {0, 0, 1}, 0, {0, 1, 0}},
                        {{0, 0, -1}, {-1, 0, 0}, 0, {0, 0, 1}},    {{1, 0, 0}, {0, 0, -1}, 0, {1, 1, 1}},
                        {{0, -1, 0}, {1, 0, 0}, 0, {0, 0, 0}},     {{0, 1, 0}, {1, 0, 0}, 0, {0.5, 0.5, 0.5}},
                        {{0, 0, 1}, {1, 0, 0}, quarter, {0, 1, 0}}};
  for (const View& view : views) {
    Stage stage;
    stage.addWall(500.0, stage.add(emitter(1.0f)));
    stage.scene.atmosphere.environment = {"made in a test", 2.0, view.rotation, signpost()};
    glm::dmat4& camera = stage.scene.cameras[0].worldFromCamera;
    camera = glm::dmat4(glm::dvec4(view.right, 0), glm::dvec4(glm::cross(view.back, view.right), 0),
                        glm::dvec4(view.back, 0), glm::dvec4(0, 100, 0, 1));
    for (const Method method : kLit) {
      const auto pixel = stage.center(method, 0);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(pixel[static_cast<std::size_t>(c)], 2 * view.color[c], 1e-6)
            << nameOf(method) << " looking along " << -view.back.x << " " << -view.back.y << " " << -view.back.z;
      }
    }
  }
}

// A mirror shows what is behind the camera, a clear pane what is ahead.
TEST(Environment, mirroredAndStraightRaysSeeIt) {
  Stage mirror;
  Material m = emitter(0.0f);
  m.classic.reflectionFactor = glm::vec3(1.0f);
  mirror.addWall(-3.0, mirror.add(m));
  mirror.scene.atmosphere.environment = {"made in a test", 1.0, 0.0, signpost()};
  const auto reflected = mirror.center(Method::whitted, 1);
  EXPECT_NEAR(reflected[0], 0.0, 1e-6);
  EXPECT_NEAR(reflected[2], 1.0, 1e-6);
  Stage pane;
  Material clear = emitter(0.0f);
  clear.classic.transparency = 0.75f;
  pane.addWall(-3.0, pane.add(clear));
  pane.scene.atmosphere.environment = {"made in a test", 1.0, 0.0, signpost()};
  EXPECT_NEAR(pane.center(Method::whitted, 1)[0], 0.75, 1e-6);
  EXPECT_NEAR(pane.center(Method::phong, 1)[0], 0.75, 1e-6);
}

// A plate that stands on the wall takes the light of one half.
TEST(Environment, halfOfItIsHidden) {
  SurroundedWall wall(constantMap(32, glm::vec3(1.0f)), lambert(static_cast<float>(1.0 / kTestPi)));
  Primitive plate;
  plate.positions = {{0.01f, -500, -500}, {0.01f, 500, -500}, {0.01f, 500, 500}, {0.01f, -500, 500}};
  plate.normals.assign(4, {-1, 0, 0});
  plate.indices = {0, 1, 2, 0, 2, 3};
  wall.scene.meshes.push_back({"plate", {plate}});
  MeshInstance instance;
  instance.mesh = 1;
  instance.instanceId = wall.scene.instanceCount++;
  wall.scene.instances.push_back(instance);
  RenderSettings s = settingsFor(Method::whitted, 9, 9);
  s.lightSamples = 1024;
  const double seen = pixelAt(render(device(), wall.scene, s).image, 4, 4)[0];
  EXPECT_NEAR(seen, 0.5, 0.01);
  s.lightSamples = 16;
  EXPECT_NEAR(pixelAt(render(device(), wall.scene, s).image, 4, 4)[0], 0.5, 0.2);
  s.shadows = false;
  EXPECT_NEAR(pixelAt(render(device(), wall.scene, s).image, 4, 4)[0], 1.0, 2e-7);
}

// Rays are sent by luminance: shares add up to 1, each is its texel's part of the light.
TEST(Environment, sharesAreThoseOfTheLightAndAddUpToOne) {
  auto map = constantMap(64, glm::vec3(0.0f));
  for (std::size_t i = 0; i < map->radiance.size(); ++i) {
    map->radiance[i] = glm::vec3(static_cast<float>(i * 7919 % 101), static_cast<float>(i % 7), i == 700 ? 5e4f : 0.0f);
  }
  const std::vector<glm::vec4> texels = environmentTexels(*map);
  double light = 0;
  const auto luminance = [&](std::size_t i) {
    return (map->radiance[i].r + map->radiance[i].g + map->radiance[i].b) / 3.0;
  };
  for (std::size_t i = 0; i < map->radiance.size(); ++i)
    light += luminance(i) * texelSolidAngle(*map, static_cast<std::uint32_t>(i / 64));
  double sum = 0, sphere = 0;
  for (std::uint32_t y = 0; y < 32; ++y) {
    const std::size_t rows = 64 * 32;
    const double row = texels[rows + y].x - (y > 0 ? texels[rows + y - 1].x : 0.0f);
    for (std::uint32_t x = 0; x < 64; ++x) {
      const std::size_t i = std::size_t{y} * 64 + x;
      const double column = texels[i].w - (x > 0 ? texels[i - 1].w : 0.0f);
      const double expected = luminance(i) * texelSolidAngle(*map, y) / light;
      EXPECT_NEAR(row * column, expected, 1e-7 + 1e-4 * expected) << x << ", " << y;
      sum += row * column;
      sphere += texelSolidAngle(*map, y);
    }
  }
  EXPECT_NEAR(sum, 1.0, 1e-6);
  EXPECT_NEAR(sphere, 4 * kTestPi, 1e-10);
}

}  // namespace
}  // namespace crosslight::testing

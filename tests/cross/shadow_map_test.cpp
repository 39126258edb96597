// Shadow maps: a flat receiver never shades itself, contact shadows lose no more than is stated, lights of every type
// agree with rays but for a band at shadows' edges, and neither cubes' seams nor folds leak.
#include <cmath>
#include <glm/geometric.hpp>

#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

constexpr std::uint32_t kSize = 128;

RenderSettings mapSettings(std::uint32_t filter, std::uint32_t size = 512) {
  RenderSettings s = settingsFor(Method::phong, kSize, kSize);
  s.rasterShadows = RasterShadows::maps;
  s.shadowMaps.filterSize = filter;
  s.shadowMaps.size = size;
  return s;
}

Primitive quad(const glm::vec3& middle, const glm::vec3& u, const glm::vec3& v) {
  Primitive p;
  p.positions = {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
  p.normals.assign(4, glm::normalize(glm::cross(u, v)));
  p.indices = {0, 1, 2, 0, 2, 3};
  return p;
}

// White, diffuse, two-sided meshes before a camera that looks from `eye` to the origin.
Scene sceneOf(std::vector<Primitive> primitives, const glm::dvec3& eye) {
  Scene scene;
  Material material;
  material.model = IlluminationModel::lambert;
  material.classic.ambientFactor = glm::vec3(0.0f);
  material.classic.diffuseFactor = glm::vec3(1.0f);
  material.doubleSided = true;
  scene.materials = {material};
  for (Primitive& p : primitives) {
    MeshInstance instance;
    instance.mesh = static_cast<int>(scene.meshes.size());
    instance.instanceId = static_cast<std::uint32_t>(scene.meshes.size());
    scene.instances.push_back(instance);
    scene.meshes.push_back({"", {std::move(p)}});
  }
  scene.instanceCount = static_cast<std::uint32_t>(scene.instances.size());
  const glm::dvec3 back = glm::normalize(eye);
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0.01), back));
  Camera camera;
  camera.worldFromCamera = glm::dmat4(glm::dmat3(right, glm::cross(back, right), back));
  camera.worldFromCamera[3] = glm::dvec4(eye, 1.0);
  camera.zNear = 0.01 * glm::length(eye);
  scene.cameras = {camera};
  return scene;
}

Light lampOf(LightType type, const glm::dvec3& position) {
  Light lamp;
  lamp.type = type;
  lamp.classic = ClassicLight{};
  lamp.worldPosition = position;
  lamp.worldDirection = -glm::normalize(position);
  if (type == LightType::spot) lamp.classic->spotCutoff = 50.0f;
  return lamp;
}

std::size_t darkened(const Scene& scene, const RenderSettings& settings) {
  RenderSettings plain = settings;
  plain.rasterShadows = RasterShadows::off;
  const std::vector<float> with = render(device(), scene, settings).image.picture().samples;
  const std::vector<float> without = render(device(), scene, plain).image.picture().samples;
  std::size_t count = 0, lit = 0;
  for (std::size_t i = 0; i < with.size(); i += 4) {
    lit += without[i] > 0.0f;
    count += with[i] != without[i];
  }
  EXPECT_GT(lit, with.size() / 4 / 8) << "hardly anything is lit";
  return count;
}

const char* nameOf(LightType type) {
  return type == LightType::point ? "point" : type == LightType::spot ? "spot" : "directional";
}

// Light from straight above down to three degrees above the plane, far and near, in small and in huge units.
TEST(ShadowMaps, noFlatReceiverShadesItself) {
  for (const double unit : {1.0, std::ldexp(1.0, -20), std::ldexp(1.0, 20)}) {
    const auto u = static_cast<float>(unit);
    Scene scene = sceneOf({quad(glm::vec3(0.0f), {3 * u, 0, 0}, {0, 0, -3 * u})}, glm::dvec3(2, 5, 4) * unit);
    for (const LightType type : {LightType::point, LightType::spot, LightType::directional}) {
      for (const double degrees : {87.0, 60.0, 20.0, 3.0}) {
        for (const double distance : {1.5, 6.0, 40.0, 400.0}) {
          const double angle = degrees * 3.14159265358979 / 180;
          const glm::dvec3 towards(std::cos(angle) * 0.8, std::sin(angle), std::cos(angle) * 0.6);
          scene.lights = {lampOf(type, towards * distance * unit)};
          for (const std::uint32_t filter : {1u, 5u}) {
            if (unit != 1.0 && filter == 1u) continue;
            const std::size_t wrong = darkened(scene, mapSettings(filter, 256));
            EXPECT_EQ(wrong, 0u) << nameOf(type) << ", " << degrees << " degrees, distance " << distance << ", filter "
                                 << filter << ", unit " << unit;
          }
        }
      }
    }
  }
}

// The middle of the floor, straight below a sheet that hangs `height` above it; the lamp is straight above, as is the
// camera, which sees through the back of the sheet.
bool shadesTheFloor(double height, std::uint32_t filter) {
  const auto h = static_cast<float>(height);
  Scene scene = sceneOf({quad({0, 0, 0}, {3, 0, 0}, {0, 0, -3}), quad({0, h, 0}, {-1, 0, 0}, {0, 0, -1})}, {0, 6, 0});
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].doubleSided = false;
  scene.meshes[1].primitives[0].material = 1;
  scene.lights = {lampOf(LightType::spot, {0, 8, 0})};
  const Image image = render(device(), scene, mapSettings(filter)).image;
  EXPECT_GT(pixelAt(image, 2, 2)[0], 0.3f) << "the floor is lit beside the sheet";
  return pixelAt(image, kSize / 2, kSize / 2)[0] == 0.0f;
}

TEST(ShadowMaps, contactShadowsLoseNoMoreThanTheStatedOffset) {
  for (const std::uint32_t filter : {1u, 3u, 5u}) {
    const double guard = 0.5 * filter + 1.5;
    const double texel = 2 * std::tan(50.0 * 3.14159265358979 / 180) * 8.0 / (512 - 2 * guard);
    const double offset = 0.5 * (filter + 1) * texel;
    EXPECT_TRUE(shadesTheFloor(1.05 * offset, filter)) << "filter " << filter;
    EXPECT_FALSE(shadesTheFloor(0.9 * offset, filter)) << "filter " << filter << ": the offset is not what is stated";
  }
}

// How far pixels must lie from any change of the picture by rays to be compared: the filter's texels at this size.
constexpr std::uint32_t kBand = 3, kWide = 224;

class MapsAgainstRays : public ::testing::TestWithParam<std::string> {};

TEST_P(MapsAgainstRays, agreeBesideShadowsEdges) {
  const Scene scene = sceneNamed(GetParam());
  RenderSettings s = mapSettings(3, 1024);
  s.width = s.height = kWide;
  s.aovs = {"geometricNormal", "primitiveId", "instanceId"};
  const Image maps = render(device(), scene, s).image;
  s.rasterShadows = RasterShadows::rays;
  const Image rays = render(device(), scene, s).image;
  s.rasterShadows = RasterShadows::off;
  const Image lit = render(device(), scene, s).image;
  const std::vector<float>& normals = rays.find("geometricNormal")->samples;
  const std::vector<std::uint32_t>& ids = rays.find("instanceId")->integers;
  const auto lost = [&](std::uint32_t x, std::uint32_t y, std::size_t c) {
    return pixelAt(lit, x, y)[c] - pixelAt(rays, x, y)[c];
  };
  // Shadows' edges, silhouettes and folds within the band.
  const auto isPlain = [&](std::uint32_t x, std::uint32_t y) {
    const std::size_t at = std::size_t{y} * kWide + x;
    for (std::uint32_t v = y - kBand; v <= y + kBand; ++v) {
      for (std::uint32_t u = x - kBand; u <= x + kBand; ++u) {
        const std::size_t other = std::size_t{v} * kWide + u;
        if (ids[at] != ids[other]) return false;
        float cosine = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          cosine += normals[3 * at + c] * normals[3 * other + c];
          if (std::abs(lost(u, v, c) - lost(x, y, c)) > 0.03f) return false;
        }
        if (cosine < 0.5f) return false;
      }
    }
    return true;
  };
  std::size_t compared = 0, same = 0, shaded = 0;
  for (std::uint32_t y = kBand; y + kBand < kWide; ++y) {
    for (std::uint32_t x = kBand; x + kBand < kWide; ++x) {
      if (!isPlain(x, y)) continue;
      ++compared;
      double difference = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        difference = std::max<double>(difference, std::abs(pixelAt(maps, x, y)[c] - pixelAt(rays, x, y)[c]));
        shaded += lost(x, y, c) > 0;
      }
      same += difference <= 2e-3;
    }
  }
  EXPECT_GT(compared, kWide * kWide / 6u);
  EXPECT_GT(shaded, 100u) << "nothing is in shadow";
  EXPECT_TRUE(static_cast<double>(same) >= 0.99 * static_cast<double>(compared)) << same << " of " << compared;
}

INSTANTIATE_TEST_SUITE_P(Scenes, MapsAgainstRays,
                         ::testing::Values("showcase/three_lights", "feature/phong", "feature/directional",
                                           "feature/directional_classic", "feature/spot", "feature/point",
                                           "feature/alpha_mask", "feature/transparency", "showcase/cornell",
                                           "showcase/teapot"),
                         [](const auto& i) {
                           std::string name = i.param;
                           std::replace(name.begin(), name.end(), '/', '_');
                           return name;
                         });

// A closed room about a lamp: nothing of it is in shadow, whatever face, edge or corner of the cube a wall's point
// falls on. But for folds of 90 degrees, which are beyond the stated 45: no farther from them than the filter reaches.
TEST(ShadowMaps, aRoomHasNoSeams) {
  std::vector<Primitive> walls;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-2.0f, 2.0f}) {
      glm::vec3 middle(0.0f), u(0.0f), v(0.0f);
      middle[axis] = side;
      u[(axis + 1) % 3] = 2.0f;
      v[(axis + 2) % 3] = 2.0f;
      walls.push_back(quad(middle, u, v));
    }
  }
  Scene scene = sceneOf(walls, {0.3, 0.2, 1.9});
  scene.cameras[0].yFov = 2.0;
  scene.cameras[0].zNear = 0.001;
  for (const glm::dvec3& at : {glm::dvec3(0.0), glm::dvec3(0.31, -0.17, 0.23)}) {
    scene.lights = {lampOf(LightType::point, at)};
    for (const std::uint32_t filter : {1u, 3u, 5u}) {
      RenderSettings s = mapSettings(filter);
      s.aovs = {"position"};
      const Image with = render(device(), scene, s).image;
      s.rasterShadows = RasterShadows::off;
      const Image without = render(device(), scene, s).image;
      // A texel at the far wall, times the diagonal of the filter and what a slanted wall makes of it.
      const double reach = 0.5 * (filter + 1) * std::sqrt(2.0) * 2 * 2.4 / 500 * 2;
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < std::size_t{kSize} * kSize; ++i) {
        if (with.picture().samples[4 * i] == without.picture().samples[4 * i]) continue;
        std::array<double, 3> p{};
        for (std::size_t c = 0; c < 3; ++c) p[c] = std::abs(double{with.find("position")->samples[3 * i + c]});
        std::sort(p.begin(), p.end());
        wrong += 2.0 - p[1] > reach;
      }
      EXPECT_EQ(wrong, 0u) << "filter " << filter;
    }
  }
}

// Lamps whose half width is r: a point's size is a setting, others have their own.
Light lampOfSize(LightType type, double r, const glm::dvec3& position) {
  Light lamp = lampOf(type, position);
  if (type == LightType::spot) return lamp;
  lamp.classic.reset();
  lamp.worldDirection = {0.0, -1.0, 0.0};
  lamp.worldU = {r, 0.0, 0.0};
  lamp.worldV = {0.0, 0.0, -r};
  lamp.radius = r;
  return lamp;
}

class Penumbra : public ::testing::TestWithParam<LightType> {};

// Soft shadows: the penumbra of a half plane's edge at height b below a lamp at height a is 2 r b / (a - b) wide.
TEST_P(Penumbra, isAsWideAsTheLightIsLarge) {
  const double a = 8.0, b = 2.0, r = 0.4;
  Scene scene = sceneOf({quad({0, 0, 0}, {4, 0, 0}, {0, 0, -4}), quad({-2.5f, float(b), 0}, {2.5f, 0, 0}, {0, 0, -4})},
                        {0, 7, 0.01});
  scene.lights = {lampOfSize(GetParam(), r, {0, a, 0})};
  scene.cameras[0].worldFromCamera = glm::dmat4(glm::dmat3({1, 0, 0}, {0, 0, -1}, {0, 1, 0}));
  scene.cameras[0].worldFromCamera[3] = {0.3, 1.5, 0.0, 1.0};
  scene.cameras[0].zNear = 0.01;
  scene.cameras[0].yFov = 1.6;
  // The sheet's edge at x = 0 throws the shadow's edge to x = 0; the camera looks down from below the sheet.
  RenderSettings s = mapSettings(3, 1024);
  s.shadowMaps.soft = true;
  s.shadowMaps.lightRadius = GetParam() == LightType::spot ? r : 0.0;
  s.aovs = {"position"};
  const Image soft = render(device(), scene, s).image;
  s.rasterShadows = RasterShadows::off;
  const Image lit = render(device(), scene, s).image;
  const std::vector<float>& positions = soft.find("position")->samples;
  const std::uint32_t row = kSize / 2;
  double first = 1e9, last = -1e9;
  for (std::uint32_t x = 0; x < kSize; ++x) {
    const double share = pixelAt(soft, x, row)[0] / pixelAt(lit, x, row)[0];
    const double at = positions[3 * (std::size_t{row} * kSize + x)];
    if (share > 0.05) first = std::min(first, at);
    if (share < 0.95) last = std::max(last, at);
  }
  const double width = 2 * r * b / (a - b);
  EXPECT_NEAR(last - first, 0.9 * width, 0.2 * width) << "from " << first << " to " << last;
}

INSTANTIATE_TEST_SUITE_P(Lamps, Penumbra,
                         ::testing::Values(LightType::spot, LightType::areaRectangle, LightType::areaDisk,
                                           LightType::areaSphere));

}  // namespace
}  // namespace crosslight::testing

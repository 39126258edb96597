// Shadows of raster methods by rays: Phong shading against the tracer on every scene of the project, per-vertex methods
// against a segment test in double precision.
#include <cmath>
#include <glm/geometric.hpp>

#include "cross/same_picture.h"
#include "structs.h"

namespace crosslight::testing {
namespace {

constexpr std::uint32_t kWidth = 160, kHeight = 120;
constexpr double kSameLight = 2e-3;    // as in raster_ray_test.cpp
constexpr double kSameShadow = 0.999;  // of the pixels away from edges
// Light that is lost changes by more than this from pixel to pixel at shadows' edges only: the scenes' highlights and
// cosines change less at this size.
constexpr double kShadowEdge = 0.02;

RenderSettings settingsOf(Method method, bool shadows) {
  RenderSettings s = settingsFor(method, kWidth, kHeight);
  s.reflection = s.refraction = false;
  s.shadows = shadows;
  s.rasterShadows = shadows ? RasterShadows::rays : RasterShadows::off;
  s.aovs = {"instanceId", "primitiveId", "materialId", "albedo"};
  s.lightSamples = 0;  // rays to the middle of a light with an area, as in raster
  return s;
}

// How much darker shadows make a picture, and where that changes from a pixel to its neighbours.
class Lost {
 public:
  Lost(const Image& with, const Image& without) : with_(with), without_(without) {}

  double at(std::uint32_t x, std::uint32_t y, std::size_t c) const {
    return static_cast<double>(pixelAt(without_, x, y)[c]) - pixelAt(with_, x, y)[c];
  }
  bool anyAt(std::uint32_t x, std::uint32_t y) const { return at(x, y, 0) > 0 || at(x, y, 1) > 0 || at(x, y, 2) > 0; }
  bool isEdge(std::uint32_t x, std::uint32_t y) const {
    for (std::uint32_t v = y - 1; v <= y + 1; ++v) {
      for (std::uint32_t u = x - 1; u <= x + 1; ++u) {
        for (std::size_t c = 0; c < 3; ++c) {
          if (std::abs(at(u, v, c) - at(x, y, c)) > kShadowEdge) return true;
        }
      }
    }
    return false;
  }

 private:
  const Image &with_, &without_;
};

class RasterShadow : public ::testing::TestWithParam<std::string> {};

TEST_P(RasterShadow, isThatOfTheTracer) {
  Scene scene = asMeshes(sceneNamed(GetParam()));
  scene.atmosphere.smoke = {};  // shadows that fall into smoke are the tracer's alone
  const Image raster = render(device(), scene, settingsOf(Method::phong, true)).image;
  const Image rasterLit = render(device(), scene, settingsOf(Method::phong, false)).image;
  const Image rays = render(device(), scene, settingsOf(Method::whitted, true)).image;
  const Image raysLit = render(device(), scene, settingsOf(Method::whitted, false)).image;
  const Interior insideRaster(raster), insideRays(rays);
  const Steady isSteady(raster, rays);
  const Lost lostRaster(raster, rasterLit), lostRays(rays, raysLit);
  std::size_t interior = 0, compared = 0, same = 0, inShadow = 0;
  double worst = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      if (!insideRaster(x, y) || !insideRays(x, y) || insideRaster.idAt(x, y) != insideRays.idAt(x, y)) continue;
      ++interior;
      if (!isSteady(x, y)) continue;
      if (lostRaster.isEdge(x, y) || lostRays.isEdge(x, y)) continue;
      ++compared;
      inShadow += lostRays.anyAt(x, y);
      double difference = 0;
      for (std::size_t c = 0; c < 3; ++c)
        difference = std::max(difference, std::abs(double{pixelAt(raster, x, y)[c]} - pixelAt(rays, x, y)[c]));
      same += difference <= kSameLight;
      worst = std::max(worst, difference);
    }
  }
  ASSERT_GT(interior, 0u);
  EXPECT_GT(compared, interior / 2) << "of " << interior << " interior pixels";
  EXPECT_TRUE(static_cast<double>(same) >= kSameShadow * static_cast<double>(compared))
      << same << " of " << compared << " pixels are the same, " << inShadow << " in shadow; worst by " << worst;
}

INSTANTIATE_TEST_SUITE_P(Scenes, RasterShadow, ::testing::ValuesIn(allSceneNames()), [](const auto& i) {
  std::string name = i.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

// A floor of squares, y = 0, from -4 to 4 in both directions; above it a shade, y = 1, one unit across.
constexpr int kSquares = 16;
constexpr double kHalf = 4.0, kShade = 1.0;
const glm::dvec3 kLamp(6.1, 5.0, 3.3);

Primitive squares() {
  Primitive p;
  for (int j = 0; j <= kSquares; ++j) {
    for (int i = 0; i <= kSquares; ++i) {
      const double step = 2 * kHalf / kSquares;
      p.positions.emplace_back(i * step - kHalf, 0.0, j * step - kHalf);
      p.normals.emplace_back(0.0f, 1.0f, 0.0f);
    }
  }
  for (std::uint32_t j = 0; j < kSquares; ++j) {
    for (std::uint32_t i = 0; i < kSquares; ++i) {
      const std::uint32_t a = j * (kSquares + 1) + i, b = a + kSquares + 1;
      for (const std::uint32_t index : {a, b, b + 1, a, b + 1, a + 1}) p.indices.push_back(index);
    }
  }
  return p;
}

Scene floorUnderAShade() {
  Scene scene;
  Material material;
  material.model = IlluminationModel::lambert;
  material.classic.ambientFactor = glm::vec3(0.0f);
  material.classic.diffuseFactor = glm::vec3(1.0f);
  material.doubleSided = true;
  scene.materials = {material};
  Primitive shade;
  const auto h = static_cast<float>(kShade / 2);
  shade.positions = {{-h, 1, -h}, {-h, 1, h}, {h, 1, h}, {h, 1, -h}};
  shade.normals.assign(4, {0.0f, 1.0f, 0.0f});
  shade.indices = {0, 1, 2, 0, 2, 3};
  scene.meshes = {{"floor", {squares()}}, {"shade", {shade}}};
  scene.instances.resize(2);
  scene.instances[1].mesh = 1;
  scene.instances[1].instanceId = 1;
  scene.instanceCount = 2;
  Light lamp;
  lamp.classic = ClassicLight{};
  lamp.worldPosition = kLamp;
  scene.lights = {lamp};
  Camera camera;  // from above
  camera.worldFromCamera = glm::dmat4(glm::dmat3({1, 0, 0}, {0, 0, -1}, {0, 1, 0}));
  camera.worldFromCamera[3] = {0.0, 9.0, 0.0, 1.0};
  scene.cameras = {camera};
  return scene;
}

bool isShaded(const glm::dvec3& p) {
  const double t = (1.0 - p.y) / (kLamp.y - p.y);
  const glm::dvec3 at = p + t * (kLamp - p);
  return std::abs(at.x) < kShade / 2 && std::abs(at.z) < kShade / 2;
}

// What is lit is brighter than black.
TEST(RasterShadowOfVertices, isWhereTheVertexIsShaded) {
  const Scene scene = floorUnderAShade();
  for (const FlatVertex vertex : {FlatVertex::first, FlatVertex::last, FlatVertex::centroid}) {
    RenderSettings s = settingsFor(Method::flat, 200, 200);
    s.flatVertex = vertex;
    s.rasterShadows = RasterShadows::rays;
    s.aovs = {"instanceId", "primitiveId"};
    const Image image = render(device(), scene, s).image;
    const Primitive floor = squares();
    const std::vector<std::uint32_t>& primitives = image.find("primitiveId")->integers;
    const std::vector<std::uint32_t>& instances = image.find("instanceId")->integers;
    std::size_t shaded = 0, wrong = 0, seen = 0;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      if (instances[i] != 0) continue;
      const auto corner = [&](std::size_t k) {
        return glm::dvec3(floor.positions[floor.indices[3 * std::size_t{primitives[i]} + k]]);
      };
      const glm::dvec3 at = vertex == FlatVertex::first  ? corner(0)
                            : vertex == FlatVertex::last ? corner(2)
                                                         : (corner(0) + corner(1) + corner(2)) / 3.0;
      const bool expected = isShaded(at);
      ++seen;
      shaded += expected;
      wrong += (image.picture().samples[4 * i] == 0.0f) != expected;
    }
    EXPECT_GT(seen, 10000u);
    EXPECT_GT(shaded, 100u);
    EXPECT_EQ(wrong, 0u) << "of " << seen << " pixels, " << shaded << " in the shade, vertex "
                         << static_cast<int>(vertex);
  }
}

// AOVs: the parts of direct light have the picture's shadows.
TEST(RasterShadowInAovs, addsUpToThePicture) {
  const Scene scene = sceneNamed("showcase/three_lights");
  for (const Method method : {Method::flat, Method::gouraud, Method::phong}) {
    RenderSettings s = settingsFor(method, 80, 60);
    s.rasterShadows = RasterShadows::rays;
    s.aovs = {"ambient", "diffuse", "specular", "emission"};
    const Image image = render(device(), scene, s).image;
    double worst = 0;
    for (std::size_t i = 0; i < std::size_t{80} * 60; ++i) {
      if (image.picture().samples[4 * i + 3] == 0.0f) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (const std::string& part : s.aovs) sum += image.find(part)->samples[3 * i + c];
        worst = std::max(worst, std::abs(sum - image.picture().samples[4 * i + c]));
      }
    }
    // Gouraud interpolates the picture's colors as one, the AOVs' parts each by itself: light of up to 1 at vertices,
    // a few dozen roundings each, and corners far outside of the view.
    EXPECT_TRUE(worst <= 1e-4) << nameOf(method) << ": parts and picture differ by " << worst;
  }
}

}  // namespace
}  // namespace crosslight::testing

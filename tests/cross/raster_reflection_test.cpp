// Mirrors of the raster methods against the tracer, one reflection deep: flat ones are the same picture, the background
// is what a mirror shows that has nothing before it, and a cube map is right in the room that it stands in.
#include <cmath>
#include <glm/geometric.hpp>

#include "cross/same_picture.h"
#include "structs.h"

namespace crosslight::testing {
namespace {

constexpr std::uint32_t kWidth = 160, kHeight = 120;
constexpr double kSameLight = 2e-3;  // as in raster_ray_test.cpp

RenderSettings settingsOf(Method method, RasterReflections reflections = RasterReflections::off) {
  RenderSettings s = settingsFor(method, kWidth, kHeight);
  s.maxDepth = 1;
  s.rasterShadows = method == Method::whitted ? RasterShadows::off : RasterShadows::rays;
  s.rasterReflections = reflections;
  s.aovs = {"materialId"};
  return s;
}

struct Compared {
  std::size_t pixels = 0, same = 0;
  double worst = 0, sum = 0;
  double share() const { return static_cast<double>(same) / static_cast<double>(pixels); }
  double mean() const { return sum / static_cast<double>(pixels); }
};

// Pixels that show a mirror in both pictures.
Compared compareMirrors(const Scene& scene, const Image& raster, const Image& rays) {
  Compared result;
  const auto& a = raster.find("materialId")->integers;
  const auto& b = rays.find("materialId")->integers;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] != b[i] || a[i] == shared::kNoId) continue;
    const Material& m = scene.materials[a[i]];
    if (m.classic.reflectionFactor == glm::vec3(0.0f)) continue;
    double difference = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      difference = std::max(difference,
                            std::abs(double{raster.picture().samples[4 * i + c]} - rays.picture().samples[4 * i + c]));
    }
    ++result.pixels;
    result.same += difference <= kSameLight;
    result.worst = std::max(result.worst, difference);
    result.sum += difference;
  }
  return result;
}

Compared compareMethods(const Scene& scene, RasterReflections reflections,
                        const std::function<void(RenderSettings&)>& change = {}) {
  RenderSettings raster = settingsOf(Method::phong, reflections), rays = settingsOf(Method::whitted);
  if (change) change(raster), change(rays);
  return compareMirrors(scene, render(device(), scene, raster).image, render(device(), scene, rays).image);
}

// Edges of what is mirrored fall on one side of a pixel's center or on the other: this much may differ.
constexpr double kMirrored = 0.99;

TEST(FlatMirrors, areThoseOfTheTracer) {
  const Scene scene = asMeshes(sceneNamed("feature/flat_mirror"));
  const Compared all = compareMethods(scene, RasterReflections::mirrors);
  EXPECT_GT(all.pixels, 2000u);
  EXPECT_GT(all.share(), kMirrored) << "worst " << all.worst;
  EXPECT_LT(compareMethods(scene, RasterReflections::environment).share(), 0.8) << "something is before the mirror";
}

TEST(FlatMirrors, areSampledWhereTheTracerSamples) {
  const Scene scene = asMeshes(sceneNamed("feature/flat_mirror"));
  const Compared all = compareMethods(scene, RasterReflections::mirrors, [](RenderSettings& s) { s.spp = 4; });
  EXPECT_GT(all.share(), kMirrored) << "worst " << all.worst;
}

TEST(FlatMirrors, areSeenByParallelRaysToo) {
  Scene scene = asMeshes(sceneNamed("feature/flat_mirror"));
  Camera& camera = scene.cameras[0];
  camera.orthographic = true;
  camera.xMag = camera.yMag = 1.8;
  camera.zFar = 20.0;
  const Compared all = compareMethods(scene, RasterReflections::mirrors);
  EXPECT_GT(all.pixels, 2000u);
  EXPECT_GT(all.share(), kMirrored) << "worst " << all.worst;
}

TEST(FlatMirrors, areSeenThroughExponentialFogAlongTheWholeWay) {
  Scene scene = asMeshes(sceneNamed("feature/flat_mirror"));
  scene.atmosphere.fogMode = FogMode::exp;
  scene.atmosphere.fogDensity = 0.15;
  scene.atmosphere.fogColor = {0.6f, 0.5f, 0.4f};
  const Compared all = compareMethods(scene, RasterReflections::mirrors);
  EXPECT_GT(all.share(), kMirrored) << "worst " << all.worst;
}

TEST(FlatMirrors, standAnywhereAndInAnyUnit) {
  for (const double scale : {1.0 / 4096, 4096.0}) {
    Scene scene = asMeshes(sceneNamed("feature/flat_mirror"));
    const glm::dmat4 place = glm::dmat4(glm::dmat3(scale));
    for (MeshInstance& i : scene.instances) i.worldFromObject = place * i.worldFromObject;
    for (Light& light : scene.lights) light.worldPosition *= scale;
    for (glm::dvec3* corner : {&scene.worldBounds.lower, &scene.worldBounds.upper}) *corner *= scale;
    Camera& camera = scene.cameras[0];
    camera.worldFromCamera[3] = glm::dvec4(glm::dvec3(camera.worldFromCamera[3]) * scale, 1.0);
    camera.zNear *= scale;
    const Compared all = compareMethods(scene, RasterReflections::mirrors);
    EXPECT_GT(all.pixels, 2000u);
    EXPECT_GT(all.share(), kMirrored) << "scale " << scale << ", worst " << all.worst;
  }
}

// A single convex mirror: its rays meet nothing.
TEST(BackgroundMirrors, areExactWhereNothingIsBeforeThem) {
  Scene scene = asMeshes(sceneNamed("feature/mirror"));
  std::erase_if(scene.instances, [](const MeshInstance& i) { return i.name != "ball"; });
  const Compared all = compareMethods(scene, RasterReflections::environment);
  EXPECT_GT(all.pixels, 1000u);
  EXPECT_GT(all.share(), 0.999) << "worst " << all.worst;
}

// A room of glowing walls whose colors change smoothly, and in it a mirror away from its middle.
Primitive wallOf(int axis, float side) {
  constexpr int kSteps = 16;
  Primitive p;
  const int b = (axis + 1) % 3, c = (axis + 2) % 3;
  for (int j = 0; j <= kSteps; ++j) {
    for (int i = 0; i <= kSteps; ++i) {
      glm::vec3 at, n(0.0f);
      at[axis] = 2.0f * side;
      at[b] = 4.0f * static_cast<float>(i) / kSteps - 2.0f;
      at[c] = 4.0f * static_cast<float>(j) / kSteps - 2.0f;
      n[axis] = -side;
      p.positions.push_back(at);
      p.normals.push_back(n);
      p.colors.emplace_back(0.5f + 0.2f * at.x, 0.5f + 0.2f * at.y, 0.5f + 0.2f * at.z, 1.0f);
    }
  }
  for (std::uint32_t j = 0; j < kSteps; ++j) {
    for (std::uint32_t i = 0; i < kSteps; ++i) {
      const std::uint32_t at = j * (kSteps + 1) + i, above = at + kSteps + 1;
      for (const std::uint32_t index : {at, at + 1, above + 1, at, above + 1, above}) p.indices.push_back(index);
    }
  }
  return p;
}

Scene roomWithMirror() {
  Scene scene = asMeshes(sceneNamed("feature/mirror"));
  scene.lights.clear();
  scene.atmosphere.ambient = glm::vec3(0.0f);
  Material wall;
  wall.model = IlluminationModel::unlit;
  wall.doubleSided = true;
  scene.materials.push_back(wall);
  std::erase_if(scene.instances, [](const MeshInstance& i) { return i.name != "ball"; });
  scene.instances[0].worldFromObject[3] = {0.6, -0.7, -0.4, 1.0};
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      Primitive p = wallOf(axis, side);
      p.material = static_cast<int>(scene.materials.size()) - 1;
      MeshInstance instance;
      instance.name = "wall";
      instance.mesh = static_cast<int>(scene.meshes.size());
      instance.instanceId = scene.instanceCount++;
      scene.instances.push_back(instance);
      scene.meshes.push_back({"wall", {std::move(p)}});
    }
  }
  Camera& camera = scene.cameras[0];
  camera.worldFromCamera = glm::dmat4(1.0);
  camera.worldFromCamera[3] = {0.0, 0.0, 1.95, 1.0};
  camera.yFov = 1.5;
  camera.zNear = 0.01;
  return scene;
}

TEST(Probes, areRightInTheRoomThatTheyStandIn) {
  const Scene scene = roomWithMirror();
  const auto at = [&](std::uint32_t size) {
    return compareMethods(scene, RasterReflections::probes, [=](RenderSettings& s) { s.probeSize = size; });
  };
  const Compared coarse = at(16), fine = at(256);
  EXPECT_GT(fine.pixels, 1000u);
  // 0.8 per room and 256 pixels a wall: a texel is 0.003, and its quarter is what interpolation leaves at folds.
  EXPECT_LT(fine.mean(), 1e-3) << "worst " << fine.worst;
  EXPECT_LT(fine.mean(), coarse.mean());
  EXPECT_GT(compareMethods(scene, RasterReflections::environment).mean(), 0.1);
}

TEST(Probes, doNotHideWhatIsBehindTheMirrorItself) {
  const Scene scene = asMeshes(sceneNamed("feature/mirror"));
  const Compared probes = compareMethods(scene, RasterReflections::probes);
  const Compared background = compareMethods(scene, RasterReflections::environment);
  EXPECT_LT(probes.mean(), 0.5 * background.mean());
}

class EveryMethod : public ::testing::TestWithParam<Method> {};

// Whatever lights the surfaces, flat mirrors show the picture that the same method makes of them.
TEST_P(EveryMethod, showsItsOwnPictureInFlatMirrors) {
  const Scene scene = asMeshes(sceneNamed("feature/flat_mirror"));
  RenderSettings s = settingsOf(GetParam(), RasterReflections::mirrors);
  const Image with = render(device(), scene, s).image;
  s.rasterReflections = RasterReflections::off;
  const Image without = render(device(), scene, s).image;
  const auto& ids = with.find("materialId")->integers;
  std::size_t changed = 0, elsewhere = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const bool differs = with.picture().samples[4 * i] != without.picture().samples[4 * i];
    const bool mirror = ids[i] != shared::kNoId && scene.materials[ids[i]].name == "looking glass";
    changed += differs && mirror;
    elsewhere += differs && !mirror;
  }
  EXPECT_GT(changed, 2000u);
  EXPECT_EQ(elsewhere, 0u);
}

INSTANTIATE_TEST_SUITE_P(Raster, EveryMethod, ::testing::Values(Method::flat, Method::gouraud, Method::phong),
                         [](const auto& i) { return std::string(nameOf(i.param)); });

}  // namespace
}  // namespace crosslight::testing

// Raster against rays on every scene of the project: the same objects in the same pixels, the same light on them.
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

constexpr std::uint32_t kWidth = 160, kHeight = 120;
constexpr double kSameObject = 0.999;  // of interior pixels, as the issue asks
constexpr double kSameLight = 2e-3;    // largest difference on them

RenderSettings plainSettings(Method method) {
  RenderSettings s = settingsFor(method, kWidth, kHeight);
  s.shadows = s.reflection = s.refraction = false;  // what raster does not claim
  s.aovs = {"instanceId", "primitiveId", "materialId", "depth", "normal"};
  return s;
}

// Rays see shapes' meshes here, so that both worlds have the same geometry: analytic shapes have tests of their own.
Scene asMeshes(Scene scene) {
  for (MeshInstance& instance : scene.instances) instance.replacedByShape = false;
  std::vector<ShapeInstance> kept;
  for (const ShapeInstance& shape : scene.shapes) {
    const bool hasMesh = std::any_of(scene.instances.begin(), scene.instances.end(),
                                     [&](const MeshInstance& i) { return i.instanceId == shape.instanceId; });
    if (!hasMesh) kept.push_back(shape);
  }
  scene.shapes = kept;
  return scene;
}

class RasterRay : public ::testing::TestWithParam<std::string> {};

TEST_P(RasterRay, showTheSameObjectsInTheSameLight) {
  const Scene scene = asMeshes(sceneNamed(GetParam()));
  const Image raster = render(device(), scene, plainSettings(Method::phong)).image;
  const Image rays = render(device(), scene, plainSettings(Method::whitted)).image;
  const Interior insideRaster(raster), insideRays(rays);
  std::size_t interior = 0, same = 0;
  const auto counts = [&](std::uint32_t x, std::uint32_t y) {
    if (!insideRaster(x, y) || !insideRays(x, y)) return false;
    ++interior;
    if (insideRaster.idAt(x, y) != insideRays.idAt(x, y)) return false;
    ++same;
    return true;
  };
  const Difference d = largestDifference(raster, rays, counts);
  ASSERT_GT(interior, 0u);
  EXPECT_TRUE(static_cast<double>(same) >= kSameObject * static_cast<double>(interior))
      << same << " of " << interior << " interior pixels show the same object";
  EXPECT_TRUE(d.maximum <= kSameLight) << d;
}

INSTANTIATE_TEST_SUITE_P(Scenes, RasterRay, ::testing::ValuesIn(allSceneNames()), [](const auto& i) {
  std::string name = i.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

}  // namespace
}  // namespace crosslight::testing

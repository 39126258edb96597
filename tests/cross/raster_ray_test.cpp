// Raster against rays on every scene of the project: the same objects in the same pixels, the same light on them.
#include "cross/same_picture.h"
#include "structs.h"

namespace crosslight::testing {
namespace {

constexpr std::uint32_t kWidth = 160, kHeight = 120;
constexpr double kSameObject = 0.999;  // of interior pixels, as the issue asks
constexpr double kSameSurface =
    2e-3;                            // of the largest value: what 8 bits of sub-pixel position leave at grazing angles
constexpr double kSameLight = 2e-3;  // largest difference on them

RenderSettings plainSettings(Method method) {
  RenderSettings s = settingsFor(method, kWidth, kHeight);
  s.shadows = s.reflection = s.refraction = false;  // what raster does not claim
  s.aovs = {"instanceId", "primitiveId", "materialId",      "albedo", "depth",
            "position",   "normal",      "geometricNormal", "uv"};
  return s;
}

// Largest difference of one AOV over the pixels for which `counts` holds, relative to the AOV's largest value there.
template <class Counts>
double relativeDifference(const Image& a, const Image& b, const char* name, const Counts& counts) {
  const Layer& p = *a.find(name);
  const Layer& q = *b.find(name);
  double largest = 0, difference = 0;
  for (std::uint32_t y = 0; y < a.height; ++y) {
    for (std::uint32_t x = 0; x < a.width; ++x) {
      if (!counts(x, y)) continue;
      for (std::size_t c = 0; c < p.channels(); ++c) {
        const std::size_t at = (std::size_t{y} * a.width + x) * p.channels() + c;
        largest = std::max(largest, std::abs(static_cast<double>(q.samples[at])));
        difference = std::max(difference, std::abs(static_cast<double>(p.samples[at]) - q.samples[at]));
      }
    }
  }
  return largest > 0 ? difference / largest : difference;
}

class RasterRay : public ::testing::TestWithParam<std::string> {};

TEST_P(RasterRay, showTheSameObjectsInTheSameLight) {
  const Scene scene = asMeshes(sceneNamed(GetParam()));
  const Image raster = render(device(), scene, plainSettings(Method::phong)).image;
  const Image rays = render(device(), scene, plainSettings(Method::whitted)).image;
  const Interior insideRaster(raster), insideRays(rays);
  const Steady isSteady(raster, rays);
  const SteadyThrough isSteadyThrough(scene, rays);
  std::size_t interior = 0, same = 0;
  const auto counts = [&](std::uint32_t x, std::uint32_t y) {
    if (!insideRaster(x, y) || !insideRays(x, y)) return false;
    ++interior;
    if (insideRaster.idAt(x, y) != insideRays.idAt(x, y)) return false;
    ++same;
    return isSteady(x, y) && isSteadyThrough(x, y);
  };
  const Difference d = largestDifference(raster, rays, counts);
  ASSERT_GT(interior, 0u);
  EXPECT_GT(d.compared, interior / 2) << "of " << interior << " interior pixels";
  EXPECT_TRUE(static_cast<double>(same) >= kSameObject * static_cast<double>(interior))
      << same << " of " << interior << " interior pixels show the same object";
  EXPECT_TRUE(d.maximum <= kSameLight) << d;
  for (const char* aov : {"depth", "position", "normal", "geometricNormal", "uv"}) {
    const double difference = relativeDifference(raster, rays, aov, counts);
    EXPECT_TRUE(difference <= kSameSurface) << aov << " differs by " << difference << " of its largest value";
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, RasterRay, ::testing::ValuesIn(allSceneNames()), [](const auto& i) {
  std::string name = i.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

}  // namespace
}  // namespace crosslight::testing

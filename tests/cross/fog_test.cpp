// Raster against rays through fog, on scenes where several surfaces lie behind a pixel: the fog of each is the same.
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

constexpr double kSameLight = 2e-3;  // as without fog: raster_ray_test.cpp

TEST(FoggyRasterAndRays, agreeThroughTransparentThings) {
  for (const char* name : {"feature/alpha_blend", "feature/transparency", "feature/alpha_mask"}) {
    for (const FogMode mode : {FogMode::linear, FogMode::exp, FogMode::exp2}) {
      for (const FogDistance distance : {FogDistance::ray, FogDistance::depth}) {
        Scene scene = sceneNamed(name);
        scene.atmosphere.fogMode = mode;
        scene.atmosphere.fogColor = {0.4f, 0.7f, 0.3f};
        scene.atmosphere.fogStart = 3.0;
        scene.atmosphere.fogEnd = 9.0;
        scene.atmosphere.fogDensity = 0.15;
        for (MeshInstance& instance : scene.instances) instance.replacedByShape = false;
        scene.shapes.clear();
        RenderSettings settings = settingsFor(Method::phong, 120, 90);
        settings.shadows = settings.reflection = settings.refraction = false;
        settings.fogDistance = distance;
        settings.aovs = {"instanceId", "primitiveId"};
        const Image raster = render(device(), scene, settings).image;
        settings.method = Method::whitted;
        const Image rays = render(device(), scene, settings).image;
        const Interior inRaster(raster), inRays(rays);
        const auto& idsA = raster.find("primitiveId")->integers;
        const auto& idsB = rays.find("primitiveId")->integers;
        // Every pixel whose nearest surface both agree on; silhouettes of what shows through are a few beyond the
        // bound.
        std::size_t compared = 0, beyond = 0;
        for (std::uint32_t y = 0; y < 90; ++y) {
          for (std::uint32_t x = 0; x < 120; ++x) {
            const std::size_t at = std::size_t{y} * 120 + x;
            if (!inRaster(x, y) || !inRays(x, y) || idsA[at] != idsB[at]) continue;
            ++compared;
            const auto p = pixelAt(raster, x, y), q = pixelAt(rays, x, y);
            double worst = 0;
            for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(double{p[c]} - double{q[c]}));
            beyond += worst <= kSameLight ? 0 : 1;
          }
        }
        EXPECT_GT(compared, 8000u) << name;
        EXPECT_LE(static_cast<double>(beyond), 0.002 * static_cast<double>(compared)) << name;
      }
    }
  }
}

}  // namespace
}  // namespace crosslight::testing

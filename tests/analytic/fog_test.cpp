// Fog against its own formulas in double, on surfaces that emit and nothing else: what is left is the fog.
#include <cmath>
#include <glm/geometric.hpp>

#include "support/stage.h"

namespace crosslight::testing {
namespace {

constexpr double kRounding = 2e-6;  // NUMERICS R17: 1.8e-6 of the exponential, a few products
constexpr glm::vec3 kColor{0.5f, 0.25f, 1.0f};
constexpr Method kMethods[] = {Method::flat, Method::gouraud, Method::phong, Method::whitted};

Atmosphere fogOf(FogMode mode) {
  Atmosphere a;
  a.background = {0.0f, 1.0f, 0.0f};
  a.fogMode = mode;
  a.fogColor = kColor;
  a.fogStart = 1.0;
  a.fogEnd = 12.0;
  a.fogDensity = 0.125;
  return a;
}

// Share of the light that comes through, in double.
double clearOver(const Atmosphere& a, double distance) {
  switch (a.fogMode) {
    case FogMode::none:
      return 1.0;
    case FogMode::linear:
      return std::clamp((a.fogEnd - distance) / (a.fogEnd - a.fogStart), 0.0, 1.0);
    case FogMode::exp:
      return std::exp(-a.fogDensity * distance);
    case FogMode::exp2:
      return std::exp(-std::pow(a.fogDensity * distance, 2.0));
  }
  return 0.0;
}

double fogged(const Atmosphere& a, double light, double distance, int channel) {
  const double clear = clearOver(a, distance);
  return clear * light + (1.0 - clear) * static_cast<double>(kColor[channel]);
}

class FogLaw : public ::testing::TestWithParam<FogMode> {
 protected:
  FogLaw() : air(fogOf(GetParam())) { stage.scene.atmosphere = air; }
  void expectCenter(Method method, double expected[3], std::uint32_t maxDepth = 5) const {
    const auto pixel = stage.center(method, maxDepth);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(pixel[static_cast<std::size_t>(c)], expected[c], kRounding) << nameOf(method) << " channel " << c;
    }
  }

  Atmosphere air;
  Stage stage;
};

// Distance of the wall z = -5 along the ray through the middle of a pixel of a square picture, in units of its depth.
double slantOf(std::uint32_t x, std::uint32_t y, std::uint32_t size) {
  const double half = std::tan(0.5 * 0.7853981633974483);
  const double u = (2.0 * (x + 0.5) / size - 1.0) * half, v = (2.0 * (y + 0.5) / size - 1.0) * half;
  return std::sqrt(1.0 + u * u + v * v);
}

TEST_P(FogLaw, coversAPlaneByTheLengthOfEveryRay) {
  stage.addWall(-5.0, stage.add(emitter(1.0f)));
  for (const Method method : kMethods) {
    const Image image = render(device(), stage.scene, settingsFor(method, 16, 16)).image;
    for (std::uint32_t y = 0; y < 16; ++y) {
      for (std::uint32_t x = 0; x < 16; ++x) {
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(pixelAt(image, x, y)[static_cast<std::size_t>(c)], fogged(air, 1.0, 5.0 * slantOf(x, y, 16), c),
                      kRounding)
              << nameOf(method) << " at " << x << ' ' << y;
        }
      }
    }
  }
}

TEST_P(FogLaw, goesByEyeDepthWhereAskedTo) {
  stage.addWall(-5.0, stage.add(emitter(1.0f)));
  for (const Method method : kMethods) {
    RenderSettings settings = settingsFor(method, 16, 16);
    settings.fogDistance = FogDistance::depth;
    const Image image = render(device(), stage.scene, settings).image;
    for (const std::uint32_t at : {0u, 7u, 15u}) {
      EXPECT_NEAR(pixelAt(image, at, at)[0], fogged(air, 1.0, 5.0, 0), kRounding) << nameOf(method) << " at " << at;
    }
  }
}

TEST_P(FogLaw, coversASphereByTheLengthOfEveryRay) {
  constexpr double kRadius = 2.0, kDepth = 7.0;
  stage.addShape(ShapeKind::sphere, {kRadius, 0, 0, 0}, {0, 0, -kDepth}, stage.add(emitter(2.0f)));
  constexpr std::uint32_t kSize = 32;
  const Image image = render(device(), stage.scene, settingsFor(Method::whitted, kSize, kSize)).image;
  std::size_t seen = 0;
  for (std::uint32_t y = 0; y < kSize; ++y) {
    for (std::uint32_t x = 0; x < kSize; ++x) {
      const double towards = kDepth / slantOf(x, y, kSize);  // of the center, along the unit ray
      const double rest = kDepth * kDepth - towards * towards;
      if (std::abs(std::sqrt(rest) - kRadius) < 1e-3) continue;  // the rim
      const bool hit = rest < kRadius * kRadius;
      const double distance = towards - std::sqrt(std::max(0.0, kRadius * kRadius - rest));
      seen += hit ? 1 : 0;
      const double expected = hit ? fogged(air, 2.0, distance, 1) : static_cast<double>(kColor[1]);
      EXPECT_NEAR(pixelAt(image, x, y)[1], expected, 2 * kRounding) << x << ' ' << y;
    }
  }
  EXPECT_GT(seen, 100u);
}

TEST_P(FogLaw, liesBeforeAMirrorAndAgainBeforeWhatItShows) {
  Material mirror = emitter(0.25f);
  mirror.classic.reflectionFactor = glm::vec3(0.5f);
  stage.addWall(-3.0, stage.add(mirror));
  stage.addWall(2.0, stage.add(emitter(1.0f)), false);
  double expected[3];
  for (int c = 0; c < 3; ++c) expected[c] = fogged(air, 0.25 + 0.5 * fogged(air, 1.0, 5.0, c), 3.0, c);
  expectCenter(Method::whitted, expected);
}

// Not an exponential of the distance: fog of the parts is not the fog of the whole.
TEST_P(FogLaw, behindTransparentThingsGoesByTheWholeWay) {
  Material pane = emitter(0.5f);
  pane.classic.transparency = 0.25f;
  stage.addWall(-2.0, stage.add(pane));
  stage.addWall(-4.0, stage.add(pane));
  stage.addWall(-7.0, stage.add(emitter(1.0f)));
  double expected[3];
  for (int c = 0; c < 3; ++c) {
    const double wall = fogged(air, 1.0, 7.0, c), far = fogged(air, 0.5, 4.0, c), near = fogged(air, 0.5, 2.0, c);
    expected[c] = 0.75 * near + 0.25 * (0.75 * far + 0.25 * wall);
  }
  for (const Method method : kMethods) expectCenter(method, expected);
}

TEST_P(FogLaw, staysOutsideOfGlass) {
  stage.addShape(ShapeKind::box, {6, 6, 1, 0}, {0, 0, -3}, stage.add(glass(1.5f)));
  stage.addWall(-6.0, stage.add(emitter(1.0f)));
  const double F = 0.04;  // the first surface's reflection is cut: two segments
  double expected[3];
  for (int c = 0; c < 3; ++c) {
    const double mirrored = static_cast<double>(kColor[c]);  // the background
    expected[c] = fogged(air, F * mirrored + (1 - F) * (1 - F) * fogged(air, 1.0, 2.5, c), 2.5, c);
  }
  expectCenter(Method::whitted, expected, 2);
}

TEST_P(FogLaw, coversTheBackgroundUnlessItGoesByEyeDepth) {
  Stage empty;
  empty.scene.atmosphere = air;
  empty.addWall(3.0, empty.add(emitter(1.0f)));  // behind the camera
  for (const Method method : {Method::wireframe, Method::flat, Method::phong, Method::whitted}) {
    RenderSettings settings = settingsFor(method, 8, 8);
    EXPECT_EQ(pixelAt(render(device(), empty.scene, settings).image, 4, 4)[0], kColor.x) << nameOf(method);
    settings.fogDistance = FogDistance::depth;
    EXPECT_EQ(pixelAt(render(device(), empty.scene, settings).image, 4, 4)[0], 0.0f) << nameOf(method);
  }
}

TEST_P(FogLaw, comesAfterTheClampOfVertexColors) {
  stage.addWall(-5.0, stage.add(emitter(3.0f)));
  for (const Method method : {Method::flat, Method::gouraud}) {
    RenderSettings settings = settingsFor(method, 9, 9);
    settings.clampVertexColors = true;
    EXPECT_NEAR(pixelAt(render(device(), stage.scene, settings).image, 4, 4)[0], fogged(air, 1.0, 5.0, 0), kRounding);
  }
}

TEST_P(FogLaw, coversEdges) {
  Material paint = emitter(0.0f);
  paint.classic.diffuseFactor = glm::vec3(1.0f);
  stage.addWall(-5.0, stage.add(paint));
  const Image image = render(device(), stage.scene, settingsFor(Method::wireframe, 64, 64)).image;
  std::size_t edges = 0;
  for (std::uint32_t y = 0; y < 64; ++y) {
    for (std::uint32_t x = 0; x < 64; ++x) {
      const double value = pixelAt(image, x, y)[0];
      if (value == static_cast<double>(kColor.x)) continue;
      ++edges;  // of the diagonal: within a pixel of where the ray through the middle meets the wall
      EXPECT_NEAR(value, fogged(air, 1.0, 5.0 * slantOf(x, y, 64), 0), 5e-3) << x << ' ' << y;
    }
  }
  EXPECT_GT(edges, 50u);
}

TEST_P(FogLaw, leavesThePartsOfTheLightAlone) {
  stage.addWall(-5.0, stage.add(emitter(1.0f)));
  for (const Method method : kMethods) {
    RenderSettings settings = settingsFor(method, 8, 8);
    settings.aovs = {"emission"};
    const Image image = render(device(), stage.scene, settings).image;
    EXPECT_EQ(image.find("emission")->samples[0], 1.0f) << nameOf(method);
  }
}

TEST_P(FogLaw, inAnyUnitLooksTheSame) {
  const auto draw = [&](Method method, double unit) {
    Stage scaled;
    scaled.scene.atmosphere = air;
    scaled.scene.atmosphere.fogDensity /= unit;
    scaled.scene.atmosphere.fogStart *= unit;
    scaled.scene.atmosphere.fogEnd *= unit;
    scaled.addShape(ShapeKind::plane, {}, {0, -1, 0}, scaled.add(emitter(1.0f)));
    scaled.addWall(-5.0, scaled.add(emitter(0.5f)));
    const glm::dmat4 scale(glm::dvec4(unit, 0, 0, 0), glm::dvec4(0, unit, 0, 0), glm::dvec4(0, 0, unit, 0),
                           glm::dvec4(0, 0, 0, 1));
    for (MeshInstance& m : scaled.scene.instances) m.worldFromObject = scale * m.worldFromObject;
    for (ShapeInstance& m : scaled.scene.shapes) m.worldFromObject = scale * m.worldFromObject;
    scaled.scene.cameras[0].zNear *= unit;
    return render(device(), scaled.scene, settingsFor(method, 32, 24)).image;
  };
  for (const Method method : {Method::phong, Method::whitted}) {
    const Image reference = draw(method, 1.0);
    for (const double unit : {0x1p-20, 0x1p20}) {
      const Difference d =
          largestDifference(reference, draw(method, unit), [](std::uint32_t, std::uint32_t) { return true; });
      EXPECT_TRUE(d.maximum <= kRounding) << nameOf(method) << ", unit " << unit << ": " << d;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Modes, FogLaw, ::testing::Values(FogMode::linear, FogMode::exp, FogMode::exp2), [](const auto& i) {
      return std::string(i.param == FogMode::linear ? "linear" : i.param == FogMode::exp ? "exp" : "exp2");
    });

// NUMERICS R17: thin fog over a black wall is the fog alone, to 2e-6 of itself; thick fog is its color, and finite.
TEST(Fog, isExactFromTheThinnestToTheThickest) {
  for (const double density : {1e-30, 1e-12, 1e-7, 1e-3, 0.009, 0.011, 0.3, 16.0, 1e4, 1e30, 1e300}) {
    Stage stage;
    stage.scene.atmosphere = fogOf(FogMode::exp);
    stage.scene.atmosphere.fogDensity = density;
    stage.scene.atmosphere.fogColor = glm::vec3(1.0f);
    stage.addWall(-5.0, stage.add(emitter(0.0f)));
    const double expected = -std::expm1(-5.0 * density);
    for (const Method method : {Method::phong, Method::whitted}) {
      EXPECT_NEAR(stage.center(method, 0)[0] / expected, 1.0, kRounding) << density << ", " << nameOf(method);
    }
  }
}

TEST(Fog, withoutDensityChangesNoBit) {
  Stage stage;
  stage.addWall(-5.0, stage.add(emitter(0.7f)));
  stage.scene.atmosphere = fogOf(FogMode::none);
  const auto without = stage.center(Method::phong, 0);
  stage.scene.atmosphere = fogOf(FogMode::exp2);
  stage.scene.atmosphere.fogDensity = 0.0;
  EXPECT_EQ(stage.center(Method::phong, 0), without);
  EXPECT_EQ(stage.center(Method::whitted, 0), without);
}

}  // namespace
}  // namespace crosslight::testing

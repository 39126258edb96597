// The ray tree against closed forms: mirrors that face each other, a glass slab, absorption, transparency, shadows.
// Every surface that is looked at emits, and no light shines unless a test says so: values are sums of few products.
#include <cmath>
#include <glm/geometric.hpp>

#include "support/stage.h"

namespace crosslight::testing {
namespace {

constexpr double kRounding = 1e-6;  // a few products of numbers near 1 in fp32: some 10 u, u = 6e-8

// Two mirrors of reflectance 0.9 that emit 1: each segment adds the next power, cut at the depth limit.
TEST(RayTree, mirrorHallGivesThePartialGeometricSeries) {
  Stage stage;
  Material mirror = emitter(1.0f);
  mirror.classic.reflectionFactor = glm::vec3(0.9f);
  const int id = stage.add(mirror);
  stage.addWall(-2.0, id);
  stage.addWall(1.0, id, false);
  for (const std::uint32_t depth : {0u, 1u, 5u, 10u}) {
    const double expected = (1.0 - std::pow(static_cast<double>(0.9f), depth + 1)) / (1.0 - static_cast<double>(0.9f));
    EXPECT_NEAR(stage.center(Method::whitted, depth)[0], expected, 10 * kRounding) << "depth " << depth;
  }
}

// Light through a slab at normal incidence, F = 0.04: (1 - F)^2 times 1 + F^2 + F^4 ...; each term needs two segments.
TEST(RayTree, glassSlabTransmitsTheSeriesOfItsInternalReflections) {
  Stage stage;
  stage.addShape(ShapeKind::box, {6, 6, 1, 0}, {0, 0, -3}, stage.add(glass(1.5f)));
  stage.addWall(-6.0, stage.add(emitter(1.0f)));
  const double F = 0.04;
  EXPECT_NEAR(stage.center(Method::whitted, 1)[0], 0.0, kRounding) << "the ray ends inside";
  EXPECT_NEAR(stage.center(Method::whitted, 2)[0], (1 - F) * (1 - F), kRounding);
  EXPECT_NEAR(stage.center(Method::whitted, 4)[0], (1 - F) * (1 - F) * (1 + F * F), kRounding);
  EXPECT_NEAR(stage.center(Method::whitted, 12)[0], (1 - F) / (1 + F), kRounding) << "the whole series";
}

TEST(RayTree, slabAbsorbsByBeersLaw) {
  Stage stage;
  Material tinted = glass(1.5f);
  tinted.attenuationColor = {0.5f, 0.25f, 1.0f};
  tinted.attenuationDistance = 1.0f;
  stage.addShape(ShapeKind::box, {6, 6, 2, 0}, {0, 0, -3}, stage.add(tinted));
  stage.addWall(-6.0, stage.add(emitter(1.0f)));
  const auto pixel = stage.center(Method::whitted, 2);
  const double surfaces = 0.96 * 0.96;
  EXPECT_NEAR(pixel[0], surfaces * 0.25, kRounding);
  EXPECT_NEAR(pixel[1], surfaces * 0.0625, kRounding);
  EXPECT_NEAR(pixel[2], surfaces, kRounding);
}

// I = (1 - kt) Irefl + kt Itrans, in raster and by rays.
TEST(RayTree, transparencyMixesByKtInRasterAndRays) {
  Stage stage;
  Material pane = emitter(0.5f);
  pane.classic.transparency = 0.3f;
  stage.addWall(-2.0, stage.add(pane));
  stage.addWall(-5.0, stage.add(emitter(1.0f)));
  for (const Method method : {Method::flat, Method::gouraud, Method::phong, Method::whitted}) {
    const auto pixel = stage.center(method, 5);
    EXPECT_NEAR(pixel[0], 0.7 * 0.5 + 0.3 * 1.0, kRounding) << nameOf(method);
    EXPECT_NEAR(pixel[3], 1.0, kRounding) << nameOf(method);
  }
}

// A directional light along the view: lit kd, or nothing behind a blocker; half of it behind a half-transparent one.
TEST(RayTree, shadowsAreHardAndPalerBehindTransparentThings) {
  const auto wallBehind = [](float transparency, bool shadows) {
    Stage stage;
    Material white = emitter(0.0f);
    white.classic.diffuseFactor = glm::vec3(0.8f);
    stage.addWall(-5.0, stage.add(white));
    Material blocker = emitter(0.0f);
    blocker.classic.transparency = transparency;
    stage.addShape(ShapeKind::disk, {1, 0, 0, 0}, {0, 3, -4}, stage.add(blocker));
    Light sun;
    sun.type = LightType::directional;
    sun.classic = ClassicLight{};
    sun.worldDirection = glm::normalize(glm::dvec3(0, -4, -1));  // from above through the disk to the wall's middle
    stage.scene.lights.push_back(sun);
    RenderSettings s = settingsFor(Method::whitted, 9, 9);
    s.shadows = shadows;
    return pixelAt(render(device(), stage.scene, s).image, 4, 4)[0];
  };
  const double lit = 0.8 / std::sqrt(17.0);
  EXPECT_NEAR(wallBehind(0.0f, false), lit, kRounding);
  EXPECT_NEAR(wallBehind(0.0f, true), 0.0, 0.0);
  EXPECT_NEAR(wallBehind(0.5f, true), 0.5 * lit, kRounding);
}

// Outside of a scene scaled by any unit the picture is the same (NUMERICS M4): no absolute epsilon anywhere.
TEST(RayTree, sceneInAnyUnitLooksTheSame) {
  const auto draw = [](double unit) {
    Stage stage;
    Material white = emitter(0.0f);
    white.model = IlluminationModel::phong;
    white.classic.ambientFactor = white.classic.diffuseFactor = glm::vec3(0.6f);
    white.classic.specularFactor = glm::vec3(0.4f);
    white.classic.shininess = 20.0f;
    white.classic.reflectionFactor = glm::vec3(0.3f);
    const int id = stage.add(white);
    stage.addShape(ShapeKind::sphere, {0.7, 0, 0, 0}, {-0.6, 0, -4}, id);
    stage.addShape(ShapeKind::torus, {0.5, 0.2, 0, 0}, {0.9, 0, -4}, id);
    stage.addWall(-6.0, id);
    Light lamp;
    lamp.classic = ClassicLight{};
    lamp.worldPosition = glm::dvec3(2, 3, 0);
    stage.scene.lights.push_back(lamp);
    stage.scene.atmosphere.ambient = glm::vec3(0.2f);
    const glm::dmat4 scale(glm::dvec4(unit, 0, 0, 0), glm::dvec4(0, unit, 0, 0), glm::dvec4(0, 0, unit, 0),
                           glm::dvec4(0, 0, 0, 1));
    for (MeshInstance& m : stage.scene.instances) m.worldFromObject = scale * m.worldFromObject;
    for (ShapeInstance& m : stage.scene.shapes) m.worldFromObject = scale * m.worldFromObject;
    for (Light& l : stage.scene.lights) l.worldPosition *= unit;
    stage.scene.cameras[0].zNear *= unit;
    return render(device(), stage.scene, settingsFor(Method::whitted, 64, 48)).image;
  };
  const Image reference = draw(1.0);
  for (const double unit : {0x1p-20, 0x1p-10, 0x1p10, 0x1p20}) {  // powers of two: not even the rounding differs
    const Difference d = largestDifference(reference, draw(unit), [](std::uint32_t, std::uint32_t) { return true; });
    EXPECT_TRUE(d.maximum <= 1e-3) << "unit " << unit << ": " << d;
  }
}

}  // namespace
}  // namespace crosslight::testing

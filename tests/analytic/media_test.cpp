// Bodies within bodies, a camera within one, absorption, thin walls and dispersion: Snell, Fresnel and Beer in double.
// Lengths of ways are told by what absorbs on them.
#include <cmath>
#include <glm/geometric.hpp>

#include "effects/media.h"
#include "support/stage.h"

namespace crosslight::testing {
namespace {

constexpr double kRounding = 2e-6;
constexpr double kWater = 1.33, kGlass = 1.5;

// Born, Wolf 1999, "Principles of Optics", 1.5.2: unpolarised, from index n1 into n2.
double fresnel(double n1, double n2, double cos1 = 1.0) {
  const double sin2 = n1 / n2 * std::sqrt(1.0 - cos1 * cos1);
  if (sin2 >= 1.0) return 1.0;
  const double cos2 = std::sqrt(1.0 - sin2 * sin2);
  const double s = (n1 * cos1 - n2 * cos2) / (n1 * cos1 + n2 * cos2);
  const double p = (n1 * cos2 - n2 * cos1) / (n1 * cos2 + n2 * cos1);
  return 0.5 * (s * s + p * p);
}
double passes(double n1, double n2, double cos1 = 1.0) { return 1.0 - fresnel(n1, n2, cos1); }

Material body(double ior, std::optional<int> priority, const glm::vec3& leftPerUnit = glm::vec3(1.0f)) {
  Material m = glass(static_cast<float>(ior));
  m.priority = priority;
  m.attenuationColor = leftPerUnit;
  m.attenuationDistance = 1.0f;
  return m;
}

// A slab across the view, between two depths.
void addSlab(Stage& stage, double near, double far, int material) {
  stage.addShape(ShapeKind::box, {40, 40, static_cast<float>(far - near), 0}, {0, 0, -0.5 * (near + far)}, material);
}

float center(const Stage& stage, std::uint32_t maxDepth) { return stage.center(Method::whitted, maxDepth)[0]; }

TEST(NestedMedia, glassInWaterReflectsByTheIndicesOfBoth) {
  Stage stage;
  addSlab(stage, 2, 8, stage.add(body(kWater, 1)));
  addSlab(stage, 4, 6, stage.add(body(kGlass, 2)));
  stage.addWall(-12.0, stage.add(emitter(1.0f)));
  const double expected = passes(1, kWater) * passes(kWater, kGlass) * passes(kGlass, kWater) * passes(kWater, 1);
  EXPECT_NEAR(center(stage, 4), expected, kRounding);
  EXPECT_NEAR(fresnel(kWater, kGlass), 0.0036085, 1e-6) << "NUMERICS T20";
}

// Glass from 2 to 4 and water from 3 to 8 share what lies between 3 and 4; how much glass there is, its absorption
// tells.
double throughOverlap(int glassPriority, int waterPriority) {
  Stage stage;
  addSlab(stage, 2, 4, stage.add(body(kGlass, glassPriority, {0.5f, 0.5f, 0.5f})));
  addSlab(stage, 3, 8, stage.add(body(kWater, waterPriority)));
  stage.addWall(-12.0, stage.add(emitter(1.0f)));
  return static_cast<double>(center(stage, 4));
}

TEST(NestedMedia, theHigherPriorityOwnsWhatTwoBodiesShare) {
  const double surfaces = passes(1, kGlass) * passes(kGlass, kWater) * passes(kWater, 1);
  EXPECT_NEAR(throughOverlap(2, 1), surfaces * 0.25, kRounding);
  EXPECT_NEAR(throughOverlap(1, 2), surfaces * 0.5, kRounding);
}

TEST(NestedMedia, ofEqualPrioritiesTheOneEnteredLastCounts) {
  const double surfaces = passes(1, kGlass) * passes(kGlass, kWater) * passes(kWater, 1);
  EXPECT_NEAR(throughOverlap(3, 3), surfaces * 0.5, kRounding);
}

TEST(NestedMedia, anAirGapHasTwoSurfaces) {
  Stage stage;
  addSlab(stage, 2, 4, stage.add(body(kGlass, 1)));
  addSlab(stage, 4.001, 8, stage.add(body(kWater, 1)));
  stage.addWall(-12.0, stage.add(emitter(1.0f)));
  const double expected = passes(1, kGlass) * passes(kGlass, 1) * passes(1, kWater) * passes(kWater, 1);
  EXPECT_NEAR(center(stage, 4), expected, kRounding);
}

TEST(NestedMedia, bodiesOfTheSameGlassHaveNoBoundaryBetweenThem) {
  Stage stage;
  const int material = stage.add(body(kGlass, 1));
  addSlab(stage, 2, 5, material);
  addSlab(stage, 4, 8, material);
  stage.addWall(-12.0, stage.add(emitter(1.0f)));
  EXPECT_NEAR(center(stage, 4), passes(1, kGlass) * passes(kGlass, 1), kRounding);
}

// cos of the angle between the view and the ray through the middle of a pixel of a square picture.
double cosOfPixel(std::uint32_t x, std::uint32_t y, std::uint32_t size) {
  const double half = std::tan(0.5 * 0.7853981633974483);
  const double u = (2.0 * (x + 0.5) / size - 1.0) * half, v = (2.0 * (y + 0.5) / size - 1.0) * half;
  return 1.0 / std::sqrt(1.0 + u * u + v * v);
}
double cosBeyond(double n1, double n2, double cos1) {
  const double sin2 = n1 / n2 * std::sqrt(1.0 - cos1 * cos1);
  return std::sqrt(1.0 - sin2 * sin2);
}

TEST(NestedMedia, raysBendBySnellsLawBetweenTheIndicesOfBoth) {
  Stage stage;
  stage.scene.atmosphere.background = glm::vec3(1.0f);
  addSlab(stage, 2, 8, stage.add(body(kWater, 1)));
  addSlab(stage, 4, 6, stage.add(body(kGlass, 2, glm::vec3(0.25f))));
  RenderSettings settings = settingsFor(Method::whitted, 16, 16);
  settings.maxDepth = 4;
  settings.reflection = false;
  const Image image = render(device(), stage.scene, settings).image;
  for (std::uint32_t y = 0; y < 16; y += 3) {
    for (std::uint32_t x = 0; x < 16; ++x) {
      const double c1 = cosOfPixel(x, y, 16), c2 = cosBeyond(1, kWater, c1), c3 = cosBeyond(1, kGlass, c1);
      const double surfaces =
          passes(1, kWater, c1) * passes(kWater, kGlass, c2) * passes(kGlass, kWater, c3) * passes(kWater, 1, c2);
      EXPECT_NEAR(pixelAt(image, x, y)[0], surfaces * std::pow(0.25, 2.0 / c3), 2 * kRounding) << x << ' ' << y;
    }
  }
}

// A ball of glass in a ball of water, seen whole: meshes by winding number, shapes by their equations.
TEST(CameraMedia, areFoundFromTheLargestToTheSmallest) {
  Stage stage;
  const int water = stage.add(body(kWater, {})), ice = stage.add(body(1.31, {})), opaque = stage.add(emitter(1.0f));
  stage.addShape(ShapeKind::sphere, {1, 0, 0, 0}, {0, 0, 0}, ice);
  stage.addShape(ShapeKind::sphere, {3, 0, 0, 0}, {0, 0, 0}, opaque);
  stage.addShape(ShapeKind::plane, {}, {0, 2, 0}, water);
  EXPECT_EQ(bodiesAt(stage.scene, {0, 0.5, 0}), (std::vector{water, ice}));
  EXPECT_EQ(bodiesAt(stage.scene, {0, 1.5, 0}), std::vector{water});
  EXPECT_EQ(bodiesAt(stage.scene, {0, 2.5, 0}), std::vector<int>{});
  Scene meshes = sceneNamed("feature/refraction");
  meshes.shapes.clear();
  for (MeshInstance& instance : meshes.instances) instance.replacedByShape = false;
  const glm::dvec3 middle(0.0, 1.0, 0.0);
  const std::vector<int> within = bodiesAt(meshes, middle);
  ASSERT_EQ(within.size(), 1u);
  EXPECT_TRUE(isBody(meshes.materials[static_cast<std::size_t>(within[0])]));
  EXPECT_TRUE(bodiesAt(meshes, middle + glm::dvec3(0, 0, 0.98)).size() == 1);
  EXPECT_TRUE(bodiesAt(meshes, middle + glm::dvec3(0, 0, 1.02)).empty());
}

// NUMERICS T21: beyond 48.75 degrees nothing of the sky is seen. The water is one-sided, as bodies are.
TEST(CameraMedia, seeTheSkyThroughSnellsWindow) {
  Stage stage;
  stage.scene.atmosphere.background = glm::vec3(1.0f);
  stage.scene.cameras[0].yFov = 2.4;
  stage.addShape(ShapeKind::box, {40, 40, 4, 0}, {0, 0, 0}, stage.add(body(kWater, {}, glm::vec3(0.5f))));
  constexpr std::uint32_t kSize = 65;
  RenderSettings settings = settingsFor(Method::whitted, kSize, kSize);
  settings.maxDepth = 1;  // what is reflected inside ends at the next surface, unlit
  const Image image = render(device(), stage.scene, settings).image;
  const double half = std::tan(1.2);
  std::size_t inside = 0, outside = 0;
  for (std::uint32_t x = 0; x < kSize; ++x) {
    const double slope = std::abs(2.0 * (x + 0.5) / kSize - 1.0) * half;
    const double c = 1.0 / std::sqrt(1.0 + slope * slope);
    const double expected = passes(kWater, 1, c) * std::pow(0.5, 2.0 / c);
    (expected > 0 ? inside : outside) += 1;
    EXPECT_NEAR(pixelAt(image, x, kSize / 2)[0], expected, 1e-5) << x;  // near the edge F is steep
  }
  EXPECT_GT(inside, 10u);
  EXPECT_GT(outside, 10u);
}

TEST(CameraMedia, inAnyUnitLookTheSame) {
  const auto draw = [](double unit) {
    Stage stage;
    stage.scene.atmosphere.background = {0.2f, 0.5f, 1.0f};
    Material water = body(kWater, {}, {0.5f, 0.7f, 0.9f}), ball = body(kGlass, 1);
    water.attenuationDistance = static_cast<float>(unit);
    stage.addShape(ShapeKind::box, {40, 40, 12, 0}, {0, 0, 0}, stage.add(water));
    stage.addShape(ShapeKind::sphere, {1, 0, 0, 0}, {0, 0, -3}, stage.add(ball));
    const glm::dmat4 scale(glm::dvec4(unit, 0, 0, 0), glm::dvec4(0, unit, 0, 0), glm::dvec4(0, 0, unit, 0),
                           glm::dvec4(0, 0, 0, 1));
    for (ShapeInstance& m : stage.scene.shapes) m.worldFromObject = scale * m.worldFromObject;
    stage.scene.cameras[0].zNear *= unit;
    return render(device(), stage.scene, settingsFor(Method::whitted, 48, 36)).image;
  };
  const Image reference = draw(1.0);
  for (const double unit : {0x1p-20, 0x1p20}) {
    const Difference d = largestDifference(reference, draw(unit), [](std::uint32_t, std::uint32_t) { return true; });
    EXPECT_TRUE(d.maximum <= 1e-3) << "unit " << unit << ": " << d;
  }
}

// Absorption by the way within, which Snell's law says, and Fresnel's terms at both faces; thin walls have one face,
// bend nothing and absorb nothing.
TEST(Bodies, absorbByTheLengthOfTheBentWay) {
  Stage solid, thin;
  Material sheet = body(kGlass, {}, glm::vec3(0.25f));
  addSlab(solid, 2, 4, solid.add(sheet));
  sheet.hasVolume = false;
  sheet.baseColorFactor = {0.5f, 1.0f, 1.0f, 1.0f};
  thin.addWall(-2.0, thin.add(sheet));
  for (Stage* stage : {&solid, &thin}) {
    stage->scene.atmosphere.background = glm::vec3(1.0f);
    RenderSettings settings = settingsFor(Method::whitted, 16, 16);
    settings.maxDepth = 2;
    settings.reflection = false;
    const Image image = render(device(), stage->scene, settings).image;
    for (std::uint32_t x = 0; x < 16; ++x) {
      const double c1 = cosOfPixel(x, x, 16), c2 = cosBeyond(1, kGlass, c1);
      const double bent = passes(1, kGlass, c1) * passes(kGlass, 1, c2) * std::pow(0.25, 2.0 / c2);
      const double straight = 0.5 * passes(1, kGlass, c1);
      EXPECT_NEAR(pixelAt(image, x, x)[0], stage == &solid ? bent : straight, 2 * kRounding) << x;
    }
  }
}

// KHR_materials_dispersion: 20 / V, so n_F - n_C = (n_d - 1) / V.
TEST(Dispersion, bendsEveryColorByItsOwnIndex) {
  Stage stage;
  stage.scene.atmosphere.background = glm::vec3(1.0f);
  Material flint = body(1.7, {}, glm::vec3(0.25f));
  flint.dispersion = 2.0f;  // V = 10: more than any glass has
  addSlab(stage, 2, 4, stage.add(flint));
  RenderSettings settings = settingsFor(Method::whitted, 16, 16);
  settings.maxDepth = 2;
  settings.reflection = false;
  for (const Dispersion dispersion : {Dispersion::off, Dispersion::rgb}) {
    settings.dispersion = dispersion;
    const Image image = render(device(), stage.scene, settings).image;
    for (std::uint32_t x = 0; x < 16; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        const double spread = dispersion == Dispersion::rgb ? 0.5 * 0.7 / 10.0 * (channel - 1) : 0.0;
        const double n = 1.7 + spread, c1 = cosOfPixel(x, x, 16), c2 = cosBeyond(1, n, c1);
        const double expected = passes(1, n, c1) * passes(n, 1, c2) * std::pow(0.25, 2.0 / c2);
        EXPECT_NEAR(pixelAt(image, x, x)[static_cast<std::size_t>(channel)], expected, 2 * kRounding)
            << x << " channel " << channel;
      }
    }
  }
}

// All that is not taken by the depth limit comes back: a furnace of light 1 around clear bodies looks like nothing.
TEST(Dispersion, losesNoLight) {
  Stage stage;
  stage.scene.atmosphere.background = glm::vec3(1.0f);
  Material flint = body(1.7, 2), water = body(kWater, 1);
  flint.dispersion = 2.0f;
  stage.addShape(ShapeKind::box, {2, 2, 2, 0}, {0, 0, -4}, stage.add(flint));
  stage.addShape(ShapeKind::sphere, {1.2f, 0, 0, 0}, {0.5, 0, -4}, stage.add(water));
  RenderSettings settings = settingsFor(Method::whitted, 24, 24);
  settings.maxDepth = 12;
  settings.dispersion = Dispersion::rgb;
  const Image image = render(device(), stage.scene, settings).image;
  std::size_t spread = 0;
  for (std::uint32_t y = 0; y < 24; ++y) {
    for (std::uint32_t x = 0; x < 24; ++x) {
      const auto p = pixelAt(image, x, y);
      for (int c = 0; c < 3; ++c) EXPECT_LE(p[static_cast<std::size_t>(c)], 1.0 + kRounding) << x << ' ' << y;
      spread += p[0] != p[2] ? 1 : 0;
    }
  }
  EXPECT_GT(spread, 20u);
}

// A sun from above through a pane, or through two units of glass, onto a wall: the color of the shadow is theirs.
TEST(ColoredShadows, areThoseOfTheGlassThatLightGoesThrough) {
  const auto wallBehind = [](bool solid, bool colored) {
    Stage stage;
    Material white = emitter(0.0f);
    white.classic.diffuseFactor = glm::vec3(0.8f);
    stage.addWall(-5.0, stage.add(white));
    Material pane = glass(1.5f);
    pane.baseColorFactor = {0.9f, 0.5f, 0.1f, 1.0f};
    pane.hasVolume = solid;
    pane.attenuationColor = {0.5f, 0.25f, 1.0f};
    pane.attenuationDistance = 2.0f;
    const int material = stage.add(pane);
    if (solid) {
      stage.addShape(ShapeKind::box, {2, 2, 2, 0}, {0, 4, -4}, material);
    } else {
      stage.addShape(ShapeKind::disk, {1, 0, 0, 0}, {0, 3, -4}, material);
    }
    Light sun;
    sun.type = LightType::directional;
    sun.classic = ClassicLight{};
    sun.worldDirection = glm::normalize(glm::dvec3(0, -4, -1));
    stage.scene.lights.push_back(sun);
    RenderSettings s = settingsFor(Method::whitted, 9, 9);
    s.coloredShadows = colored;
    return pixelAt(render(device(), stage.scene, s).image, 4, 4);
  };
  const double lit = 0.8 / std::sqrt(17.0), way = 2.0 * std::sqrt(17.0) / 4.0;
  const double tint[3] = {0.9, 0.5, 0.1}, left[3] = {0.5, 0.25, 1.0};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(wallBehind(false, false)[c], lit, kRounding) << c;
    EXPECT_NEAR(wallBehind(false, true)[c], lit * tint[c], kRounding) << c;
    EXPECT_NEAR(wallBehind(true, true)[c], lit * tint[c] * tint[c] * std::pow(left[c], way / 2.0), kRounding) << c;
  }
}

}  // namespace
}  // namespace crosslight::testing

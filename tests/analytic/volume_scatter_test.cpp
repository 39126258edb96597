// Bodies that scatter light within (KHR_materials_volume_scatter), once on its way: slabs and a ball of air's index,
// whose integrals are known or done in double.
#include <cmath>
#include <numbers>

#include "effects/effects.h"
#include "effects/material_traits.h"
#include "support/stage.h"

namespace crosslight::testing {
namespace {

// Bends nothing and mirrors nothing: all that is seen is the body's inside.
Material mist(const glm::vec3& leftPerUnit, const glm::vec3& seen, float anisotropy = 0.0f) {
  Material m = glass(1.0f);
  m.attenuationColor = leftPerUnit;
  m.attenuationDistance = 1.0f;
  m.multiscatterColor = seen;
  m.scatterAnisotropy = anisotropy;
  return m;
}

Light sun(const glm::dvec3& along) {
  Light light;
  light.type = LightType::directional;
  light.worldDirection = glm::normalize(along);
  light.intensity = 2.0f;
  return light;
}

// Henyey, Greenstein 1941, Eq. 2, per unit of solid angle; the angle between the light's way and the scattered one's.
double phase(double g, double cosAngle) {
  return (1 - g * g) / (4 * std::numbers::pi * std::pow(1 + g * g - 2 * g * cosAngle, 1.5));
}

constexpr std::uint32_t kSamples = 64, kSteps = 128;

// Every way is walked in steps of equal shares of what it loses, from a random place in the first one on: how much
// light arrives is taken at these places. Of the light that arrives first less that which arrives last a share is
// wrong, of so many standard deviations of the mean place.
double startsError(double first, double last) {
  constexpr double kDeviations = 4.0;
  return kDeviations / std::sqrt(12.0 * kSamples) / kSteps * std::abs(first - last);
}

// In two pictures: a logarithm and an exponential, whose error is that of its argument, up to 3 here, and about a dozen
// products and sums.
constexpr double kRounding = 64 * 0x1p-24;

std::array<float, 4> seenAt(const Stage& stage, const std::function<void(RenderSettings&)>& change = {}) {
  RenderSettings s = settingsFor(Method::whitted, 3, 3);
  s.maxDepth = 4;
  s.spp = kSamples;  // each has its own places along the way
  s.smokeSteps = kSteps;
  if (change) change(s);
  return pixelAt(render(device(), stage.scene, s).image, 1, 1);
}

struct Slab : Stage {
  Slab(const Material& m, bool asMesh = false) {
    scene.cameras[0].orthographic = true;  // all rays take the same way through it
    const int material = add(m);
    if (!asMesh) {
      addShape(ShapeKind::box, {40, 40, 2, 0}, {0, 0, -4}, material);
      return;
    }
    addWall(-3, material);
    addWall(-5, material, false);
    for (MeshInstance& wall : scene.instances) {
      for (int axis = 0; axis < 2; ++axis) wall.worldFromObject[axis] *= 16.0;
      wall.worldFromObject[3] += glm::dvec4(3, 7, 0, 0);  // a way through the edge of two triangles leaves by both
    }
  }
};

// Light from behind the camera: in and out again over the same way, albedo E p(-1) (1 - e^(-2 sigma D)) / 2.
TEST(VolumeScatter, slabLitFromTheFrontMatchesTheClosedForm) {
  for (const bool asMesh : {false, true}) {
    for (const float g : {0.0f, 0.6f, -0.4f}) {
      const Material m = mist({0.5f, 0.3f, 0.9f}, {0.7f, 0.4f, 1.0f}, g);
      Slab slab(m, asMesh);
      slab.scene.lights = {sun({0, 0, -1})};
      const auto seen = seenAt(slab);
      const glm::vec3 albedo = scatteringAlbedo(m);
      for (glm::length_t c = 0; c < 3; ++c) {
        const double sigma = -std::log(static_cast<double>(m.attenuationColor[c]));
        const double lost = 1 - std::exp(-2 * sigma), full = 2.0 * albedo[c] * phase(g, -1);
        const double expected = full * (1 - std::exp(-4 * sigma)) / 2;
        EXPECT_NEAR(seen[static_cast<std::size_t>(c)], expected, full * lost * startsError(1, 1 - lost))
            << "channel " << c << ", g " << g << (asMesh ? ", mesh" : ", box");
      }
    }
  }
}

// Light from the side at 60 degrees: at depth z it has come z / cos 60 through the body.
TEST(VolumeScatter, slabLitAskewMatchesTheClosedForm) {
  const float g = 0.5f;
  const Material m = mist({0.4f, 0.6f, 0.8f}, {0.9f, 0.5f, 0.2f}, g);
  Slab slab(m);
  slab.scene.lights = {sun({std::sqrt(3.0), 0, -1})};
  const auto seen = seenAt(slab);
  const glm::vec3 albedo = scatteringAlbedo(m);
  for (glm::length_t c = 0; c < 3; ++c) {
    const double sigma = -std::log(static_cast<double>(m.attenuationColor[c])), both = sigma * (1 + 2);
    const double lost = 1 - std::exp(-2 * sigma), full = 2.0 * albedo[c] * phase(g, -0.5);
    const double expected = full * sigma * (1 - std::exp(-both * 2)) / both;
    EXPECT_NEAR(seen[static_cast<std::size_t>(c)], expected, full * lost * startsError(1, std::exp(-4 * sigma)))
        << "channel " << c;
  }
}

// What is behind comes through by Beer's law, as without scattering; both add up.
TEST(VolumeScatter, whatIsBehindIsWeakenedOnce) {
  const Material m = mist({0.5f, 0.3f, 0.9f}, glm::vec3(0.8f));
  Slab dark(m), bright(m);
  for (Slab* s : {&dark, &bright}) s->scene.lights = {sun({0, 0, -1})};
  bright.addWall(-9.0, bright.add(emitter(3.0f)));
  const auto without = seenAt(dark), with = seenAt(bright);
  for (glm::length_t c = 0; c < 3; ++c) {
    const auto i = static_cast<std::size_t>(c);
    const double expected = 3.0 * std::pow(static_cast<double>(m.attenuationColor[c]), 2);
    EXPECT_NEAR(with[i] - without[i], expected, kRounding * with[i]);
  }
}

TEST(VolumeScatter, colorOfNoneIsAbsorptionAlone) {
  Slab slab(mist({0.5f, 0.3f, 0.9f}, glm::vec3(0.0f)));
  slab.scene.lights = {sun({0, 0, -1})};
  EXPECT_FALSE(makePlan(slab.scene, settingsFor(Method::whitted, 9, 9)).has(Effect::volumeScatter));
  EXPECT_EQ(seenAt(slab)[0], 0.0f);
}

// A wall between the light and the body takes the scattered light away, and shadows in color change nothing without
// colors on the light's way but the body's own, which count once.
TEST(VolumeScatter, isShadowedAndKnowsShadowsInColor) {
  Slab slab(mist({0.5f, 0.3f, 0.9f}, glm::vec3(0.8f)));
  slab.scene.lights = {sun({std::sqrt(3.0), 0, -1})};
  const auto open = seenAt(slab);
  const auto colored = seenAt(slab, [](RenderSettings& s) { s.coloredShadows = true; });
  EXPECT_GT(open[0], 0.01f);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(colored[c], open[c], kRounding * open[c]);
  slab.addShape(ShapeKind::box, {0.1f, 80, 80, 0}, {-1.0, 0, 0}, slab.add(emitter(0.0f)));
  EXPECT_EQ(seenAt(slab)[0], 0.0f);
}

// A flat mesh before which nothing stands sends shadow rays all the same: they find the way through the body.
TEST(VolumeScatter, lightsOfAnOpenSceneCastShadows) {
  Slab slab(mist({0.5f, 0.3f, 0.9f}, glm::vec3(0.8f)), true);
  slab.scene.lights = {sun({0, 0, -1})};
  const Plan plan = makePlan(slab.scene, settingsFor(Method::whitted, 9, 9));
  EXPECT_TRUE(plan.has(Effect::shadows));
  ASSERT_EQ(plan.lightShadows.size(), 1u);
  EXPECT_EQ(plan.lightShadows[0].reason, "light 0 may cast shadows: bodies that scatter show them");
}

// van de Hulst 1980, "Multiple Light Scattering", what a half space of isotropic scatterers reflects.
TEST(VolumeScatter, albedoIsThatOfAHalfSpaceOfTheColor) {
  constexpr double kDigits = 2e-5;  // glTF's inverse of it has coefficients of six digits
  for (const float seen : {0.001f, 0.1f, 0.5f, 0.9f, 1.0f}) {
    const double s = std::sqrt(1.0 - static_cast<double>(scatteringAlbedo(mist(glm::vec3(0.5f), glm::vec3(seen))).x));
    EXPECT_NEAR((1 - s) * (1 - 0.139 * s) / (1 + 1.17 * s), seen, kDigits);
  }
}

}  // namespace
}  // namespace crosslight::testing

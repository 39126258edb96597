// Material layers of the shaders, as the device computes them, against the formulas of Khronos's extensions and their
// sources in double; reciprocity and energy; and the tables that the host integrates.
#include "oracle/model_check.h"
#include "upload/albedo_tables.h"

namespace crosslight::testing {
namespace {

TEST(LayerTwin, specularLayer) {
  Material m = metallic({0.5f, 0.25f, 0.125f}, 0.25f, 0.6f);
  m.layers.hasSpecular = true;
  m.layers.specularFactor = 0.75f;
  m.layers.specularColor = {2.0f, 1.0f, 0.5f};
  const double alpha = square(0.6f);
  expectTwin(m, [&](const Directions& d) {
    return baseTwin(d, {0.5, 0.25, 0.125}, 0.25, alpha, dvec3(0.08, 0.04, 0.02) * 0.75, 0.75, twin::schlick(d.VoH));
  });
}

TEST(LayerTwin, anisotropy) {
  Material m = metallic(glm::vec3(0.75f), 1.0f, 0.6f);
  m.layers.anisotropy = 0.5f;
  m.layers.anisotropyRotation = 0.5f;
  const double ab = square(0.6f), at = ab + (1 - ab) * 0.25;
  const dvec3 t(std::cos(0.5), std::sin(0.5), 0);
  expectTwin(m, [&](const Directions& d) {
    return dvec3(0.75 + 0.25 * twin::schlick(d.VoH)) * twin::ggxAnisotropic(d, at, ab, t);
  });
}

TEST(LayerTwin, clearcoat) {
  Material m = metallic({0.5f, 0.25f, 0.125f}, 0.0f, 0.75f);
  m.layers.clearcoat = 0.5f;
  m.layers.clearcoatRoughness = 0.6f;
  expectTwin(m, [&](const Directions& d) {
    const double weight = 0.5 * (0.04 + 0.96 * twin::schlick(d.NoV));
    return (1 - weight) * baseTwin(d, {0.5, 0.25, 0.125}, 0, 0.5625, dvec3(0.04), 1, twin::schlick(d.VoH)) +
           dvec3(weight * twin::ggx(d, square(0.6f)));
  });
}

TEST(LayerTwin, iridescence) {
  Material m = metallic({0.5f, 0.25f, 0.125f}, 1.0f, 0.6f);
  m.layers.iridescence = 0.75f;
  m.layers.filmIndex = 1.5f;
  m.layers.filmThickest = 380.0f;
  expectTwin(m, [&](const Directions& d) {
    const dvec3 base(0.5, 0.25, 0.125);
    const dvec3 bare = base + (1.0 - base) * twin::schlick(d.VoH);
    return glm::mix(bare, twin::film(base, 1.5, 380, d.VoH), 0.75) * twin::ggx(d, square(0.6f));
  });
}

TEST(LayerTwin, roughDiffuseReflection) {
  Material m = metallic({0.5f, 0.25f, 0.75f}, 0.0f, 0.9f);
  m.layers.diffuseRoughness = 0.625f;
  expectTwin(m, [&](const Directions& d) {
    dvec3 diffuse(0);
    for (int c = 0; c < 3; ++c) diffuse[c] = twin::eon(d, m.baseColorFactor[c], 0.625);
    const double F = 0.04 + 0.96 * twin::schlick(d.VoH);
    return diffuse * (1 - F) + dvec3(F * twin::ggx(d, square(0.9f)));
  });
}

TEST(LayerTwin, diffuseTransmission) {
  Material m = metallic({0.5f, 0.25f, 0.125f}, 0.0f, 0.75f);
  m.layers.diffuseTransmission = 0.25f;
  m.layers.diffuseTransmissionColor = {1.0f, 0.5f, 0.25f};
  expectTwin(m, [&](const Directions& d) {
    const double F = 0.04 + 0.96 * twin::schlick(d.VoH);
    return dvec3(0.5, 0.25, 0.125) * (0.75 * (1 - F) * d.NoL / twin::kPi) + dvec3(F * twin::ggx(d, 0.5625));
  });
  const glm::vec3 wo = directionAt(40, 0), front = directionAt(50, 120);
  const dvec3 behind = probeModel(m, {probeOf(wo, {front.x, front.y, -front.z})})[0];
  const Directions d(wo, front);
  const double through = 0.25 * (0.96 - 0.96 * twin::schlick(d.VoH)) * d.NoL / twin::kPi;
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(behind[c], through * static_cast<double>(m.layers.diffuseTransmissionColor[c]), kRelative * through);
}

// The base is black, so that the sheen stands alone.
TEST(LayerTwin, sheen) {
  Material m = metallic(glm::vec3(0.0f), 1.0f, 1.0f);
  m.layers.sheenColor = {1.0f, 0.5f, 0.25f};
  m.layers.sheenRoughness = 0.7f;
  m.layers.hasSpecular = false;
  const Grid g = grid();
  const std::vector<dvec3> with = probeModel(m, g.probes);
  Material bare = m;
  bare.layers.sheenColor = glm::vec3(0.0f);
  const std::vector<dvec3> base = probeModel(bare, g.probes);
  for (std::size_t i = 0; i < with.size(); ++i) {
    const dvec3 sheen = dvec3(m.layers.sheenColor) * twin::charlie(g.directions[i], square(0.7f));
    for (int c = 0; c < 3; ++c) {
      // Between nothing and all of the base: how much is a matter of energy, tested below.
      EXPECT_GE(with[i][c], sheen[c] * (1 - kRelative) - kAbsolute);
      EXPECT_LE(with[i][c], sheen[c] * (1 + kRelative) + base[i][c] + kAbsolute);
    }
  }
}

TEST(LayerEnergy, noLayerReflectsMoreThanItReceives) {
  for (const double theta : kFurnaceThetas) {
    Material velvet = metallic(glm::vec3(1.0f), 0.0f, 1.0f);
    velvet.layers.sheenColor = glm::vec3(1.0f);
    velvet.layers.sheenRoughness = 0.5f;
    EXPECT_LE(albedo(velvet, theta), 1.01) << "sheen at " << theta;
    Material coated = metallic(glm::vec3(1.0f), 1.0f, 0.6f);
    coated.layers.clearcoat = 1.0f;
    coated.layers.clearcoatRoughness = 0.6f;
    EXPECT_LE(albedo(coated, theta), 1.001) << "clearcoat at " << theta;
  }
}

TEST(LayerEnergy, roughDiffuseReflectionKeepsAllLightOfAWhiteSurface) {
  Material chalk = metallic(glm::vec3(1.0f), 0.0f, 1.0f);
  chalk.layers.diffuseRoughness = 1.0f;
  chalk.layers.hasSpecular = true;
  chalk.layers.specularFactor = 0.0f;  // nothing but the diffuse base
  for (const double theta : kFurnaceThetas) EXPECT_NEAR(albedo(chalk, theta), 1.0, 2e-3) << theta;
}

// Integral of a lobe over directions of light: midpoints of even solid angle.
template <class Lobe>
double integralOf(double mu, const Lobe& lobe) {
  constexpr int kPolar = 600, kAround = 300;
  const glm::vec3 wo(glm::dvec3(std::sqrt(1 - mu * mu), 0, mu));
  double sum = 0;
  for (int i = 0; i < kPolar; ++i) {
    const double c = (i + 0.5) / kPolar, s = std::sqrt(1 - c * c);
    for (int j = 0; j < kAround; ++j) {
      const double phi = std::numbers::pi * (j + 0.5) / kAround;
      sum += lobe(Directions(wo, glm::vec3(glm::dvec3(s * std::cos(phi), s * std::sin(phi), c))));
    }
  }
  return sum * 2 * std::numbers::pi / (kPolar * kAround);
}

TEST(AlbedoTables, holdTheLobesIntegrals) {
  constexpr int kSize = 32;
  const std::vector<glm::vec4> tables = makeAlbedoTables(kSize);
  ASSERT_EQ(tables.size(), std::size_t{kSize * kSize});
  for (const int row : {16, 24, 31}) {
    for (const int column : {4, 16, 31}) {
      const double roughness = row / 31.0, mu = std::min(column / 31.0, 0.999999), alpha = roughness * roughness;
      const double bound = column < 16 ? 1.2e-2 : 4e-3;
      const glm::vec4 entry = tables[static_cast<std::size_t>(row * kSize + column)];
      EXPECT_NEAR(entry.x, integralOf(mu, [&](const Directions& d) { return twin::ggx(d, alpha); }), bound)
          << row << ", " << column;
      const double sheen = integralOf(mu, [&](const Directions& d) { return twin::charlie(d, alpha); });
      EXPECT_NEAR(entry.y, std::min(sheen, 1.0), bound) << row << ", " << column;
    }
  }
}

TEST(LayerEnergy, compensationMakesAWhiteMetalWhite) {
  RenderSettings on = settingsFor(Method::phong, 8, 8);
  on.energyCompensation = true;
  const Material rough = metallic(glm::vec3(1.0f), 1.0f, 0.9f);
  EXPECT_LT(albedo(rough, 30), 0.8);
  for (const double theta : kFurnaceThetas) {
    EXPECT_NEAR(albedo(rough, theta, on), 1.0, 1e-2) << theta;
    EXPECT_NEAR(albedo(metallic(glm::vec3(1.0f), 1.0f, 0.5f), theta, on), 1.0, 1e-2) << theta;
  }
}

TEST(LayerReciprocity, lightMayGoEitherWay) {
  Material chalk = metallic({0.5f, 0.25f, 0.125f}, 0.0f, 0.6f);
  chalk.layers.diffuseRoughness = 0.5f;
  expectReciprocal(chalk);
  Material film = metallic(glm::vec3(0.5f), 1.0f, 0.5f);
  film.layers.iridescence = 1.0f;
  expectReciprocal(film);
  Material brushed = metallic(glm::vec3(0.5f), 1.0f, 0.5f);
  brushed.layers.anisotropy = 0.5f;
  expectReciprocal(brushed);
}

}  // namespace
}  // namespace crosslight::testing

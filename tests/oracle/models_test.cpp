// Illumination models of the shaders, as the device computes them, against their publications' formulas in double:
// values over a grid of directions down to a degree from the surface, reciprocity, and energy.
#include "oracle/model_check.h"

namespace crosslight::testing {
namespace {

TEST(ModelTwin, modifiedPhong) {
  const Material m = classic(IlluminationModel::modifiedPhong);
  expectTwin(m, [&](const Directions& d) {
    return dvec3(m.classic.diffuseFactor) * d.NoL + dvec3(m.classic.specularFactor) * twin::modifiedPhong(d, 12);
  });
}

TEST(ModelTwin, orenNayar) {
  Material m = classic(IlluminationModel::orenNayar);
  m.classic.roughness = 0.3f;
  expectTwin(m, [&](const Directions& d) {
    return dvec3(m.classic.diffuseFactor) * twin::orenNayar(d, static_cast<double>(0.3f));
  });
}

TEST(ModelTwin, orenNayarAtTheCatalogsPoint) {
  Material m = classic(IlluminationModel::orenNayar);
  m.classic.diffuseFactor = glm::vec3(1.0f);
  m.classic.roughness = 0.3f;
  const auto value = [&](double phi) {
    return probeModel(m, {probeOf(directionAt(60, 0), directionAt(45, phi))})[0].x / std::numbers::pi;
  };
  EXPECT_NEAR(value(0), 0.244821408497320, 1e-5 * 0.2448);
  EXPECT_NEAR(value(180), 0.200963463427925, 1e-5 * 0.2010);
}

TEST(ModelTwin, orenNayarWithoutRoughnessIsLambertsBits) {
  Material m = classic(IlluminationModel::orenNayar);
  const Grid g = grid();
  EXPECT_EQ(probeModel(m, g.probes), probeModel(classic(IlluminationModel::lambert), g.probes));
}

TEST(ModelTwin, cookTorrance1982ByItsIndex) {
  Material m = classic(IlluminationModel::cookTorrance1982);
  m.classic.roughness = 0.4f;
  m.classic.hasIndex = true;
  m.classic.refractiveIndex = {0.21f, 1.02f, 1.17f};
  m.classic.extinction = {3.67f, 2.59f, 2.40f};
  expectTwin(m, [&](const Directions& d) {
    dvec3 F(0);
    for (int c = 0; c < 3; ++c) F[c] = twin::metal(d.VoH, m.classic.refractiveIndex[c], m.classic.extinction[c]);
    return dvec3(m.classic.diffuseFactor) * d.NoL +
           dvec3(m.classic.specularFactor) * F * twin::facets1982(d, static_cast<double>(0.4f));
  });
}

TEST(ModelTwin, cookTorrance1982ByReflectance) {
  Material m = classic(IlluminationModel::cookTorrance1982);
  m.classic.roughness = 0.4f;
  const dvec3 F0(m.classic.specularFactor);
  const auto with = [&](auto rise) {
    return [&, rise](const Directions& d) {
      return dvec3(m.classic.diffuseFactor) * d.NoL +
             (F0 + (1.0 - F0) * rise(d.VoH)) * twin::facets1982(d, static_cast<double>(0.4f));
    };
  };
  const double mean = (F0.x + F0.y + F0.z) / 3;
  expectTwin(m, with([mean](double c) { return twin::exactRise(c, mean); }));
  RenderSettings schlick = settingsFor(Method::phong, 8, 8);
  schlick.fresnel = Fresnel::schlick;
  expectTwin(m, with([](double c) { return twin::schlick(c); }), schlick);
}

TEST(ModelTwin, angularSpecularIsTheLecturesW) {
  Material m = classic(IlluminationModel::phong);
  m.classic.angularSpecular = true;
  const dvec3 ks(m.classic.specularFactor);
  expectTwin(m, [&](const Directions& d) {
    const dvec3 r = 2 * d.NoL * twin::kNormal - d.wi;
    const dvec3 W = ks + (1.0 - ks) * twin::exactRise(d.NoL, (ks.x + ks.y + ks.z) / 3);
    return dvec3(m.classic.diffuseFactor) * d.NoL + W * std::pow(std::max(0.0, glm::dot(r, d.wo)), 12.0);
  });
}

TEST(ModelTwin, metallicRoughnessBySchlickAndByFresnel) {
  const Material m = metallic({0.5f, 0.25f, 0.125f}, 0.0f, 0.6f);
  const double alpha = square(0.6f);
  expectTwin(m, [&](const Directions& d) {
    return baseTwin(d, {0.5, 0.25, 0.125}, 0, alpha, dvec3(0.04), 1, twin::schlick(d.VoH));
  });
  RenderSettings exact = settingsFor(Method::phong, 8, 8);
  exact.fresnel = Fresnel::exact;
  expectTwin(
      m,
      [&](const Directions& d) {
        return baseTwin(d, {0.5, 0.25, 0.125}, 0, alpha, dvec3(0.04), 1, twin::exactRise(d.VoH, 0.04));
      },
      exact);
}

TEST(ModelEnergy, modifiedPhongReflectsNoMoreThanItReceives) {
  for (const double theta : kFurnaceThetas) {
    Material phong = classic(IlluminationModel::modifiedPhong);
    phong.classic.diffuseFactor = glm::vec3(0.5f);
    phong.classic.specularFactor = glm::vec3(0.5f);
    // Classic lights have no 1/pi.
    EXPECT_LE(albedo(phong, theta) / std::numbers::pi, 1.001) << "at " << theta;
  }
}

TEST(ModelReciprocity, lightMayGoEitherWay) {
  expectReciprocal(classic(IlluminationModel::modifiedPhong));
  Material clay = classic(IlluminationModel::orenNayar);
  clay.classic.roughness = 0.5f;
  expectReciprocal(clay);
  Material grooves = classic(IlluminationModel::cookTorrance1982);
  grooves.classic.roughness = 0.3f;
  expectReciprocal(grooves);
}

}  // namespace
}  // namespace crosslight::testing

// Reflection models and material layers under light that has an extent: lights with an area and environments, against
// the publications' formulas integrated by brute force in double.
#include "oracle/model_twins.h"
#include "study/model_probe.h"
#include "support/area_stage.h"

namespace crosslight::testing {
namespace {

using glm::dvec3;
using twin::Directions;

// `value`: what the surface sends towards wo of a light of unit intensity, red. `sky`: bound under an environment;
// 0: the convolved maps promise nothing.
struct Case {
  const char* name;
  Material material;
  std::function<double(const Directions&)> value;
  double bound;  // of the largest value on the wall, about twice what the quadrature is off
  double sky;
};

Material metallic(float color, float metal, float roughness) {
  Material m;
  m.baseColorFactor = glm::vec4(glm::vec3(color), 1.0f);
  m.metallicFactor = metal;
  m.perceptualRoughnessFactor = roughness;
  return m;
}

double fresnel(const Directions& d, double F0 = 0.04) { return F0 + (1 - F0) * twin::schlick(d.VoH); }

double plastic(const Directions& d, double color, double alpha) {
  return color * (1 - fresnel(d)) * std::max(d.NoL, 0.0) / twin::kPi + fresnel(d) * twin::ggx(d, alpha);
}

Case modifiedPhong() {
  return {"modifiedPhong", study::classicOf(IlluminationModel::modifiedPhong, 0.25f, 0.75f, 40),
          [](const Directions& d) { return 0.25 * std::max(d.NoL, 0.0) + 0.75 * twin::modifiedPhong(d, 40); }, 2e-3, 0};
}

Case orenNayar() {
  Material m = study::classicOf(IlluminationModel::orenNayar, 1.0f, 0.0f, 1);
  m.classic.roughness = 0.5f;
  return {"orenNayar", m, [](const Directions& d) { return twin::orenNayar(d, 0.5); }, 4e-3, 1e-3};
}

Case grooves() {
  Material m = study::classicOf(IlluminationModel::cookTorrance1982, 0.25f, 0.25f, 1);
  m.classic.roughness = 0.25f;
  return {"cookTorrance1982", m,
          [](const Directions& d) {
            const double F = 0.25 + 0.75 * twin::exactRise(d.VoH, 0.25);
            return 0.25 * std::max(d.NoL, 0.0) + F * twin::facets1982(d, 0.25);
          },
          4e-3, 0};
}

Case coat() {
  Material m = metallic(0.5f, 0.0f, 0.8f);
  m.layers.clearcoat = 1.0f;
  m.layers.clearcoatRoughness = 0.25f;
  return {"clearcoat", m,
          [](const Directions& d) {
            const double weight = 0.04 + 0.96 * twin::schlick(d.NoV);
            return (1 - weight) * plastic(d, 0.5, 0.8f * 0.8f) + weight * twin::ggx(d, 0.0625);
          },
          1e-2, 4e-3};
}

Case brushed() {
  Material m = metallic(1.0f, 1.0f, 0.5f);
  m.layers.anisotropy = 0.5f;
  m.layers.anisotropyRotation = 0.5f;
  const dvec3 t(std::cos(0.5), std::sin(0.5), 0);
  return {"anisotropy", m, [t](const Directions& d) { return twin::ggxAnisotropic(d, 0.25 + 0.75 * 0.25, 0.25, t); },
          4e-3, 0};
}

Case film() {
  Material m = metallic(0.5f, 1.0f, 0.4f);
  m.layers.iridescence = 1.0f;
  m.layers.filmIndex = 1.5f;
  m.layers.filmThickest = 400.0f;
  return {"iridescence", m,
          [](const Directions& d) { return twin::film(dvec3(0.5), 1.5, 400, d.VoH).x * twin::ggx(d, 0.4f * 0.4f); },
          4e-3, 0};
}

Case chalk() {
  Material m = metallic(0.75f, 0.0f, 1.0f);
  m.layers.diffuseRoughness = 1.0f;
  m.layers.hasSpecular = true;
  m.layers.specularFactor = 0.0f;
  return {"diffuseRoughness", m, [](const Directions& d) { return twin::eon(d, 0.75, 1); }, 4e-3, 3e-3};
}

// The base is black, so that the sheen stands alone; what the base still mirrors is taken in half: see ModelTwin.sheen.
Case velvet() {
  Material m = metallic(0.0f, 0.0f, 0.2f);
  m.layers.hasSpecular = true;
  m.layers.specularFactor = 0.0f;
  m.layers.sheenColor = glm::vec3(1.0f);
  m.layers.sheenRoughness = 0.5f;
  return {"sheen", m, [](const Directions& d) { return twin::charlie(d, 0.25); }, 1e-2, 1e-2};
}

Case leaf() {
  Material m = metallic(0.5f, 0.0f, 0.9f);
  m.layers.diffuseTransmission = 0.5f;
  m.layers.diffuseTransmissionColor = glm::vec3(0.75f);
  return {"diffuseTransmission", m,
          [](const Directions& d) {
            const double here = (0.5 * 0.5 * (1 - fresnel(d)) * std::max(d.NoL, 0.0)) / twin::kPi;
            const dvec3 mirrored(d.wi.x, d.wi.y, -d.wi.z);
            const Directions through(glm::vec3(d.wo), glm::vec3(mirrored));
            const double passed = 0.5 * 0.75 * (1 - fresnel(through)) * std::max(-d.NoL, 0.0) / twin::kPi;
            return here + passed + fresnel(d) * twin::ggx(d, 0.9f * 0.9f);
          },
          2e-3, 4e-3};
}

std::vector<Case> cases() {
  return {modifiedPhong(), orenNayar(), grooves(), coat(), brushed(), film(), chalk(), velvet(), leaf()};
}

class LitModel : public ::testing::TestWithParam<std::size_t> {};

// The wall's tangents are +X.
void giveTangents(Scene& scene) {
  for (Mesh& mesh : scene.meshes) {
    for (Primitive& p : mesh.primitives) p.tangents.assign(p.positions.size(), {1, 0, 0, 1});
  }
}

TEST_P(LitModel, underAnAreaAgreesWithBruteForce) {
  const Case c = cases()[GetParam()];
  std::vector<Light> lights = {rectangleLight({0.6, 0.2, -0.6}, {-0.3, 0, -1.0}, 1.2, 0.7),
                               roundLight(LightType::areaDisk, {-0.5, 0.4, -1.2}, {0.3, -0.4, -1.0}, 0.4),
                               roundLight(LightType::areaSphere, {0.2, -0.5, -1.5}, {0, 0, -1}, 0.3),
                               triangleLight({0.1, 0.1, -1.0}, {0.7, 0.1, 0.2}, {0.0, 0.9, 0.1})};
  if (c.material.layers.diffuseTransmission > 0)
    lights.push_back(roundLight(LightType::areaDisk, {0.5, 0.4, -4.0}, {0, 0, 1}, 0.4));
  double worst = 0;
  for (const Light& light : lights) {
    LitWall wall(light, c.material);
    giveTangents(wall.scene);
    const Image image = wall.draw(Method::phong, 8, 6);
    double largest = 0, off = 0;
    for (std::uint32_t y = 0; y < 6; ++y) {
      for (std::uint32_t x = 0; x < 8; ++x) {
        const dvec3 p = LitWall::placeOf(image, x, y);
        const glm::vec3 wo(glm::normalize(-p));
        const double expected = overLight(
            light, p, 200, [&](const auto& wi, const auto&) { return c.value(Directions(wo, glm::vec3(wi))); });
        largest = std::max(largest, expected);
        off = std::max(off, std::abs(pixelAt(image, x, y)[0] - expected));
      }
    }
    ASSERT_GT(largest, 1e-4) << nameOf(light.type);
    if (!(off / largest <= worst)) worst = off / largest;
    EXPECT_TRUE(off <= c.bound * largest) << nameOf(light.type) << ": " << off / largest;
  }
  RecordProperty("worst", std::to_string(worst));
}

// Share of a white sky, both hemispheres, that leaves towards wo.
double albedo(const Case& c, const glm::vec3& wo) {
  constexpr int kPolar = 250, kAround = 250;
  double sum = 0;
  for (int i = 0; i < 2 * kPolar; ++i) {
    const double mu = (i + 0.5) / kPolar - 1, sine = std::sqrt(1 - mu * mu);
    for (int j = 0; j < kAround; ++j) {
      const double phi = 2 * kTestPi * (j + 0.5) / kAround;
      sum += c.value(Directions(wo, glm::vec3(dvec3(sine * std::cos(phi), sine * std::sin(phi), mu))));
    }
  }
  return sum * 2 * kTestPi / (kPolar * kAround);
}

TEST_P(LitModel, underAConstantSkyAgreesWithBruteForce) {
  const Case c = cases()[GetParam()];
  if (c.sky == 0) GTEST_SKIP() << "the convolved maps stand for a lobe of another shape: no promise";
  auto map = std::make_shared<EnvironmentMap>();
  map->width = 8;
  map->height = 4;
  map->radiance.assign(32, glm::vec3(1.0f));
  Stage wall;
  wall.addWall(-3.0, wall.add(c.material));
  giveTangents(wall.scene);
  wall.scene.atmosphere.environment = {"made in a test", 1.0, 0.0, map};
  for (const Method method : {Method::phong, Method::whitted}) {
    RenderSettings s = settingsFor(method, 5, 3);
    s.aovs = {"position"};
    s.lightSamples = 0;
    const Image image = render(device(), wall.scene, s).image;
    for (std::uint32_t x = 0; x < 5; ++x) {
      const glm::vec3 wo(glm::normalize(-LitWall::placeOf(image, x, 1)));
      EXPECT_NEAR(pixelAt(image, x, 1)[0], albedo(c, wo), c.sky) << nameOf(method) << " cosine " << wo.z;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Each, LitModel, ::testing::Range(std::size_t{0}, cases().size()),
                         [](const auto& i) { return std::string(cases()[i.param].name); });

}  // namespace
}  // namespace crosslight::testing

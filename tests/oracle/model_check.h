// How tests ask the shaders' models: over a grid of directions against a formula in double, and for the share of a
// white sky that they reflect.
#pragma once

#include "oracle/model_probe.h"
#include "oracle/model_twins.h"

namespace crosslight::testing {

using glm::dvec3;
using twin::Directions;

// fp32: some forty roundings of 2^-24 on a value, one exp() or pow() of up to 63 ulp on lavapipe, and the half vector's
// own rounding, which D of roughness 0.3 (the sharpest here) magnifies by 4 tan / alpha^2.
inline constexpr double kRelative = 1e-4;
inline constexpr double kAbsolute = 2e-6;

inline constexpr double kThetas[] = {0, 20, 45, 60, 75, 85, 89};
inline constexpr double kPhis[] = {0, 30, 90, 135, 180};

inline constexpr double kFurnaceThetas[] = {0, 30, 60, 80};

struct Grid {
  std::vector<Probe> probes;
  std::vector<Directions> directions;
};

inline Grid grid() {
  Grid g;
  for (const double o : kThetas) {
    for (const double i : kThetas) {
      for (const double phi : kPhis) {
        const glm::vec3 wo = directionAt(o, 20), wi = directionAt(i, 20 + phi);
        g.probes.push_back(probeOf(wo, wi));
        g.directions.emplace_back(wo, wi);
      }
    }
  }
  return g;
}

template <class Twin>
void expectTwin(const Material& material, const Twin& formula,
                const RenderSettings& settings = settingsFor(Method::phong, 8, 8)) {
  const Grid g = grid();
  const std::vector<dvec3> got = probeModel(material, g.probes, settings);
  double largest = 0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    const dvec3 expected = formula(g.directions[i]);
    for (int c = 0; c < 3; ++c) {
      largest = std::max(largest, expected[c]);
      ASSERT_TRUE(std::abs(got[i][c] - expected[c]) <= kRelative * std::abs(expected[c]) + kAbsolute)
          << "cos o " << g.directions[i].NoV << ", cos i " << g.directions[i].NoL << ", channel " << c << ": "
          << got[i][c] << " instead of " << expected[c];
    }
  }
  EXPECT_GT(largest, 0.01);
}

// Share of a white sky that leaves towards wo: midpoints of even solid angle, as many as the narrowest lobe here needs.
inline double albedo(const Material& material, double thetaDegrees,
                     const RenderSettings& settings = settingsFor(Method::phong, 8, 8)) {
  constexpr int kPolar = 256, kAround = 256;
  std::vector<Probe> probes;
  const glm::vec3 wo = directionAt(thetaDegrees, 0);
  for (int i = 0; i < kPolar; ++i) {
    for (int j = 0; j < kAround; ++j) {
      const double mu = (i + 0.5) / kPolar, phi = 360.0 * (j + 0.5) / kAround;
      probes.push_back(probeOf(wo, directionAt(std::acos(mu) * 180 / std::numbers::pi, phi)));
    }
  }
  double sum = 0;
  for (const dvec3& v : probeModel(material, probes, settings)) sum += v.x;
  return sum * 2 * std::numbers::pi / (kPolar * kAround);
}

inline Material classic(IlluminationModel model) {
  Material m;
  m.model = model;
  m.classic.diffuseFactor = {0.5f, 0.25f, 0.125f};
  m.classic.specularFactor = {0.25f, 0.5f, 0.0625f};
  m.classic.shininess = 12;
  return m;
}

inline Material metallic(const glm::vec3& color, float metallicFactor, float roughness) {
  Material m;
  m.baseColorFactor = glm::vec4(color, 1.0f);
  m.metallicFactor = metallicFactor;
  m.perceptualRoughnessFactor = roughness;
  return m;
}

inline double square(float x) { return static_cast<double>(x) * x; }

inline dvec3 baseTwin(const Directions& d, const dvec3& color, double metal, double alpha, const dvec3& dielectricF0,
                      double F90, double rise) {
  const dvec3 F = glm::mix(dielectricF0 + (F90 - dielectricF0) * rise, color + (1.0 - color) * rise, metal);
  const double strongest = std::max({dielectricF0.x, dielectricF0.y, dielectricF0.z});
  const double through = 1 - (strongest + (F90 - strongest) * rise);
  return color * ((1 - metal) * through * d.NoL / twin::kPi) + F * twin::ggx(d, alpha);
}

// Light may go either way: values over the cosine of the light, with directions exchanged.
inline void expectReciprocal(const Material& m) {
  const Grid g = grid();
  std::vector<Probe> swapped = g.probes;
  for (Probe& p : swapped) std::swap(p.wo, p.wi);
  const std::vector<dvec3> there = probeModel(m, g.probes), back = probeModel(m, swapped);
  for (std::size_t i = 0; i < there.size(); ++i) {
    const double f = there[i].x / g.directions[i].NoL, b = back[i].x / g.directions[i].NoV;
    EXPECT_NEAR(f, b, 2 * kRelative * std::max(f, b) + kAbsolute) << "model " << static_cast<int>(m.model);
  }
}

}  // namespace crosslight::testing

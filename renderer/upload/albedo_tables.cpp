#include "upload/albedo_tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "effects/effects.h"
#include "effects/material_traits.h"

namespace crosslight {
namespace {

constexpr double kPi = std::numbers::pi;
// Of the shaders (kSmallestAlpha): tables and lobes must be sharp alike.
constexpr double kSmallestAlpha = 1e-3;
// Midpoints; with them a table's entry is within 4e-3 of the converged integral for cosines from 1/2 on, 1.2e-2 towards
// grazing angles (a test compares).
constexpr int kPolarSteps = 48, kAzimuthSteps = 24;

// Share of light that leaves a GGX surface after one bounce, F = 1, seen at the cosine `mu`: facets are taken in
// proportion to D cos (stratified inverse of its distribution), each weighs G2 (wo.h) / ((n.wo)(n.h)).
double albedoGGX(double mu, double alpha) {
  const double a2 = alpha * alpha;
  const double sinV = std::sqrt(std::max(0.0, 1.0 - mu * mu));
  const auto lambda = [&](double c) { return std::sqrt(a2 + (1.0 - a2) * c * c); };
  double sum = 0.0;
  for (int i = 0; i < kPolarSteps; ++i) {
    const double u = (i + 0.5) / kPolarSteps;
    const double c2 = (1.0 - u) / (1.0 + (a2 - 1.0) * u);
    const double cosH = std::sqrt(c2), sinH = std::sqrt(std::max(0.0, 1.0 - c2));
    for (int j = 0; j < kAzimuthSteps; ++j) {
      const double VoH = sinV * sinH * std::cos(kPi * (j + 0.5) / kAzimuthSteps) + mu * cosH;
      const double NoL = 2.0 * VoH * cosH - mu;
      if (VoH <= 0.0 || NoL <= 0.0) continue;
      const double G2 = 2.0 * mu * NoL / (NoL * lambda(mu) + mu * lambda(NoL));
      sum += G2 * VoH / (mu * cosH);
    }
  }
  return sum / (kPolarSteps * kAzimuthSteps);
}

// Estevez, Kulla 2017, "Production Friendly Microfacet Sheen BRDF", Eq. 3 with Table 1.
double lambdaSheen(double c, double alpha) {
  const double t = (1.0 - alpha) * (1.0 - alpha);
  const auto between = [t](double sharp, double smooth) { return sharp * t + smooth * (1.0 - t); };
  const auto curve = [&](double x) {
    return between(25.3245, 21.5473) / (1.0 + between(3.32435, 3.82987) * std::pow(x, between(0.16801, 0.19823))) +
           between(-1.27393, -1.97760) * x + between(-4.85967, -4.32054);
  };
  return std::exp(c < 0.5 ? curve(c) : 2.0 * curve(0.5) - curve(1.0 - c));
}

// The same of white sheen, over directions of light: D V cos, azimuths in even steps, polar angles in even steps too,
// because fibers reflect along the surface.
double albedoSheen(double mu, double alpha) {
  const double sinV = std::sqrt(std::max(0.0, 1.0 - mu * mu));
  const double maskingV = lambdaSheen(mu, alpha);
  double sum = 0.0;
  for (int i = 0; i < kPolarSteps; ++i) {
    const double theta = 0.5 * kPi * (i + 0.5) / kPolarSteps;
    const double NoL = std::cos(theta), sinL = std::sin(theta);
    const double V = 1.0 / (4.0 * mu * (1.0 + maskingV + lambdaSheen(NoL, alpha)));  // times NoL
    for (int j = 0; j < kAzimuthSteps; ++j) {
      const double phi = kPi * (j + 0.5) / kAzimuthSteps;
      const double x = sinL * std::cos(phi) + sinV, y = sinL * std::sin(phi), z = NoL + mu;
      const double sin2H = (x * x + y * y) / (x * x + y * y + z * z);
      sum += (2.0 + 1.0 / alpha) * std::pow(sin2H, 0.5 / alpha) / (2.0 * kPi) * V * sinL;
    }
  }
  return sum * (0.5 * kPi / kPolarSteps) * (2.0 * kPi / kAzimuthSteps);
}

}  // namespace

bool needsAlbedoTables(const Scene& scene, const RenderSettings& settings) {
  const bool sheen = std::any_of(scene.materials.begin(), scene.materials.end(),
                                 [](const Material& m) { return (effectsOf(m) & bitOf(Effect::sheen)) != 0; });
  return sheen || settings.energyCompensation;
}

std::vector<glm::vec4> makeAlbedoTables(int size) {
  std::vector<glm::vec4> texels;
  texels.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  for (int row = 0; row < size; ++row) {
    const double roughness = static_cast<double>(row) / (size - 1);
    const double alpha = std::max(roughness * roughness, kSmallestAlpha);
    for (int column = 0; column < size; ++column) {
      // At grazing incidence itself the integrals are limits: a hundredth of a step in, they are there.
      const double mu = std::max(static_cast<double>(column), 0.01) / (size - 1);
      texels.emplace_back(static_cast<float>(albedoGGX(mu, alpha)),
                          static_cast<float>(std::min(albedoSheen(mu, alpha), 1.0)), 0.0f, 0.0f);
    }
  }
  return texels;
}

}  // namespace crosslight

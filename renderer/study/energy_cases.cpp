// Cases of energy: what surfaces send back of a white sky, by the models' own values on the device.
#include <fmt/format.h>

#include <numbers>

#include "study/cases.h"
#include "study/model_probe.h"

namespace crosslight::study {
namespace {

// Share of a white sky that is reflected towards wo: midpoints of even solid angle.
double albedo(const Bench& bench, const Material& material, const glm::vec3& wo) {
  constexpr int kPolar = 200, kAround = 200;
  std::vector<ModelQuestion> questions;
  for (int i = 0; i < kPolar; ++i) {
    for (int j = 0; j < kAround; ++j) {
      const double cosine = (i + 0.5) / kPolar;
      questions.push_back(
          questionOf(wo, directionAt(std::acos(cosine) * 180 / std::numbers::pi, 360 * (j + 0.5) / kAround)));
    }
  }
  double sum = 0;
  for (const glm::dvec3& value : askModel(bench.device, material, questions)) sum += value.x;
  return sum * 2 * std::numbers::pi / (kPolar * kAround);
}

void noMoreThanArrives(const Bench& bench, CaseResult& result) {
  Worst worst;
  for (const float n : {1.0f, 10.0f, 100.0f}) {
    for (const double theta : {0.0, 40.0, 80.0}) {
      const glm::vec3 wo = directionAt(theta, 0);
      // Classic lights have no 1 / pi.
      const double sent =
          albedo(bench, classicOf(IlluminationModel::modifiedPhong, 0.4f, 0.6f, n), wo) / std::numbers::pi;
      worst.add(sent, 1, std::max(sent - 1, 0.0));
      const double classic = albedo(bench, classicOf(IlluminationModel::phong, 0.5f, 0.6f, n), wo) / std::numbers::pi;
      worst.addNaive(std::max(classic - 1, 0.0));
    }
  }
  result.measure("kernel", "light sent back by modified Phong of kd + ks = 1, beyond what arrives", worst, 1e-3,
                 "relative");
}

void roughInWhiteSky(const Bench& bench, CaseResult& result) {
  // By quadrature on 1500^2 directions; alpha 1 at normal incidence is 1 - ln 2.
  const struct {
    double alpha, cosine, share;
  } rows[] = {{1, 1, 1 - std::numbers::ln2},
              {1, .5, .450694},
              {1, .1, .760211},
              {.5, 1, .687849},
              {.5, .5, .698251},
              {.5, .1, .860105}};
  for (const auto& row : rows) {
    Material m;  // white metal: Fresnel's term is 1
    m.perceptualRoughnessFactor = static_cast<float>(std::sqrt(row.alpha));
    Worst worst;
    worst.addAbsolute(albedo(bench, m, directionAt(std::acos(row.cosine) * 180 / std::numbers::pi, 0)), row.share);
    result.measure("kernel", fmt::format("share of a white sky, alpha {:g}, cosine {:g}", row.alpha, row.cosine), worst,
                   1e-3, "absolute");
  }
}

void noShininess(const Bench& bench, CaseResult& result) {
  std::vector<ModelQuestion> questions;
  for (const double degrees : {0.0, 30.0, 60.0, 89.0, 89.99})
    questions.push_back(questionOf({0, 0, 1}, directionAt(degrees, 0)));
  Worst worst;
  for (const IlluminationModel model : {IlluminationModel::phong, IlluminationModel::blinnPhong}) {
    for (const glm::dvec3& value : askModel(bench.device, classicOf(model, 0, 0.5f, 0), questions))
      worst.addAbsolute(value.x, 0.5);
  }
  result.measure("kernel", "highlight of shininess 0 wherever R.V or N.H is above 0", worst, 0, "absolute");
}

}  // namespace

std::vector<HardCase> energyCases() {
  return {
      {"I4", "shininess 0", "the power of a cosine to 0 is 1 wherever the gate is open, and pow() need not say so",
       "exactly ks", true, noShininess, nullptr, "what pow(0, 0) gives is the device's: see the probe"},
      {"I13", "rough metal in a white sky",
       "what one scattering event loses on rough surfaces is real: 69 % of alpha 1",
       "quadrature to 1e-3, on both sides", true, roughInWhiteSky, nullptr, "no formula is at fault: who expects 1 is"},
      {"I20", "no more light than arrives", "the classic model sends back 110 % of a white sky where kd + ks is 1.1",
       "normalized by (n + 2) / 2 pi; 1e-3 of quadrature", true, noMoreThanArrives},
  };
}

}  // namespace crosslight::study

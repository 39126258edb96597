// Cases of illumination models, asked on the device point by point: grazing light, narrow lobes, opposite directions.
#include <array>

#include "study/cases.h"
#include "study/model_probe.h"
#include "study/random_numbers.h"

namespace crosslight::study {
namespace {

glm::vec3 grazing(double sine) {
  return glm::vec3(static_cast<float>(std::sqrt(1 - sine * sine)), 0, static_cast<float>(sine));
}

void terminator(const Bench& bench, CaseResult& result) {
  std::vector<ModelQuestion> questions;
  std::vector<double> expected;
  Random random(1);
  for (int k = 0; k < 2000; ++k) {
    const glm::vec3 n(random.direction());
    const glm::dvec3 across = glm::normalize(glm::cross(glm::dvec3(n), random.direction()));
    const double height = std::pow(10.0, -random.between(1, 8)) * (k % 3 == 0 ? -1 : 1);
    ModelQuestion q = questionOf(n, glm::vec3(height * glm::dvec3(n) + across));
    q.normal = {n, 0};
    questions.push_back(q);
    expected.push_back(std::max(0.0, glm::dot(glm::dvec3(n), glm::dvec3(glm::vec3(q.wi)))));
  }
  const auto got = askModel(bench.device, classicOf(IlluminationModel::lambert, 1, 0, 0), questions);
  Worst worst;
  for (std::size_t i = 0; i < got.size(); ++i) {
    worst.add(got[i].x, expected[i], got[i].x < 0 ? std::nan("") : std::abs(got[i].x - expected[i]));
    const auto angle = std::acos(glm::dot(glm::vec3(questions[i].normal), glm::vec3(questions[i].wi)));
    worst.addNaive(std::abs(std::max(std::cos(angle), 0.0f) - expected[i]));
  }
  // Three products and two sums of terms below 1; the normal's own normalization adds as much.
  result.measure("kernel", "Lambert's cosine within 1e-1 ... 1e-8 of the terminator", worst, 4 * kU, "absolute");
}

void highlightGate(const Bench& bench, CaseResult& result) {
  // The viewer stands where the mirrored light goes, and the light on the horizon.
  std::vector<ModelQuestion> questions;
  const std::array<double, 5> heights{0, 1e-8, 1e-7, 1e-5, 1e-3};
  for (const double h : heights) {
    const glm::vec3 wi = grazing(h);
    questions.push_back(questionOf(glm::vec3(-wi.x, 0, wi.z), wi));
  }
  const auto phong = askModel(bench.device, classicOf(IlluminationModel::phong, 0, 0.5f, 10), questions);
  const auto modified = askModel(bench.device, classicOf(IlluminationModel::modifiedPhong, 0, 0.5f, 10), questions);
  Worst gate, continuous;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    gate.addAbsolute(phong[i].x, heights[i] > 0 ? 0.5 : 0.0);
    continuous.addAbsolute(modified[i].x, 0.5 * 6 * heights[i]);
    // Closed where N.L < 0, as listings have it: on at exactly 0.
    const glm::vec3 wi(questions[i].wi), mirrored = glm::vec3(0, 0, 2 * wi.z) - wi;
    const float highlight =
        wi.z < 0 ? 0.0f : 0.5f * std::pow(std::max(glm::dot(mirrored, glm::vec3(questions[i].wo)), 0.0f), 10.0f);
    gate.addNaive(std::abs(highlight - (heights[i] > 0 ? 0.5 : 0.0)));
  }
  result.measure("kernel", "Phong's highlight is off at N.L = 0 and on above", gate, 1e-6, "absolute");
  result.measure("kernel", "modified Phong's highlight grows from 0", continuous, 1e-6, "absolute");
}

void oppositeDirections(const Bench& bench, CaseResult& result) {
  Random random(10);
  std::vector<ModelQuestion> questions;
  for (int i = 0; i < 300; ++i) {
    const glm::vec3 wo = i < 3 ? glm::vec3(i == 0, i == 1, i == 2) : glm::vec3(random.direction());
    questions.push_back(questionOf(wo, -wo));
    // Almost opposite, both grazing.
    if (i % 3 == 0) questions.push_back(questionOf(grazing(1e-4), -grazing(-1e-4)));
  }
  for (const IlluminationModel model : {IlluminationModel::blinnPhong, IlluminationModel::cookTorrance}) {
    Material m = classicOf(model, 0, 1, 10);
    m.perceptualRoughnessFactor = 0.3f;
    std::uint64_t wrong = 0, naive = 0;
    const auto got = askModel(bench.device, m, questions);
    for (std::size_t i = 0; i < got.size(); ++i) {
      const glm::vec3 wo(questions[i].wo), wi(questions[i].wi), h = wo + wi;
      const bool opposite = wo == -wi;
      const bool behind = wi.z <= 0;
      wrong += !std::isfinite(got[i].x) || got[i].x < 0 || (opposite && behind && got[i].x != 0);
      naive += std::isnan(h.z / glm::length(h));
    }
    result.count("kernel",
                 std::string("values that are not finite, or not dark behind: ") +
                     (model == IlluminationModel::blinnPhong ? "Blinn-Phong" : "Cook-Torrance"),
                 wrong, got.size(), static_cast<double>(naive));
  }
}

void narrowLobes(const Bench& bench, CaseResult& result) {
  for (const double alpha : {1e-1, 1e-2, 1e-3}) {
    Material m;  // a white mirror: Fresnel's term is 1
    m.perceptualRoughnessFactor = static_cast<float>(std::sqrt(alpha));
    const Real rough = m.perceptualRoughnessFactor, a = std::max(rough * rough, 1e-3L), a2 = a * a;
    std::vector<ModelQuestion> questions;
    for (int i = 0; i <= 100; ++i) {
      const double theta = 2 * std::atan(alpha * i / 25.0);  // the half vector's slope is 0 ... 4 alpha
      questions.push_back(questionOf(
          {0, 0, 1}, glm::vec3(static_cast<float>(std::sin(theta)), 0, static_cast<float>(std::cos(theta)))));
    }
    const auto got = askModel(bench.device, m, questions);
    Worst worst;
    for (std::size_t i = 0; i < got.size(); ++i) {
      const Vec wo(0, 0, 1), wi = glm::normalize(Vec(glm::vec3(questions[i].wi))), h = glm::normalize(wo + wi);
      const Real sine2 = h.x * h.x + h.y * h.y, q = a2 * h.z * h.z + sine2, d = a2 / (kPiReal * q * q);
      const Real v = 0.5L / (wi.z + std::sqrt(wi.z * wi.z * (1 - a2) + a2));
      const auto expected = static_cast<double>(d * v * wi.z);
      worst.addRelative(got[i].x, expected);
      const glm::vec3 fh = glm::normalize(glm::vec3(0, 0, 1) + glm::vec3(questions[i].wi));
      const auto fa2 = static_cast<float>(a2);
      const float fq = fh.z * fh.z * (fa2 - 1) + 1;
      worst.addNaive(std::abs(static_cast<double>(fa2 / (3.14159265f * fq * fq)) / static_cast<double>(d) - 1));
    }
    // The half vector's direction is off by 4 u, the lobe's slope in it 4 / alpha at most.
    result.measure("kernel", "GGX of alpha " + std::to_string(alpha).substr(0, 5) + ", down its lobe", worst,
                   1e-5 + 16 * kU / alpha, "relative");
  }
}

// What goes from l to v must go from v to l.
void grazingBothWays(const Bench& bench, CaseResult& result) {
  Material m;
  m.perceptualRoughnessFactor = 0.5f;
  std::vector<ModelQuestion> questions;
  for (const double a : {1e-6, 1e-5, 1e-3, 0.1}) {
    for (const double b : {1e-6, 1e-4, 1e-2, 0.5}) {
      const glm::vec3 v = grazing(a), l(-grazing(b).x, 0, grazing(b).z);
      questions.push_back(questionOf(v, l));
      questions.push_back(questionOf(l, v));
    }
  }
  const std::size_t paired = questions.size();
  for (const double s : {1e-12, 1e-23, 1e-30}) questions.push_back(questionOf({1, 0, s}, {-1, 0, s}));
  const auto got = askModel(bench.device, m, questions);
  Worst reciprocal;
  for (std::size_t i = 0; i < paired; i += 2) {
    const double there = got[i].x / questions[i].wi.z, back = got[i + 1].x / questions[i + 1].wi.z;
    reciprocal.addRelative(there, back);
  }
  // Both ways round the half vector and D alike; lambda's products, root and quotient differ in order.
  result.measure("kernel", "light there and back at cosines of 1e-6 ... 0.5", reciprocal, 16 * kUlp, "relative");
  std::uint64_t wrong = 0, naive = 0;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    wrong += !std::isfinite(got[i].x) || got[i].x < 0;
    const float v = questions[i].wo.z, l = questions[i].wi.z, a2 = 0.0625f;
    const auto masking = [a2](float c) { return 2 * c / (c + std::sqrt(a2 + (1 - a2) * c * c)); };
    naive += !std::isfinite(masking(v) * masking(l) / (4 * v * l));
  }
  result.count("kernel", "values that are not finite, or negative, down to cosines of 1e-30", wrong, questions.size(),
               static_cast<double>(naive));
}

void roughSurfaces(const Bench& bench, CaseResult& result) {
  Material m = classicOf(IlluminationModel::orenNayar, 1, 0, 0), smooth = m, matte = m;
  m.classic.roughness = 0.3f;
  smooth.classic.roughness = 0;
  matte.model = IlluminationModel::lambert;
  std::vector<ModelQuestion> questions;
  for (const double o : {0.0, 30.0, 60.0, 89.0, 89.99}) {
    for (const double i : {0.0, 45.0, 60.0, 89.0, 89.99}) {
      for (const double phi : {0.0, 90.0, 180.0})
        questions.push_back(questionOf(directionAt(o, 20), directionAt(i, 20 + phi)));
    }
  }
  const auto got = askModel(bench.device, m, questions), flat = askModel(bench.device, smooth, questions),
             lambert = askModel(bench.device, matte, questions);
  Worst worst;
  std::uint64_t different = 0;
  for (std::size_t k = 0; k < got.size(); ++k) {
    const Vec wo(glm::vec3(questions[k].wo)), wi(glm::vec3(questions[k].wi));
    const Real s2 = static_cast<Real>(0.3f) * 0.3f, a = 1 - s2 / 2 / (s2 + 0.33L), b = 0.45L * s2 / (s2 + 0.09L);
    const Real sines = std::max(glm::dot(wo, wi) - wo.z * wi.z, 0.0L);
    const auto expected = static_cast<double>(wi.z * (a + b * sines / std::max(wo.z, wi.z)));
    worst.addAbsolute(got[k].x, expected);
    // With angles, in single precision.
    const float ti = std::acos(glm::vec3(questions[k].wi).z), to = std::acos(glm::vec3(questions[k].wo).z);
    const float alpha = std::max(ti, to), beta = std::min(ti, to);
    const glm::vec3 pi = glm::vec3(questions[k].wi) - glm::vec3(0, 0, std::cos(ti)),
                    po = glm::vec3(questions[k].wo) - glm::vec3(0, 0, std::cos(to));
    const float phi = std::max(glm::dot(glm::normalize(pi), glm::normalize(po)), 0.0f);
    worst.addNaive(std::abs(
        std::cos(ti) * (static_cast<float>(a) + static_cast<float>(b) * phi * std::sin(alpha) * std::tan(beta)) -
        expected));
    different += flat[k] != lambert[k];
  }
  result.measure("kernel", "rough matte surface, light and viewer up to 89.99 degrees", worst, 1e-5, "absolute");
  result.count("kernel", "values of roughness 0 that are not Lambert's, bit for bit", different, got.size());
}

}  // namespace

std::vector<HardCase> modelCases() {
  return {
      {"I1", "the terminator", "close to it the cosine is a difference of products: its sign may flip",
       "four roundings of terms below 1", true, terminator, nullptr,
       "its cosine has no other form; the case is held against offsets and clamps that would lift it"},
      {"I2", "highlights at the gate", "with the light on the horizon the textbook's highlight jumps from 0 to ks",
       "the gate closes at N.L <= 0; the modified model is continuous", true, highlightGate},
      {"I10", "light from straight behind", "L = -V has no half vector: 0 / 0 inside a power",
       "both cosines cannot be positive: dark, exactly", true, oppositeDirections},
      {"I11", "narrow microfacet lobes", "1 - cos^2 cancels: the peak of alpha 0.001 is infinite or 3 % low",
       "slope of the lobe, 4 / alpha, times the half vector's 4 u; 1e-5 besides", true, narrowLobes},
      {"I12", "microfacets at grazing light and view", "masking over 4 (N.L) (N.V) is 0 / 0",
       "16 ulp between both ways; finite however small the cosines", true, grazingBothWays},
      {"I14", "rough matte surfaces at grazing angles",
       "tan(beta) grows without bound, and the azimuth at the normal is 0 / 0",
       "1e-5 as the catalog has it; roughness 0 bit for bit", true, roughSurfaces},
  };
}

}  // namespace crosslight::study

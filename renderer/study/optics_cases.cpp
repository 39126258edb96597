// Cases of smooth boundaries: where light goes and how much of it, near the angles at which the formulas lose digits.
#include <array>
#include <numbers>

#include "study/cases.h"
#include "study/probe.h"
#include "study/random_numbers.h"

namespace crosslight::study {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Snell's law on unit vectors; eta is the index on the ray's side over the one beyond.
Vec snell(const glm::vec3& direction, const glm::vec3& normal, float eta) {
  const Vec d = glm::normalize(Vec(direction)), n = glm::normalize(Vec(normal));
  const Real e = eta, c = -glm::dot(d, n);
  const Vec along = e * (d + c * n);
  return along - std::sqrt(1 - glm::dot(along, along)) * n;
}

Real angleBetween(const Vec& a, const Vec& b) { return 2 * std::asin(glm::length(a - b) / 2); }

// By angles instead of vectors, in single precision.
glm::vec3 snellByAngles(const glm::vec3& d, const glm::vec3& n, float eta) {
  const float incidence = std::acos(std::min(-glm::dot(d, n), 1.0f));
  const float refraction = std::asin(std::min(eta * std::sin(incidence), 1.0f));
  const glm::vec3 along = d + std::cos(incidence) * n;
  const float length = glm::length(along);
  return std::sin(refraction) * (length > 0 ? along / length : glm::vec3(0)) - std::cos(refraction) * n;
}

void bentRays(const Bench& bench, CaseResult& result) {
  Random random(16);
  std::vector<ProbeArguments> arguments;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 n = random.direction(), across = glm::normalize(glm::cross(n, random.direction()));
    const double angle = i % 100 == 0 ? 1e-4 * random.unit() : random.between(0, 80) * kDegree;
    const float eta = static_cast<float>(1 / std::array{1.31, 1.33, 1.5, 1.52, 1.54}[random.below(5)]);
    arguments.push_back({{glm::vec3(std::sin(angle) * across - std::cos(angle) * n), eta}, {glm::vec3(n), 0}, {}, {}});
  }
  const auto answers = askFunction(bench.device, Function::refracted, arguments);
  Worst worst;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const glm::vec3 d(arguments[i].a), n(arguments[i].b);
    const Vec exact = snell(d, n, arguments[i].a.w);
    const Real error = glm::length(Vec(glm::vec3(answers[i].a)) - exact);
    worst.add(static_cast<double>(error), 0, static_cast<double>(error));
    worst.addNaive(static_cast<double>(glm::length(Vec(snellByAngles(d, n, arguments[i].a.w)) - exact)));
  }
  result.measure("kernel", "direction of rays bent into water and glass, 0 to 80 degrees", worst, 4e-7, "absolute");
}

// An angle below the critical one of glass (1.5) to air: direction and normal.
ProbeArguments belowCritical(double less) {
  const double angle = std::asin(1 / 1.5) - less;
  return {{static_cast<float>(std::sin(angle)), 0, static_cast<float>(-std::cos(angle)), 1.5f}, {0, 0, 1, 0}, {}, {}};
}

void almostTotalReflection(const Bench& bench, CaseResult& result) {
  // Measured in single precision, doubled: digits that the cosine's own rounding takes away.
  constexpr std::array<std::pair<double, double>, 4> kRows{
      {{1e-3, 9e-6}, {1e-4, 2.6e-5}, {1e-5, 7.4e-5}, {1e-6, 3.2e-4}}};
  for (const auto& [less, bound] : kRows) {
    const ProbeArguments p = belowCritical(less);
    const ProbeAnswer answer = askFunction(bench.device, Function::refracted, {p})[0];
    const Vec exact = snell(glm::vec3(p.a), glm::vec3(p.b), p.a.w);
    const double angle = static_cast<double>(angleBetween(Vec(glm::vec3(answer.a)), exact));
    Worst worst;
    worst.add(angle, 0, answer.a.w == 1.0f ? angle : std::nan(""));
    result.measure("kernel", "direction " + std::to_string(less).substr(0, 8) + " rad below the critical angle", worst,
                   bound, "radians");
  }
}

Real reflectanceOf(float cosine, float eta) {
  const Real c = cosine, e = eta, sine2 = e * e * (1 - c * c);
  if (sine2 >= 1) return 1;
  const Real t = std::sqrt(1 - sine2), s = (e * c - t) / (e * c + t), p = (c - e * t) / (c + e * t);
  return (s * s + p * p) / 2;
}

// Fresnel 1823 in its form by angles, in single precision.
float reflectanceByAngles(float cosine, float eta) {
  const float i = std::acos(cosine), t = std::asin(std::min(eta * std::sin(i), 1.0f));
  const float s = std::sin(i - t) / std::sin(i + t), p = std::tan(i - t) / std::tan(i + t);
  return 0.5f * (s * s + p * p);
}

void reflectedShare(const Bench& bench, CaseResult& result) {
  std::vector<ProbeArguments> arguments;
  for (const double index : {1.31, 1.33, 1.5, 1.52, 1.54}) {
    for (int i = 0; i <= 899; ++i) {
      arguments.push_back(
          {{static_cast<float>(std::cos(i / 10.0 * kDegree)), static_cast<float>(1 / index), 0, 0}, {}, {}, {}});
    }
  }
  const auto answers = askFunction(bench.device, Function::reflectance, arguments);
  Worst worst;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const auto expected = static_cast<double>(reflectanceOf(arguments[i].a.x, arguments[i].a.y));
    worst.addRelative(answers[i].a.x, expected);
    worst.addNaive(std::abs(reflectanceByAngles(arguments[i].a.x, arguments[i].a.y) / expected - 1));
  }
  result.measure("kernel", "reflected share on water and glass, 0 to 89.9 degrees", worst, 16 * kUlp, "relative");
}

void nearlyNoBoundary(const Bench& bench, CaseResult& result) {
  std::vector<ProbeArguments> same;
  for (int i = 0; i <= 100; ++i) same.push_back({{static_cast<float>(i) / 100.0f, 1.0f, 0, 0}, {}, {}, {}});
  Worst equal;
  for (std::size_t i = 0; const ProbeAnswer& answer : askFunction(bench.device, Function::reflectance, same)) {
    equal.addAbsolute(answer.a.x, 0);
    const float c = same[i++].a.x, s = (c - c) / (c + c);  // the textbook's quotient: 0 / 0 at grazing incidence
    equal.addNaive(s * s);
  }
  result.measure("kernel", "reflected share between equal indices, at every angle", equal, 0, "absolute");
  for (const double more : {3e-4, 1e-6}) {
    const auto eta = static_cast<float>(1 / (1 + more));
    const ProbeAnswer answer = askFunction(bench.device, Function::reflectance, {{{1, eta, 0, 0}, {}, {}, {}}})[0];
    const auto expected = static_cast<double>(reflectanceOf(1, eta));
    Worst worst;
    worst.addRelative(answer.a.x, expected);
    worst.addNaive(std::abs(reflectanceByAngles(1, eta) / expected - 1));
    result.measure("kernel", more > 1e-5 ? "reflected share at index 1.0003" : "reflected share at index 1.000001",
                   worst, 1e-3, "relative");
  }
}

void shareNearTotalReflection(const Bench& bench, CaseResult& result) {
  constexpr std::array<std::pair<double, double>, 4> kRows{{{1e-2, 5e-6}, {1e-3, 5e-6}, {1e-4, 2e-5}, {1e-5, 5e-5}}};
  for (const auto& [less, bound] : kRows) {
    const float cosine = -belowCritical(less).a.z;
    const ProbeAnswer answer =
        askFunction(bench.device, Function::reflectance, {{{cosine, 1.5f, 0, 0}, {}, {}, {}}})[0];
    Worst worst;
    worst.addAbsolute(answer.a.x, static_cast<double>(reflectanceOf(cosine, 1.5f)));
    // Schlick's fit, which knows no critical angle.
    const float m = 1 - cosine;
    worst.addNaive(std::abs(0.04 + 0.96 * std::pow(m, 5) - worst.expected()));
    result.measure("kernel", "reflected share " + std::to_string(less).substr(0, 7) + " rad below the critical angle",
                   worst, bound, "absolute");
  }
}

// A thousand reflections between two mirrors that are not quite parallel.
void thousandReflections(const Bench& bench, CaseResult& result) {
  const glm::vec3 first(0, 0, 1), second(glm::normalize(glm::dvec3(0.003, 0.001, -1))),
      d(glm::normalize(glm::dvec3(0.3, 0.2, -0.9)));
  Vec exact = glm::normalize(Vec(d));
  glm::vec3 naive = d;
  for (int i = 0; i < 1000; ++i) {
    const Vec n = glm::normalize(Vec(i % 2 == 0 ? first : second));
    exact -= 2 * glm::dot(exact, n) * n;
    const glm::vec3 m = i % 2 == 0 ? first : second;
    naive -= 2 * glm::dot(naive, m) * m;
  }
  const ProbeAnswer answer =
      askFunction(bench.device, Function::mirrored, {{{d, 1000}, {first, 0}, {second, 0}, {}}})[0];
  const Vec got(glm::vec3(answer.a));
  Worst length, direction;
  length.addAbsolute(static_cast<double>(glm::length(got)), 1);
  length.addNaive(std::abs(static_cast<double>(glm::length(Vec(naive))) - 1));
  const auto turned = static_cast<double>(angleBetween(glm::normalize(got), exact));
  direction.add(turned, 0, turned);
  // Scaled before it is normalized: 8 u, as of any unit vector.
  result.measure("kernel", "length of a direction after a thousand reflections", length, 8 * kU, "absolute");
  // Each turns it by 4 u at most, at random.
  result.measure("kernel", "direction after a thousand reflections", direction, 4 * kU * std::sqrt(1000.0), "radians");
}

// In and out of a hundred slabs of glass: the direction at the end is that at the beginning.
void hundredSlabs(const Bench& bench, CaseResult& result) {
  // Measured in single precision over the same hundred slabs, three times that.
  constexpr std::array<std::pair<double, double>, 4> kRows{{{10, 3.6e-7}, {80, 2e-6}, {89, 3e-5}, {89.9, 1e-4}}};
  std::vector<ProbeArguments> rays;
  std::vector<glm::vec3> first, naive;
  for (const auto& [degrees, bound] : kRows) {
    const double a = degrees * kDegree;
    first.emplace_back(std::sin(a), 0, -std::cos(a));
    rays.push_back({{first.back(), 0}, {0, 0, 1, 0}, {}, {}});
  }
  naive = first;
  for (int boundary = 0; boundary < 200; ++boundary) {
    const float eta = boundary % 2 == 0 ? 1 / 1.5f : 1.5f;
    for (ProbeArguments& r : rays) r.a.w = eta;
    const auto answers = askFunction(bench.device, Function::refracted, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      rays[i].a = {glm::vec3(answers[i].a), 0};
      naive[i] = snellByAngles(naive[i], {0, 0, 1}, eta);
    }
  }
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto turned = [&](const glm::vec3& d) {
      return static_cast<double>(angleBetween(glm::normalize(Vec(d)), glm::normalize(Vec(first[i]))));
    };
    Worst worst;
    worst.add(turned(glm::vec3(rays[i].a)), 0, turned(glm::vec3(rays[i].a)));
    worst.addNaive(turned(naive[i]));
    result.measure("kernel",
                   "direction after a hundred slabs, " + std::to_string(kRows[i].first).substr(0, 4) + " degrees",
                   worst, kRows[i].second, "radians");
  }
}

}  // namespace

std::vector<HardCase> opticsCases() {
  return {
      {"T16", "Snell's law", "by angles, directions near the normal lose half of their digits in acos",
       "eight roundings on unit vectors: 4e-7", true, bentRays},
      {"T17", "refraction just below the critical angle",
       "the root of nearly zero turns the last bit of the cosine into a change of direction",
       "condition number (critical - angle)^(-1/2) on single-precision input; measured in fp32, doubled", true,
       almostTotalReflection, nullptr,
       "every form shares the condition number; that none reports total reflection is what is held"},
      {"T22", "a thousand reflections",
       "directions that are never normalized grow longer, or shorter, with each bounce",
       "8 u for the length; roundings of 4 u that add up at random for the direction", true, thousandReflections},
      {"T18", "a hundred slabs of glass",
       "each boundary turns a ray by its roundings; after a hundred a way may have drifted",
       "measured in fp32 over the same slabs, times three: (cosine)^-1 of the incidence", true, hundredSlabs, nullptr,
       "each boundary rounds in any form; what is held is that a hundred do not add up"},
      {"I15", "boundary between nearly equal indices", "0 / 0 at grazing incidence, and no digits left of (n - 1)",
       "Sterbenz: n - 1 is exact, so only the index's own rounding counts", true, nearlyNoBoundary},
      {"I16", "reflection just below the critical angle", "the share of reflected light rises with infinite slope",
       "condition number (critical - angle)^(-1/2), measured in fp32", true, shareNearTotalReflection},
      {"I17", "Fresnel's equations at their fixed points",
       "by angles, 0 / 0 at normal incidence and noise at Brewster's angle",
       "16 ulp of the exact value of the rounded "
       "arguments",
       true, reflectedShare},
  };
}

}  // namespace crosslight::study

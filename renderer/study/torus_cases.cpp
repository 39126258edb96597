// The torus from far away: a quartic equation whose coefficients grow with the fourth power of the distance.
#include <fmt/format.h>

#include "accel/intersect.h"
#include "study/cases.h"
#include "study/probe.h"
#include "study/random_numbers.h"

namespace crosslight::study {
namespace {

constexpr float kTube = 0.25f;

struct Line {
  glm::vec3 origin, direction;
};

// How far the exact line's nearest point to the torus lies within it (positive) or beside it.
double depthWithin(const Line& l) {
  const glm::dvec3 o(l.origin), d = glm::normalize(glm::dvec3(l.direction)), middle = o - glm::dot(o, d) * d;
  double deepest = -1e9;
  for (int i = -1000; i <= 1000; ++i) {
    const glm::dvec3 p = middle + 1.3 * i / 1000.0 * d;
    deepest = std::max(deepest, static_cast<double>(kTube) - std::hypot(std::hypot(p.x, p.z) - 1, p.y));
  }
  return deepest;
}

// Whether the quartic whose coefficients are formed at the ray's origin, in single precision, is negative anywhere near
// the torus; evaluated without further rounding.
bool naiveHits(const Line& l) {
  const glm::vec3 o = l.origin, d = l.direction;
  const float g = glm::dot(o, o) + 1 - kTube * kTube, h = glm::dot(o, d), q = d.x * d.x + d.z * d.z;
  const float c[5] = {g * g - 4 * (o.x * o.x + o.z * o.z), 4 * g * h - 8 * (o.x * d.x + o.z * d.z),
                      2 * g + 4 * h * h - 4 * q, 4 * h, 1};
  for (int i = -1000; i <= 1000; ++i) {
    const Real t = -h + 1.3L * i / 1000;
    if ((((c[4] * t + c[3]) * t + c[2]) * t + c[1]) * t + c[0] < 0) return true;
  }
  return false;
}

void farTorus(const Bench& bench, CaseResult& result) {
  for (const double distance : {10.0, 100.0, 1e4}) {
    Random random(15);
    std::vector<Line> lines;
    std::vector<ProbeArguments> arguments;
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec3 from = distance * random.direction();
      const glm::dvec3 to(random.between(-1.3, 1.3), random.between(-0.3, 0.3), random.between(-1.3, 1.3));
      lines.push_back({glm::vec3(from), glm::vec3(glm::normalize(to - from))});
      arguments.push_back({{static_cast<float>(ShapeKind::torus), 0, 3e38f, 0},
                           {1, kTube, 0, 0},
                           {lines.back().origin, 0},
                           {lines.back().direction, 0}});
    }
    // Product and sum that move the origin to the torus: gamma_3 of the distance on each of three axes. Nearer to the
    // surface than that, and than the search's own steps, either answer is right.
    const double margin = std::sqrt(3.0) * gammaOf(3) * distance + 2e-3;
    const auto answers = askFunction(bench.device, Function::shape, arguments);
    std::uint64_t wrong = 0, naive = 0, compared = 0;
    Worst surface;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const ProbeAnswer& answer = answers[i];
      const bool hit = answer.a.w == 1.0f;
      if (hit)
        surface.addAbsolute(std::hypot(std::hypot(static_cast<double>(answer.a.x), answer.a.z) - 1, answer.a.y), kTube);
      const double depth = depthWithin(lines[i]);
      if (std::abs(depth) < margin) continue;
      ++compared;
      wrong += hit != (depth > 0);
      naive += naiveHits(lines[i]) != (depth > 0);
    }
    result.count("kernel", fmt::format("rays that wrongly hit or miss a torus {:g} away", distance), wrong, compared,
                 static_cast<double>(naive));
    result.measure("kernel", fmt::format("points hit, from the tube's axis, {:g} away", distance), surface, 1e-5,
                   "absolute");
  }
}

}  // namespace

std::vector<HardCase> torusCases() {
  return {{"T15", "the torus from far away",
           "coefficients formed at the ray's origin keep no digit of the tube from a hundred radii on",
           "gamma_3 per axis of the point nearest to the torus; its point lies on the tube to 1e-5", true, farTorus}};
}

}  // namespace crosslight::study

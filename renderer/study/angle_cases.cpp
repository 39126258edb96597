// Cases of directions and the angles between them: frames about any normal, places near a sphere's pole.
#include <array>

#include "study/cases.h"
#include "study/probe.h"
#include "study/random_numbers.h"

namespace crosslight::study {
namespace {

struct Frame {
  glm::vec3 across, other;
};

// Frisvad 2012, "Building an Orthonormal Basis from a 3D Unit Vector Without Normalization", listing 2.
Frame frisvad(const glm::vec3& n) {
  const float a = 1.0f / (1.0f + n.z), b = -n.x * n.y * a;
  return {{1.0f - n.x * n.x * a, b, -n.x}, {b, 1.0f - n.y * n.y * a, -n.y}};
}

// The farthest that lengths are from 1 and cosines from 0.
double skewOf(const glm::vec3& normal, const Frame& frame) {
  const Vec n = glm::normalize(Vec(normal)), t(frame.across), b(frame.other);
  const std::array<Real, 5> skews{glm::length(t) - 1, glm::length(b) - 1, glm::dot(t, b), glm::dot(t, n),
                                  glm::dot(b, n)};
  Real worst = 0;
  for (const Real skew : skews) worst = std::max(worst, std::abs(skew));
  return static_cast<double>(worst);
}

void framesAboutNormals(const Bench& bench, CaseResult& result) {
  Random random(18);
  std::vector<ProbeArguments> arguments;
  // Found by Duff et al. 2017, "Building an Orthonormal Basis, Revisited", section 2, and beside it.
  for (const float z : {-0.99999988f, -0.99999994f}) {
    arguments.push_back({{0.00038527316f, 0.00038460016f, z, 0}, {}, {}, {}});
    arguments.push_back({{0, 0, z, 0}, {}, {}, {}});
  }
  arguments.push_back({{0, 0, -1, 0}, {}, {}, {}});
  const int directions = bench.full ? 2000000 : 50000;
  for (int i = 0; i < directions; ++i) {
    const glm::dvec3 d = random.direction();
    const double near = i % 2 == 0 ? 1.0 : 1e-3;  // every other one close to -z
    const glm::dvec3 n = near < 1 ? glm::normalize(glm::dvec3(near * d.x, near * d.y, -1)) : d;
    arguments.push_back({{glm::vec3(n), 0}, {}, {}, {}});
  }
  const auto answers = askFunction(bench.device, Function::perpendicular, arguments);
  Worst worst;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const glm::vec3 n(arguments[i].a);
    worst.addAbsolute(skewOf(n, {glm::vec3(answers[i].a), glm::vec3(answers[i].b)}), 0);
    worst.addNaive(skewOf(n, frisvad(n)));
  }
  result.measure("kernel", "lengths and cosines of frames about 50,000 normals and more", worst, 16 * kU, "absolute");
}

void anglesFromThePole(const Bench& bench, CaseResult& result) {
  Random random(19);
  const float radius = 2;
  std::vector<ProbeArguments> arguments;
  for (int i = 0; i < 20000; ++i) {
    const double angle = std::pow(10.0, random.between(-7, std::log10(1.5))), around = random.between(-3, 3);
    const double pole = i % 2 == 0 ? 1 : -1;
    const glm::dvec3 p(std::sin(angle) * std::cos(around), pole * std::cos(angle), std::sin(angle) * std::sin(around));
    arguments.push_back({{glm::vec3(p * static_cast<double>(radius)), radius}, {}, {}, {}});
  }
  const auto answers = askFunction(bench.device, Function::sphericalPlace, arguments);
  Worst north, south;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const Vec p{glm::vec3(arguments[i].a)};
    const Real angle = std::atan2(std::hypot(p.x, p.z), p.y) / kPiReal;
    const float naive = std::acos(std::clamp(arguments[i].a.y / radius, -1.0f, 1.0f)) / 3.14159265f;
    if (p.y > 0) {
      north.addRelative(answers[i].a.y, static_cast<double>(angle));
      north.addNaive(static_cast<double>(std::abs(naive / angle - 1)));
    } else {
      south.addAbsolute(answers[i].a.y, static_cast<double>(angle));
      south.addNaive(static_cast<double>(std::abs(naive - angle)));
    }
  }
  // atan(y, x) by Vulkan: 4096 ulp; length() 3 ulp before it, the quotient by pi 2.5 after.
  constexpr double kAngle = (4096 + 6) * kUlp;
  result.measure("kernel", "latitude 1e-7 to 1.5 rad from a sphere's north pole", north, kAngle, "relative");
  result.measure("kernel", "the same, from the south pole", south, kAngle, "absolute");
}

}  // namespace

std::vector<HardCase> angleCases() {
  return {
      {"I18", "frames about normals near -z",
       "the frame without a root divides by 1 + z: near -z it is neither of unit length nor at right angles",
       "a cross product with the axis that is farthest away, normalised: a dozen roundings", true, framesAboutNormals},
      {"I19", "small angles",
       "acos of a cosine near 1 is worth nothing: textures near a sphere's pole break into rings",
       "by both legs: what Vulkan permits atan(y, x)", true, anglesFromThePole},
  };
}

}  // namespace crosslight::study

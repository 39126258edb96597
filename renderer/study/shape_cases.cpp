// Cases of rays against analytic shapes: far, huge, tiny, grazed, left and begun inside.
#include <array>

#include "accel/intersect.h"
#include "study/cases.h"
#include "study/probe.h"
#include "study/random_numbers.h"

namespace crosslight::study {
namespace {

struct Line {
  glm::vec3 origin, direction;
};

constexpr float kFar = 3e38f;

std::vector<ProbeAnswer> hitsOf(const Bench& bench, ShapeKind kind, const glm::vec4& params,
                                const std::vector<Line>& lines) {
  std::vector<ProbeArguments> arguments;
  for (const Line& l : lines) {
    arguments.push_back({{static_cast<float>(kind), 0, kFar, 0}, params, {l.origin, 0}, {l.direction, 0}});
  }
  return askFunction(bench.device, Function::shape, arguments);
}

bool isHit(const ProbeAnswer& answer) { return answer.a.w == 1.0f; }

// Distance of the line from the origin: exact to 1e-19 of the square of the line's own distance.
Real impactOf(const Line& l) {
  const Vec o(l.origin), d(l.direction);
  const Vec c = glm::cross(o, d);
  return glm::length(c) / glm::length(d);
}

// b^2 - 4 a c > 0 in single precision.
bool naiveHits(const Line& l, float radius) {
  const float a = glm::dot(l.direction, l.direction), b = 2 * glm::dot(l.origin, l.direction);
  return b * b - 4 * a * (glm::dot(l.origin, l.origin) - radius * radius) >= 0;
}

// A line that starts at `distance` and passes the origin at `impact`.
Line passing(Random& random, double distance, double impact) {
  const glm::dvec3 d = random.direction(), across = glm::normalize(glm::cross(d, random.direction()));
  return {glm::vec3(impact * across - distance * d), glm::vec3(d)};
}

// Rays whose hit or miss is wrong: by how far they pass the sphere's edge, in distances of the ray's origin.
void misjudged(const Bench& bench, CaseResult& result, const std::string& what, double distance,
               const std::vector<Line>& lines) {
  const auto answers = hitsOf(bench, ShapeKind::sphere, {1, 0, 0, 0}, lines);
  Worst worst;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Real beyond = impactOf(lines[i]) - 1;
    const double error = static_cast<double>(std::abs(beyond)) / distance;
    const bool shouldHit = beyond <= 0;
    worst.add(isHit(answers[i]), shouldHit, isHit(answers[i]) == shouldHit ? 0 : error);
    worst.addNaive(naiveHits(lines[i], 1) == shouldHit ? 0 : error);
  }
  // The point of the ray nearest to the center: product and sum round once each per axis, what b rounds moves it along
  // the ray only. Three axes, and the sphere's own rounding.
  result.measure("kernel", what, worst, std::sqrt(3.0) * gammaOf(3), "of the distance");
}

void tangentRays(const Bench& bench, CaseResult& result) {
  for (const double distance : {2.0, 10.0, 100.0}) {
    Random random(3);
    std::vector<Line> lines;
    for (int i = 0; i < 20000; ++i) {
      const double ulps = std::pow(10.0, random.between(0, 5)) * (i % 2 == 0 ? 1 : -1);
      lines.push_back(passing(random, distance, 1 + ulps * kU));
    }
    misjudged(bench, result, "hit or miss of rays that graze a sphere from " + std::to_string(int(distance)) + " radii",
              distance, lines);
  }
}

void farSpheres(const Bench& bench, CaseResult& result) {
  for (int power = 2; power <= 6; ++power) {
    const double distance = std::pow(10.0, power);
    Random random(4);
    std::vector<Line> lines;
    for (int i = 0; i < 20000; ++i) lines.push_back(passing(random, distance, 1.4 * std::sqrt(random.unit())));
    misjudged(bench, result, "hit or miss of a sphere 1e" + std::to_string(power) + " radii away", distance, lines);
  }
}

// Unit normal where the ray enters, from the exact line.
Vec normalOf(const Line& l, Real radius) {
  const Vec o(l.origin), d = glm::normalize(Vec(l.direction));
  const Vec nearest = o - glm::dot(o, d) * d;
  return (nearest - std::sqrt(radius * radius - glm::dot(nearest, nearest)) * d) / radius;
}

void tinyAndFar(const Bench& bench, CaseResult& result) {
  constexpr float kRadius = 1e-3f;
  std::vector<Line> lines;
  for (const double impact : {0.0, 0.1, 0.25, 0.5, 0.75, 0.9}) {
    lines.push_back({{static_cast<float>(impact * 1e-3), 0, 1e6f}, {0, 0, -1}});
  }
  const auto answers = hitsOf(bench, ShapeKind::sphere, {kRadius, 0, 0, 0}, lines);
  Worst worst;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Vec exact = normalOf(lines[i], kRadius);
    const auto error = static_cast<double>(glm::length(glm::normalize(Vec(glm::vec3(answers[i].b))) - exact));
    worst.add(answers[i].b.z, static_cast<double>(exact.z), isHit(answers[i]) ? error : std::nan(""));
    // From the point o + t d, whose t counts in sixteenths of a unit.
    const glm::vec3 p = lines[i].origin + lines[i].direction * (1e6f - kRadius);
    worst.addNaive(static_cast<double>(glm::length(Vec(p / kRadius) - exact)));
  }
  result.measure("kernel", "normal of a sphere of radius 0.001 seen from 1,000,000", worst, 1e-6, "absolute");
}

void hugeSpheres(const Bench& bench, CaseResult& result) {
  for (const double radius : {1e2, 1e4, 1e6}) {
    Random random(6);
    std::vector<Line> lines;
    for (int i = 0; i < 5000; ++i) {
      glm::dvec3 d = random.direction();
      d.y = -std::abs(d.y) - 0.6;
      lines.push_back({{0, static_cast<float>(radius + 1), 0}, glm::vec3(glm::normalize(d))});
    }
    const auto r = static_cast<float>(radius);
    const auto answers = hitsOf(bench, ShapeKind::sphere, {r, 0, 0, 0}, lines);
    Worst worst;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Vec o(lines[i].origin), d(lines[i].direction);
      const Real a = glm::dot(d, d), b = -glm::dot(o, d), c = (o.y - radius) * (o.y + radius);
      const auto exact = static_cast<double>(c / (b + std::sqrt(b * b - a * c)));
      worst.add(answers[i].b.w, exact, isHit(answers[i]) ? std::abs(answers[i].b.w - exact) : std::nan(""));
      const float fb = -glm::dot(lines[i].origin, lines[i].direction);
      const float fc = glm::dot(lines[i].origin, lines[i].origin) - r * r;
      worst.addNaive(std::abs(fb - std::sqrt(fb * fb - fc) - exact));
    }
    result.measure("kernel",
                   "distance to a floor that is a sphere of radius 1e" + std::to_string(int(std::log10(radius))), worst,
                   4e-6, "absolute");
  }
}

void fromInside(const Bench& bench, CaseResult& result) {
  const glm::vec3 d(0, 1, 0);  // exactly on the surface
  const std::vector<Line> lines{{{0, 0, 0}, d}, {0.5f * d, d}, {0.5f * d, -d}, {d, -d}};
  const double expected[] = {1, 0.5, 1.5, 2};
  const auto answers = hitsOf(bench, ShapeKind::sphere, {1, 0, 0, 0}, lines);
  Worst distance, normal;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    distance.add(answers[i].b.w, expected[i],
                 isHit(answers[i]) ? std::abs(answers[i].b.w / expected[i] - 1) : std::nan(""));
    const float b = glm::dot(lines[i].origin, lines[i].direction), c = glm::dot(lines[i].origin, lines[i].origin) - 1;
    const float nearRoot = -b - std::sqrt(b * b - c);
    distance.addNaive(nearRoot > 0 ? std::abs(nearRoot / expected[i] - 1) : 1);  // the near root alone: a miss
    normal.add(glm::dot(glm::vec3(answers[i].b), lines[i].direction), 1,
               glm::dot(glm::vec3(answers[i].b), lines[i].direction) > 0 ? 0 : 1);
  }
  result.measure("kernel", "distance from the middle, from inside and from the surface", distance, 4 * kUlp,
                 "relative");
  result.measure("kernel", "the normal faces out: against none of these rays", normal, 0, "wrong side");
  const auto leaving = hitsOf(bench, ShapeKind::sphere, {1, 0, 0, 0}, {{{1, 0, 0}, {1, 0, 0}}, {{0, 2, 0}, {0, 1, 0}}});
  result.count("kernel", "rays that leave the surface and meet it", isHit(leaving[0]) + isHit(leaving[1]), 2);
}

void grazedPlanes(const Bench& bench, CaseResult& result) {
  std::vector<Line> lines;
  for (const float slope : {1e-2f, 1e-4f, 1e-7f, 1e-20f, 1e-38f}) lines.push_back({{0, 1, 0}, {1, -slope, 0}});
  Worst worst;
  const auto answers = hitsOf(bench, ShapeKind::plane, {}, lines);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double exact = -1.0 / lines[i].direction.y;
    worst.add(answers[i].b.w, exact, isHit(answers[i]) ? std::abs(answers[i].b.w / exact - 1) : std::nan(""));
  }
  result.measure("kernel", "distance to a plane, slopes 1e-2 ... 1e-38", worst, 2 * kUlp, "relative");
  const std::vector<Line> within{{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 0}, {1, 0, 0}}, {{0, -1, 0}, {1, -0.0f, 0}}};
  std::uint64_t hits = 0, naive = 0;
  for (const ProbeAnswer& answer : hitsOf(bench, ShapeKind::plane, {}, within)) hits += isHit(answer);
  for (const Line& l : within) naive += !(-l.origin.y / l.direction.y <= 0);
  result.count("kernel", "rays along a plane that meet it", hits, within.size(), static_cast<double>(naive));
}

// Rays at which a quadratic form degenerates: along the axis, nearly so, along the wall, through the apex.
std::vector<Line> degenerateRays(float slope) {
  std::vector<Line> lines;
  for (const float tilt : {0.0f, 1e-30f, -1e-30f, 1e-15f, 1e-7f}) {
    lines.push_back({{0.25f, 5, 0.125f}, {tilt, -1, 0}});
    lines.push_back({{0, 5, 0}, {tilt, -1, tilt}});
  }
  lines.push_back({{0.25f, 4, 0}, {slope, -1, 0}});
  lines.push_back({{-3, 0.5f, 0.25f}, {1, 0, 0}});
  lines.push_back({{3, 0.25f, 0}, {-1, 0.0f, 1e-20f}});
  return lines;
}

void degenerateQuadrics(const Bench& bench, CaseResult& result) {
  for (const ShapeKind kind : {ShapeKind::cylinder, ShapeKind::cone}) {
    const glm::vec4 params(1, 2, 0, 0);
    const std::vector<Line> lines = degenerateRays(0.5f);
    const auto answers = hitsOf(bench, kind, params, lines);
    Worst worst;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto exact =
          oracle::closestShapeHit(kind, params, {.origin = lines[i].origin, .direction = lines[i].direction});
      const double t = exact ? exact->t : -1;
      const bool same = isHit(answers[i]) == exact.has_value();
      worst.add(answers[i].b.w, t, !same ? std::nan("") : exact ? std::abs(answers[i].b.w / t - 1) : 0);
      const float k = kind == ShapeKind::cone ? params.x / params.y : 0;
      const glm::vec3 o = lines[i].origin, d = lines[i].direction;
      const float a = d.x * d.x + d.z * d.z - k * k * d.y * d.y;
      const float b = o.x * d.x + o.z * d.z + k * k * (params.y / 2 - o.y) * d.y;
      const float c =
          o.x * o.x + o.z * o.z - (kind == ShapeKind::cone ? k * k * (params.y / 2 - o.y) * (params.y / 2 - o.y) : 1);
      if (exact && a == 0) worst.addNaive(std::abs((-b - std::sqrt(b * b - a * c)) / a / t - 1));
    }
    result.measure("kernel", kind == ShapeKind::cone ? "distance to a cone" : "distance to a cylinder", worst, 1e-5,
                   "relative");
  }
}

}  // namespace

std::vector<HardCase> shapeCases() {
  return {
      {"T3", "rays that graze a sphere",
       "the discriminant of the textbook's quadratic cancels: whole rims appear or vanish",
       "gamma_3 per axis of the ray's point nearest to the center", true, tangentRays},
      {"T4", "spheres far away", "b^2 - 4 a c keeps no digit of the radius from a few thousand radii on",
       "gamma_3 per axis of the ray's point nearest to the center", true, farSpheres},
      {"T5", "a tiny sphere a million units away",
       "the point o + t d cannot be told from the center: the normal is noise",
       "normal from the line's nearest point, some ten roundings", true, tinyAndFar},
      {"T6", "a huge sphere as floor", "|o|^2 - r^2 cancels to nothing one unit above a sphere of a million units",
       "constant term in twice the precision; the rest rounds at the size of the distance, below 4", true, hugeSpheres},
      {"T7", "rays that begin in a sphere, or on it", "the near root is behind the ray, or is the point that it leaves",
       "4 ulp of the exact roots", true, fromInside},
      {"T13", "rays along a plane", "a ray within the plane divides 0 by 0, one beside it 1 by 0", "one quotient", true,
       grazedPlanes},
      {"T14", "rays along a cylinder's axis and a cone's wall",
       "the quadratic equation becomes a linear one: division by 0",
       "oracle in long double; 1e-5 as the catalog has it", true, degenerateQuadrics},
  };
}

}  // namespace crosslight::study

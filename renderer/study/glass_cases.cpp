// Cases of rays that go on: between mirrors, through slabs, out of glass. By rays only: no raster method follows them.
#include <fmt/format.h>

#include <numbers>

#include "study/cases.h"
#include "study/pictures.h"

namespace crosslight::study {
namespace {

double centerOf(const Bench& bench, const Stage& stage, std::uint32_t depth) {
  RenderSettings s = settingsFor(Method::whitted, 9, 9);
  s.maxDepth = depth;
  return pixelAt(bench.draw(stage.scene, s).image, 4, 4)[0];
}

// A slab of glass 1.5 before a wall that glows, seen at normal incidence: T = (1 - F)^2 sum of F^(2 i).
void slabSeries(const Bench& bench, CaseResult& result) {
  Stage stage;
  const int body = stage.add(glass(1.5f));
  stage.addWall(-1.0, body);
  stage.addWall(-2.0, body, false);
  stage.addWall(-3.0, stage.add(emitter(1)));
  Worst worst;
  for (const std::uint32_t depth : {2u, 4u, 6u, 8u}) {
    double sum = 0;
    for (std::uint32_t i = 0; 2 * i + 2 <= depth; ++i) sum += std::pow(0.04, 2 * i);
    worst.addAbsolute(centerOf(bench, stage, depth), 0.96 * 0.96 * sum);
  }
  worst.addNaive(std::abs(1 - 2 * 0.04 - 0.96 * 0.96));  // what both faces reflect, taken off once
  result.measure("whitted", "light through a slab, by number of inner reflections", worst, 1e-6, "absolute");
}

// What passes from one index to another at normal incidence.
double passes(double from, double to) { return 1 - std::pow((from - to) / (from + to), 2); }

// Glass in water, sharing walls: four boundaries, none with air between.
void nestedGlasses(const Bench& bench, CaseResult& result) {
  const double water = 1.33f, body = 1.5f;
  Stage stage;
  const auto slab = [&stage](double near, double far, double index, int priority) {
    Material m = glass(static_cast<float>(index));
    m.priority = priority;
    stage.addShape(ShapeKind::box, {40, 40, static_cast<float>(far - near), 0}, {0, 0, -0.5 * (near + far)},
                   stage.add(m));
  };
  slab(2, 8, water, 1);
  slab(4, 6, body, 2);
  stage.addWall(-12.0, stage.add(emitter(1)));
  Worst worst;
  worst.addAbsolute(centerOf(bench, stage, 4),
                    passes(1, water) * passes(water, body) * passes(body, water) * passes(water, 1));
  // Each body as if it stood in air.
  worst.addNaive(std::abs(std::pow(passes(1, water) * passes(1, body), 2) - worst.expected()));
  result.measure("whitted", "light through glass in water", worst, 2e-6, "absolute");
}

// Two mirrors face each other, one glows: the sum of rho^k.
void mirrorHall(const Bench& bench, CaseResult& result) {
  Material mirror = emitter(0.1f);
  mirror.classic.reflectionFactor = glm::vec3(0.9f);
  Stage stage;
  const int m = stage.add(mirror);
  stage.addWall(-2.0, m);
  stage.addWall(1.0, m, false);
  Worst worst;
  for (std::uint32_t depth = 0; depth <= 12; ++depth) {
    double sum = 0;
    for (std::uint32_t k = 0; k <= depth; ++k) sum += 0.1 * std::pow(static_cast<double>(0.9f), k);
    worst.addAbsolute(centerOf(bench, stage, depth), sum);
  }
  worst.addNaive(std::abs(1 - worst.expected()));  // the whole series, its tail taken for granted
  result.measure("whitted", "light between two mirrors, by depth 0 ... 12", worst, 1e-5, "absolute");
}

// The camera is in the middle of a slab and looks at its face: beyond the critical angle it sees no sky.
void windowFromInside(const Bench& bench, CaseResult& result) {
  constexpr std::uint32_t kSize = 128;
  for (const float index : {1.5f, 1.33f}) {
    Stage stage;
    const int body = stage.add(glass(index));
    stage.addShape(ShapeKind::box, {40, 40, 2, 0}, {0, 0, 0}, body);
    stage.scene.atmosphere.background = glm::vec3(1);
    stage.scene.cameras[0].yFov = 2 * std::atan(1.2);
    RenderSettings s = settingsFor(Method::whitted, kSize, kSize);
    s.maxDepth = 1;
    const Shot shot = bench.draw(stage.scene, s);
    const double critical = std::tan(std::asin(1 / static_cast<double>(index)));
    std::uint64_t wrong = 0, naive = 0, compared = 0;
    for (std::uint32_t y = 0; y < kSize; ++y) {
      for (std::uint32_t x = 0; x < kSize; ++x) {
        const glm::dvec3 d = rayThrough(stage.scene.cameras[0], x + 0.5, y + 0.5, kSize, kSize);
        const double slope = std::hypot(d.x, d.y), pixel = 2.4 / kSize;
        if (std::abs(slope - critical) < 0.5 * pixel) continue;
        ++compared;
        wrong += (pixelAt(shot.image, x, y)[0] > 0) != (slope < critical);
        const double sine = slope / std::sqrt(1 + slope * slope) / index;  // the ratio of indices the wrong way round
        naive += (sine < 1) != (slope < critical);
      }
    }
    result.count("whitted", fmt::format("pixels on the wrong side of Snell's window, index {:g}", index), wrong,
                 compared, static_cast<double>(naive));
    result.show(fmt::format("Snell's window from within index {:g}", index), shot.image);
  }
}

}  // namespace

std::vector<HardCase> glassCases() {
  return {
      {"T19", "a slab of glass",
       "each inner reflection brings a little more light: which are counted is a matter of depth",
       "partial sums of the geometric series, a dozen roundings", true, slabSeries},
      {"T20", "glass in water", "each body taken by itself reflects as in air: ten times too much between the two",
       "four boundaries of the indices on either side, a dozen roundings", true, nestedGlasses},
      {"T21", "seen from within glass", "a camera that is taken to be in air bends every ray the wrong way",
       "critical angle, half a pixel", true, windowFromInside},
      {"T23", "a hall of mirrors", "what depth cuts off is a tenth of what is left, not nothing",
       "partial sums of 0.9^k, three roundings each", true, mirrorHall},
  };
}

}  // namespace crosslight::study

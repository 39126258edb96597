// Cases of the shaders' elementary functions: powers of cosines, unit vectors, thin fog, the display's curve.
#include <array>

#include "image/image_io.h"
#include "study/cases.h"
#include "study/probe.h"
#include "study/random_numbers.h"

namespace crosslight::study {
namespace {

struct Pair {
  glm::vec3 a, b;
};

// Two directions whose cosine to the n-th is above e^-14.
Pair pairWithinLobe(Random& random, double n) {
  const glm::dvec3 a = random.direction();
  const glm::dvec3 across = glm::normalize(glm::cross(a, random.direction()));
  const double angle = std::min(std::sqrt(2 * random.between(0, 14) / n), 1.5);
  return {glm::vec3(a), glm::vec3(std::cos(angle) * a + std::sin(angle) * across)};
}

Real lobeOf(const Pair& p, double n) {
  const Vec a = glm::normalize(Vec(p.a)), b = glm::normalize(Vec(p.b)), d = a - b;
  return std::exp(static_cast<Real>(n) * std::log1p(-glm::dot(d, d) / 2));
}

void sharpHighlights(const Bench& bench, CaseResult& result) {
  const std::size_t pairs = bench.full ? 200000 : 20000;
  for (const double n : {1.0, 10.0, 1e2, 1e3, 1e4, 1e5}) {
    Random random(5);
    std::vector<Pair> directions;
    std::vector<ProbeArguments> arguments;
    for (std::size_t i = 0; i < pairs; ++i) {
      directions.push_back(pairWithinLobe(random, n));
      arguments.push_back({{directions[i].a, static_cast<float>(n)}, {directions[i].b, 0}, {}, {}});
    }
    const auto answers = askFunction(bench.device, Function::powerOfCosine, arguments);
    Worst worst;
    for (std::size_t i = 0; i < pairs; ++i) {
      const Real expected = lobeOf(directions[i], n);
      worst.addAbsolute(answers[i].a.x, static_cast<double>(expected));
      const float cosine = std::max(glm::dot(directions[i].a, directions[i].b), 0.0f);
      worst.addNaive(static_cast<double>(std::abs(std::pow(cosine, static_cast<float>(n)) - expected)));
    }
    result.measure("kernel", "highlight of shininess " + std::to_string(static_cast<int>(n)), worst, 1e-6, "absolute");
  }
}

void directionsOfAnyLength(const Bench& bench, CaseResult& result) {
  Random random(8);
  std::vector<ProbeArguments> arguments;
  for (int k = -30; k <= 30; ++k) {
    for (int i = 0; i < 100; ++i)
      arguments.push_back({{glm::vec3(random.direction() * std::pow(10.0, k)), 0}, {}, {}, {}});
  }
  const auto answers = askFunction(bench.device, Function::unitVector, arguments);
  Worst length, distance;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const glm::vec3 v(arguments[i].a);
    length.addAbsolute(static_cast<double>(glm::length(Vec(glm::vec3(answers[i].a)))), 1.0);
    const float naive = 1.0f / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    length.addNaive(std::abs(static_cast<double>(glm::length(glm::dvec3(v * naive))) - 1.0));
    distance.addRelative(answers[i].a.w, static_cast<double>(glm::length(Vec(v))));
    const double plain = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    distance.addNaive(std::abs(plain / static_cast<double>(glm::length(Vec(v))) - 1.0));
  }
  // Quotient and product 1 each, dot product 3, halved by the root, inversesqrt 2 ulp = 4 u: 8 u.
  result.measure("kernel", "length of unit vectors to lights at 1e-30 ... 1e30", length, 8 * kU, "absolute");
  // Root 2.5 ulp more than exact at most (Vulkan inherits it from inversesqrt).
  result.measure("kernel", "distance of these lights", distance, 12 * kU, "relative");
}

void thinFog(const Bench& bench, CaseResult& result) {
  Random random(17);
  std::vector<ProbeArguments> arguments;
  for (int i = 0; i < 40000; ++i) {
    const double depth = std::pow(10.0, random.between(-12, std::log10(80.0)));
    arguments.push_back({{static_cast<float>(depth), 0, 0, 0}, {}, {}, {}});
  }
  const auto answers = askFunction(bench.device, Function::fogged, arguments);
  Worst worst;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const float depth = arguments[i].a.x;
    const double expected = static_cast<double>(-std::expm1(-static_cast<Real>(depth)));
    worst.addRelative(answers[i].a.x, expected);
    worst.addNaive(std::abs((1.0f - std::exp(-depth)) / expected - 1.0));
  }
  result.measure("kernel", "share of light that fog of depth 1e-12 ... 80 takes", worst, 2e-6, "relative");
}

Real srgbOf(Real linear) {
  return linear <= 0.0031308L ? 12.92L * linear : 1.055L * std::pow(linear, 1 / 2.4L) - 0.055L;
}

void displayCurve(const Bench& bench, CaseResult& result) {
  Worst worst;
  const int values = bench.full ? 1 << 22 : 1 << 16;
  for (int i = 0; i <= values; ++i) {
    const float linear = static_cast<float>(std::pow(static_cast<double>(i) / values, 4));
    const double exact = static_cast<double>(255 * srgbOf(linear));
    worst.addAbsolute(srgbCodeFromLinear(linear), exact);
    // The power law alone, without the straight piece near black.
    worst.addNaive(std::abs(std::floor(255 * std::pow(linear, 1 / 2.2f) + 0.5f) - exact));
  }
  // Half a code for rounding; the table's boundaries are floats.
  result.measure("host", "8-bit codes of linear values", worst, 0.5 + 255 * 2.1e-7, "codes");
  std::uint64_t wrong = 0;
  for (int code = 0; code < 256; ++code) {
    wrong += srgbCodeFromLinear(linearFromSrgb(static_cast<float>(code) / 255.0f)) != code;
  }
  result.count("host", "codes that do not come back from linear", wrong, 256);
}

// The first 2^(2 k) of a sequence: one in each cell of a grid of 2^k x 2^k, and none at 1.
void randomNumbers(const Bench& bench, CaseResult& result) {
  constexpr int kSide = 32;
  std::vector<ProbeArguments> arguments;
  const int sequences = bench.full ? 1000 : 100;
  for (int scramble = 0; scramble < sequences; ++scramble) {
    for (int i = 0; i < kSide * kSide; ++i)
      arguments.push_back({{static_cast<float>(i), static_cast<float>(scramble * 16411), 0, 0}, {}, {}, {}});
  }
  const auto answers = askFunction(bench.device, Function::samplePlace, arguments);
  std::uint64_t beyond = 0, naive = 0;
  std::vector<int> cells(arguments.size());
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const glm::vec4& p = answers[i].a;
    const bool within = p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1;
    beyond += !within;
    if (within)
      ++cells[i / (kSide * kSide) * kSide * kSide + static_cast<std::size_t>(p.y * kSide) * kSide +
              static_cast<std::size_t>(p.x * kSide)];
  }
  for (std::uint32_t code = 0xffffff00u; code != 0; ++code) naive += static_cast<float>(code) * 0x1p-32f >= 1.0f;
  std::uint64_t uneven = 0;
  for (const int count : cells) uneven += count != 1;
  result.count("kernel", "numbers that are not in [0, 1)", beyond, answers.size(), static_cast<double>(naive));
  result.count("kernel", "cells of 32 x 32 without just one of 1024 samples", uneven, cells.size());
}

}  // namespace

std::vector<HardCase> mathCases() {
  return {
      {"I5", "sharp highlights",
       "pow(cosine, n) turns the cosine's last bit into n of them: at shininess 1e5 a highlight is off by a hundredth",
       "exp(n log(1 - |a - b|^2 / 2)) keeps n h e^(-n h) <= 1/e of the input's error: 1e-6 absolute for every n", true,
       sharpHighlights},
      {"I8", "lights very far and very near",
       "squares of distances overflow beyond 1e19 and vanish below 1e-22, so that normalize() gives 0 or infinity",
       "roundings of the scaled form on 2 ulp of inversesqrt, Vulkan's bound", true, directionsOfAnyLength},
      {"R17", "thin fog", "1 - exp(-x) keeps no digit of x below 1e-7: haze over short distances disappears",
       "series to x^7 below 0.25, above it 3 + 2 |x| ulp of exp() by Vulkan", true, thinFog},
      {"G7", "random numbers near 1",
       "32 random bits times 2^-32 round to 1 in 128 of 2^32 cases: an index beyond its list, or log(0)",
       "24 bits are exact; a (0,2)-sequence has one sample in each cell", true, randomNumbers},
      {"R16", "display curve near black",
       "a power law alone is infinitely steep at black; codes must come back from their own linear value",
       "half a code, and 2.1e-7 of the pow() that IEC 61966-2-1 is tabulated with", true, displayCurve},
  };
}

}  // namespace crosslight::study

#include "study/precision.h"

#include <cmath>
#include <functional>

#include "study/cases.h"
#include "study/probe.h"
#include "study/random_numbers.h"

namespace crosslight::study {
namespace {

Real ulpOf(Real value) { return std::ldexp(1.0L, std::max(std::ilogb(std::abs(value)), -126) - 23); }

// Of a function: what it is exactly, and the absolute error that Vulkan permits there.
struct Function1 {
  Operation operation;
  const char* name;
  const char* guarantee;
  std::function<float(Random&)> x, y;
  std::function<Real(Real x, Real y)> exact;
  std::function<Real(Real x, Real y, Real exact)> permitted;
};

std::function<float(Random&)> uniform(double low, double high) {
  return [=](Random& r) { return static_cast<float>(r.between(low, high)); };
}
std::function<float(Random&)> logarithmic(double low, double high) {
  return [=](Random& r) { return static_cast<float>(std::exp2(r.between(low, high))); };
}

auto ulps(Real count) {
  return [count](Real, Real, Real exact) { return count * ulpOf(exact); };
}
Real permittedExp(Real x, Real, Real exact) { return (3 + 2 * std::abs(x)) * ulpOf(exact); }
Real permittedLog(Real x, Real, Real exact) { return x >= 0.5L && x <= 2 ? 0x1p-21L : 3 * ulpOf(exact); }
// As exp2(y log2(x)): the logarithm's error times y, in the exponent, then exp2's own.
Real permittedPow(Real x, Real y, Real exact) {
  const Real log = std::log2(x), product = y * log;
  const Real inExponent = std::abs(y) * permittedLog(x, 0, log) + ulpOf(product) / 2;
  return exact * std::expm1(inExponent * std::log(2.0L)) + (3 + 2 * std::abs(product)) * ulpOf(exact);
}
Real permittedSine(Real, Real, Real) { return 0x1p-11L; }
Real permittedTangent(Real x, Real, Real exact) {
  const Real c = std::abs(std::cos(x)), s = std::abs(std::sin(x));
  return c <= 0x1p-11L ? INFINITY : (s + 0x1p-11L) / (c - 0x1p-11L) - s / c + 2.5L * ulpOf(exact);
}
// As atan(x, sqrt(1 - x^2)), or the other way round: atan's 4096 ulp, and what the root's own error turns it by.
Real permittedArc(Real x, Real, Real exact) {
  const Real s = std::sqrt(1 - x * x);
  return 4096 * ulpOf(exact) + std::abs(x) * (static_cast<Real>(kU) / s + 9 * static_cast<Real>(kU) * s);
}

std::vector<Function1> functions() {
  using enum Operation;
  const auto none = uniform(0, 0);
  const auto one = [](auto f) { return [f](Real x, Real) { return f(x); }; };
  return {
      {division, "x / y", "2.5 ulp", uniform(-100, 100), logarithmic(-60, 60), [](Real x, Real y) { return x / y; },
       ulps(2.5L)},
      {inverseSquareRoot, "inversesqrt(x)", "2 ulp", logarithmic(-100, 100), none,
       [](Real x, Real) { return 1 / std::sqrt(x); }, ulps(2)},
      // 1 / inversesqrt: 2 and 2.5 ulp, of values whose ulp may be half as large.
      {squareRoot, "sqrt(x)", "as 1 / inversesqrt(x)", logarithmic(-100, 100), none,
       one([](Real x) { return std::sqrt(x); }), ulps(6.5L)},
      {exponential, "exp(x)", "3 + 2 |x| ulp", uniform(-86, 86), none, one([](Real x) { return std::exp(x); }),
       permittedExp},
      {exponential2, "exp2(x)", "3 + 2 |x| ulp", uniform(-125, 125), none, one([](Real x) { return std::exp2(x); }),
       permittedExp},
      {logarithm, "log(x)", "3 ulp, 2^-21 absolute in [0.5, 2]", logarithmic(-8, 8), none,
       one([](Real x) { return std::log(x); }), permittedLog},
      {logarithm2, "log2(x)", "3 ulp, 2^-21 absolute in [0.5, 2]", logarithmic(-8, 8), none,
       one([](Real x) { return std::log2(x); }), permittedLog},
      {power, "pow(x, y)", "as exp2(y log2(x))", uniform(0.5, 1), logarithmic(-2, 10),
       [](Real x, Real y) { return std::pow(x, y); }, permittedPow},
      {sine, "sin(x)", "2^-11 absolute in [-pi, pi]", uniform(-3.14159, 3.14159), none,
       one([](Real x) { return std::sin(x); }), permittedSine},
      {cosine, "cos(x)", "2^-11 absolute in [-pi, pi]", uniform(-3.14159, 3.14159), none,
       one([](Real x) { return std::cos(x); }), permittedSine},
      {tangent, "tan(x)", "as sin(x) / cos(x)", uniform(-3.14159, 3.14159), none,
       one([](Real x) { return std::tan(x); }), permittedTangent},
      {arcSine, "asin(x)", "as atan(x, sqrt(1 - x^2))", uniform(-1, 1), none, one([](Real x) { return std::asin(x); }),
       permittedArc},
      {arcCosine, "acos(x)", "as atan(sqrt(1 - x^2), x)", uniform(-1, 1), none,
       one([](Real x) { return std::acos(x); }), permittedArc},
      {arcTangent, "atan(x)", "4096 ulp", uniform(-20, 20), none, one([](Real x) { return std::atan(x); }), ulps(4096)},
  };
}

FunctionPrecision measure(const gpu::Device& device, const Function1& f) {
  constexpr std::size_t kSamples = 1u << 16;
  Random random(static_cast<std::uint64_t>(f.operation));
  std::vector<glm::vec3> arguments;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const float x = f.x(random), y = f.y(random);
    arguments.emplace_back(x, y, 0);
  }
  const std::vector<float> answers = askOperation(device, f.operation, arguments);
  FunctionPrecision p{f.name, f.guarantee};
  for (std::size_t i = 0; i < kSamples; ++i) {
    const Real x = arguments[i].x, y = arguments[i].y, exact = f.exact(x, y);
    if (std::abs(exact) < 0x1p-126L) continue;  // denormal results may be zero
    const Real error = std::isnan(answers[i]) ? INFINITY : std::abs(answers[i] - exact);
    const auto share = static_cast<double>(error / f.permitted(x, y, exact));
    p.worstUlp = std::max(p.worstUlp, static_cast<double>(error / ulpOf(exact)));
    p.worstAbsolute = std::max(p.worstAbsolute, static_cast<double>(error));
    ++p.samples;
    if (share <= p.worstShare) continue;
    p.worstShare = share;
    p.x = arguments[i].x;
    p.y = arguments[i].y;
  }
  return p;
}

}  // namespace

std::vector<FunctionPrecision> measurePrecision(const gpu::Device& device) {
  std::vector<FunctionPrecision> all;
  for (const Function1& f : functions()) all.push_back(measure(device, f));
  return all;
}

}  // namespace crosslight::study

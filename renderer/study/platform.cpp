#include "study/platform.h"

#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>

#include "study/precision.h"
#include "study/probe.h"

namespace crosslight::study {
namespace {

const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInf = std::numeric_limits<float>::infinity();

class Asker {
 public:
  explicit Asker(const gpu::Device& device) : device_(device) {}
  float operator()(Operation operation, float x, float y = 0, float z = 0) const {
    return askOperation(device_, operation, {{x, y, z}})[0];
  }

 private:
  const gpu::Device& device_;
};

std::string textOf(float value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", static_cast<double>(value));
  return text;
}

std::string yes(bool value) { return value ? "yes" : "no"; }

// (1 + u) (1 - u) - 1 is -u^2 exactly; rounded twice it is 0.
bool isFused(const Asker& ask, Operation operation) {
  const float u = 0x1p-23f;
  return ask(operation, 1 + u, 1 - u, -1) != 0.0f;
}

// Of 1 + u + u: which sum was formed first.
std::string dotOrder(const Asker& ask) {
  const float u = 0x1p-24f;
  const float first = ask(Operation::dotProduct, 1, u, u), last = ask(Operation::dotProduct, u, u, 1);
  const bool leftToRight = first == 1.0f && last > 1.0f, rightToLeft = first > 1.0f && last == 1.0f;
  return leftToRight ? "(xx + yy) + zz" : rightToLeft ? "xx + (yy + zz)" : "another, or more than single precision";
}

void addSpecialValues(const Asker& ask, std::vector<PlatformFact>& facts) {
  using enum Operation;
  facts.push_back({"powerOfZeroToZero", "pow(0, 0)", textOf(ask(power, 0, 0))});
  facts.push_back({"powerOfZeroToMinusOne", "pow(0, -1)", textOf(ask(power, 0, -1))});
  facts.push_back({"powerOfNegative", "pow(-1, 2)", textOf(ask(power, -1, 2))});
  facts.push_back({"minOfNan", "min(NaN, 1), min(1, NaN)",
                   textOf(ask(smallerOf, kNan, 1)) + ", " + textOf(ask(smallerOf, 1, kNan))});
  facts.push_back({"maxOfNan", "max(NaN, 1), max(1, NaN)",
                   textOf(ask(greaterOf, kNan, 1)) + ", " + textOf(ask(greaterOf, 1, kNan))});
  facts.push_back({"clampOfNan", "clamp(NaN, 0, 1)", textOf(ask(clamped, kNan))});
  facts.push_back({"oneByZero", "1 / 0 and 0 / 0", textOf(ask(division, 1, 0)) + ", " + textOf(ask(division, 0, 0))});
  facts.push_back({"zeroTimesInfinity", "0 * infinity", textOf(ask(product, 0, kInf))});
  facts.push_back(
      {"rootOfNegative", "sqrt(-1), sqrt(-0)", textOf(ask(squareRoot, -1)) + ", " + textOf(ask(squareRoot, -0.0f))});
  facts.push_back({"arcTangentOfNothing", "atan(0, 0)", textOf(ask(arcTangent2, 0, 0))});
  facts.push_back(
      {"arcCosineBeyondOne", "acos of the float after 1", textOf(ask(arcCosine, std::nextafter(1.0f, 2.0f)))});
  facts.push_back({"lengthOfLarge", "length(1e20, 0, 0)", textOf(ask(lengthOf, 1e20f))});
}

}  // namespace

Platform probePlatform(const gpu::Device& device) {
  using enum Operation;
  const Asker ask(device);
  Platform platform;
  platform.facts = {
      {"fusedMultiplyAdd", "does fma() round once", yes(isFused(ask, fused))},
      {"contraction", "is x * y + z fused, in the renderer's shaders (which forbid it)",
       yes(isFused(ask, productAndSum))},
      {"reassociation", "is (x + y) - x taken for y, in the renderer's shaders (which forbid it)",
       yes(ask(sumAndDifference, 1e20f, 1) != 0.0f)},
      {"dotOrder", "order of dot()'s sum", dotOrder(ask)},
      {"denormalResults", "are denormal results kept", yes(ask(product, 0x1p-100f, 0x1p-30f) != 0.0f)},
      {"denormalOperands", "are denormal operands kept", yes(ask(product, 0x1p-130f, 0x1p30f) != 0.0f)},
  };
  addSpecialValues(ask, platform.facts);
  platform.functions = measurePrecision(device);
  return platform;
}

}  // namespace crosslight::study

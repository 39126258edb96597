// What the device makes of the shading language's arithmetic where standards leave it the choice, and how precise its
// functions are against what Vulkan demands.
#pragma once

#include <string>
#include <vector>

#include "gpu/device.h"

namespace crosslight::study {

struct PlatformFact {
  std::string name;  // "fusedMultiplyAdd"
  std::string question;
  std::string answer;
};

// Of one function over its range, the worst sample by share of the permitted error.
struct FunctionPrecision {
  std::string name;       // "pow(x, y)"
  std::string guarantee;  // of Vulkan 1.3, "Precision and Operation of SPIR-V Instructions", in words
  double worstUlp = 0;    // units in the last place of the exact value
  double worstAbsolute = 0;
  double worstShare = 0;  // of what is permitted; at most 1
  float x = 0, y = 0;     // where the share is worst
  std::uint64_t samples = 0;

  bool holds() const { return worstShare <= 1; }
};

struct Platform {
  std::vector<PlatformFact> facts;
  std::vector<FunctionPrecision> functions;
};

Platform probePlatform(const gpu::Device& device);

}  // namespace crosslight::study

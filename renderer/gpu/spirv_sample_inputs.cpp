#include "gpu/spirv_sample_inputs.h"

#include <set>

namespace crosslight::gpu {
namespace {

// SPIR-V 1.6, 3.3 to 3.7 and 3.20: operations, decorations, storage classes, capabilities.
constexpr std::uint32_t kOpCapability = 17, kOpDecorate = 71, kOpVariable = 59;
constexpr std::uint32_t kFlat = 14, kBuiltIn = 11, kSample = 17, kLocation = 30;
constexpr std::uint32_t kInput = 1, kSampleRateShading = 35;
constexpr std::size_t kHeaderWords = 5;

struct Inputs {
  std::set<std::uint32_t> located, fixed, variables;

  bool interpolated(std::uint32_t id) const { return located.contains(id) && !fixed.contains(id); }
};

Inputs inputsOf(std::span<const std::uint32_t> module) {
  Inputs inputs;
  for (std::size_t at = kHeaderWords; at < module.size(); at += module[at] >> 16) {
    const std::uint32_t opcode = module[at] & 0xffffu;
    if (opcode == kOpDecorate && module[at + 2] == kLocation) inputs.located.insert(module[at + 1]);
    if (opcode == kOpDecorate && (module[at + 2] == kFlat || module[at + 2] == kBuiltIn || module[at + 2] == kSample))
      inputs.fixed.insert(module[at + 1]);
    if (opcode == kOpVariable && module[at + 3] == kInput) inputs.variables.insert(module[at + 2]);
  }
  return inputs;
}

}  // namespace

std::vector<std::uint32_t> withSampleInputs(std::span<const std::uint32_t> module) {
  const Inputs inputs = inputsOf(module);
  std::vector<std::uint32_t> result(module.begin(), module.begin() + kHeaderWords);
  bool capable = false, decorated = false;
  for (std::size_t at = kHeaderWords; at < module.size(); at += module[at] >> 16) {
    const std::uint32_t opcode = module[at] & 0xffffu;
    if (opcode == kOpCapability && !capable) {
      result.insert(result.end(), {2u << 16 | kOpCapability, kSampleRateShading});
      capable = true;
    }
    if (opcode == kOpDecorate && !decorated) {
      for (const std::uint32_t id : inputs.variables) {
        if (inputs.interpolated(id)) result.insert(result.end(), {3u << 16 | kOpDecorate, id, kSample});
      }
      decorated = true;
    }
    const auto first = module.begin() + static_cast<std::ptrdiff_t>(at);
    result.insert(result.end(), first, first + (module[at] >> 16));
  }
  return result;
}

}  // namespace crosslight::gpu

// Which blocks of a SPIR-V function can run. Private to this room.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "gpu/spirv_values.h"

namespace crosslight::gpu {

// Instructions from a label to the instruction that ends the block.
struct SpirvBlock {
  std::uint32_t label = 0;
  std::vector<SpirvInstruction> body;  // the label first
  const SpirvInstruction& end() const { return body.back(); }
};

class SpirvFunction {
 public:
  // `code`: from OpFunction to OpFunctionEnd.
  explicit SpirvFunction(std::span<const SpirvInstruction> code);
  // Finds what is known and what runs.
  void solve(SpirvValues& values);
  std::vector<std::uint32_t> callees() const;  // of what runs
  // Appends what runs to `words`. To `dead` go the instructions that are left out.
  void write(const SpirvValues& values, std::vector<std::uint32_t>& words, std::vector<SpirvInstruction>& dead) const;

 private:
  std::vector<std::uint32_t> successors(const SpirvBlock& block, const SpirvValues& values) const;
  bool takes(std::uint32_t from, std::uint32_t to, const SpirvValues& values) const;
  void evaluate(SpirvValues& values) const;
  std::vector<bool> findRunning(const SpirvValues& values) const;
  // Labels that merge instructions of running blocks name; of a loop's continue target also the loop's header.
  using NamedLabels = std::map<std::uint32_t, std::uint32_t>;
  NamedLabels namedLabels(const SpirvValues& values) const;
  void writeBlock(const SpirvBlock& block, const SpirvValues& values, const NamedLabels& named,
                  std::vector<std::uint32_t>& words) const;
  void writePhi(const SpirvInstruction& phi, std::uint32_t label, const SpirvValues& values, const NamedLabels& named,
                std::vector<std::uint32_t>& words) const;

  std::vector<SpirvInstruction> head_;  // OpFunction and its parameters
  std::vector<SpirvBlock> blocks_;
  SpirvInstruction end_;
  std::map<std::uint32_t, std::size_t> blockOf_;  // by label
  std::vector<bool> runs_;                        // by block
};

}  // namespace crosslight::gpu

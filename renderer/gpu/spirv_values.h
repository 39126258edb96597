// What a SPIR-V module says of integers and truth values once its specialization constants are given. Private to this
// room.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gpu/pipeline.h"

namespace crosslight::gpu {

// SPIR-V 1.6, 3.49 "Instructions"; the ones that this room must know.
enum class SpirvOp : std::uint32_t {
  source = 3,
  sourceExtension = 4,
  name = 5,
  memberName = 6,
  string = 7,
  line = 8,
  entryPoint = 15,
  executionMode = 16,
  capability = 17,
  typeBool = 20,
  typeInt = 21,
  typePointer = 32,
  typeForwardPointer = 39,
  constantTrue = 41,
  constantFalse = 42,
  constant = 43,
  constantComposite = 44,
  specConstantTrue = 48,
  specConstantFalse = 49,
  specConstant = 50,
  specConstantComposite = 51,
  specConstantOp = 52,
  function = 54,
  functionEnd = 56,
  functionCall = 57,
  decorate = 71,
  memberDecorate = 72,
  decorationGroup = 73,
  copyObject = 83,
  iAdd = 128,
  iSub = 130,
  iMul = 132,
  uDiv = 134,
  uMod = 137,
  logicalEqual = 164,
  logicalNotEqual = 165,
  logicalOr = 166,
  logicalAnd = 167,
  logicalNot = 168,
  select = 169,
  iEqual = 170,
  iNotEqual = 171,
  uGreaterThan = 172,
  sGreaterThan = 173,
  uGreaterThanEqual = 174,
  sGreaterThanEqual = 175,
  uLessThan = 176,
  sLessThan = 177,
  uLessThanEqual = 178,
  sLessThanEqual = 179,
  shiftRightLogical = 194,
  shiftLeftLogical = 196,
  bitwiseOr = 197,
  bitwiseXor = 198,
  bitwiseAnd = 199,
  bitNot = 200,
  phi = 245,
  loopMerge = 246,
  selectionMerge = 247,
  label = 248,
  branch = 249,
  branchConditional = 250,
  switchOver = 251,
  unreachable = 255,
  noLine = 317,
  moduleProcessed = 330,
  decorateId = 332,
  typeRayQuery = 4472,
  typeAccelerationStructure = 5341
};

// Words of one instruction, the first with opcode and length.
struct SpirvInstruction {
  std::span<const std::uint32_t> words;
  SpirvOp op() const { return static_cast<SpirvOp>(words[0] & 0xffffu); }
};

// Values of ids of 32 bits; truth values are 0 and 1.
class SpirvValues {
 public:
  explicit SpirvValues(std::uint32_t idBound) : known_(idBound), bits_(idBound) {}
  std::optional<std::uint32_t> of(std::uint32_t id) const;
  void set(std::uint32_t id, std::uint32_t bits);
  // Of an operation on integers or truth values; nothing where it cannot be told.
  std::optional<std::uint32_t> result(SpirvOp op, std::span<const std::uint32_t> operands) const;

 private:
  std::optional<std::uint32_t> ofOne(SpirvOp op, std::span<const std::uint32_t> operands) const;
  std::vector<bool> known_;
  std::vector<std::uint32_t> bits_;
};

}  // namespace crosslight::gpu

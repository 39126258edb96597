#include "gpu/spirv_values.h"

namespace crosslight::gpu {
namespace {

using Bits = std::optional<std::uint32_t>;

std::uint32_t ofTruth(bool truth) { return truth ? 1u : 0u; }

Bits ofTwo(SpirvOp op, std::uint32_t a, std::uint32_t b) {
  const auto signedA = static_cast<std::int32_t>(a), signedB = static_cast<std::int32_t>(b);
  switch (op) {
    case SpirvOp::iAdd:
      return a + b;
    case SpirvOp::iSub:
      return a - b;
    case SpirvOp::iMul:
      return a * b;
    case SpirvOp::uDiv:
      return b != 0 ? Bits(a / b) : std::nullopt;
    case SpirvOp::uMod:
      return b != 0 ? Bits(a % b) : std::nullopt;
    case SpirvOp::shiftRightLogical:
      return b < 32 ? Bits(a >> b) : std::nullopt;
    case SpirvOp::shiftLeftLogical:
      return b < 32 ? Bits(a << b) : std::nullopt;
    case SpirvOp::bitwiseOr:
    case SpirvOp::logicalOr:
      return a | b;
    case SpirvOp::bitwiseAnd:
    case SpirvOp::logicalAnd:
      return a & b;
    case SpirvOp::bitwiseXor:
      return a ^ b;
    case SpirvOp::logicalEqual:
    case SpirvOp::iEqual:
      return ofTruth(a == b);
    case SpirvOp::logicalNotEqual:
    case SpirvOp::iNotEqual:
      return ofTruth(a != b);
    case SpirvOp::uGreaterThan:
      return ofTruth(a > b);
    case SpirvOp::uGreaterThanEqual:
      return ofTruth(a >= b);
    case SpirvOp::uLessThan:
      return ofTruth(a < b);
    case SpirvOp::uLessThanEqual:
      return ofTruth(a <= b);
    case SpirvOp::sGreaterThan:
      return ofTruth(signedA > signedB);
    case SpirvOp::sGreaterThanEqual:
      return ofTruth(signedA >= signedB);
    case SpirvOp::sLessThan:
      return ofTruth(signedA < signedB);
    case SpirvOp::sLessThanEqual:
      return ofTruth(signedA <= signedB);
    default:
      return std::nullopt;
  }
}

}  // namespace

Bits SpirvValues::of(std::uint32_t id) const { return known_.at(id) ? Bits(bits_[id]) : std::nullopt; }

void SpirvValues::set(std::uint32_t id, std::uint32_t bits) {
  known_.at(id) = true;
  bits_[id] = bits;
}

// What one known operand decides by itself.
Bits SpirvValues::ofOne(SpirvOp op, std::span<const std::uint32_t> operands) const {
  if (op == SpirvOp::copyObject) return of(operands[0]);
  if (op == SpirvOp::logicalNot) return of(operands[0]) ? Bits(1u - *of(operands[0])) : std::nullopt;
  if (op == SpirvOp::bitNot) return of(operands[0]) ? Bits(~*of(operands[0])) : std::nullopt;
  if (op == SpirvOp::select && operands.size() == 3) {
    const Bits condition = of(operands[0]);
    return condition ? of(operands[*condition != 0 ? 1 : 2]) : std::nullopt;
  }
  const bool ands = op == SpirvOp::logicalAnd || op == SpirvOp::bitwiseAnd;
  if (!ands && op != SpirvOp::logicalOr) return std::nullopt;
  const std::uint32_t decides = ands ? 0u : 1u;
  for (const std::uint32_t id : operands) {
    if (of(id) == decides) return decides;
  }
  return std::nullopt;
}

Bits SpirvValues::result(SpirvOp op, std::span<const std::uint32_t> operands) const {
  // Of these alone all operands are ids. Arithmetic of floats is left to the driver.
  const bool ofIds = (op >= SpirvOp::iAdd && op <= SpirvOp::bitNot) || op == SpirvOp::copyObject;
  if (!ofIds || operands.empty()) return std::nullopt;
  if (const Bits decided = ofOne(op, operands)) return decided;
  if (operands.size() != 2) return std::nullopt;
  const Bits a = of(operands[0]), b = of(operands[1]);
  return a && b ? ofTwo(op, *a, *b) : std::nullopt;
}

}  // namespace crosslight::gpu

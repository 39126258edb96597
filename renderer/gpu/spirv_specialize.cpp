// lavapipe translates all of a module for each pipeline before it notices what a constant rules out: 135 ms for the
// shading kernel of a scene that needs an eighth of it (Mesa 22.3.6, 2026-11-23). What is ruled out is found here by
// whole branches and functions, in a millisecond; everything finer is left to the driver.
#include "gpu/spirv_specialize.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/check.h"
#include "gpu/spirv_function.h"

namespace crosslight::gpu {
namespace {

constexpr std::size_t kHeaderWords = 5;
constexpr std::size_t kBoundWord = 3;  // of the header: ids are below it
constexpr std::uint32_t kDecorationSpecId = 1;
// Capabilities Int64, Int16, Int8.
constexpr std::uint32_t kOtherIntegers[] = {11, 22, 39};

std::vector<SpirvInstruction> instructionsOf(std::span<const std::uint32_t> module) {
  std::vector<SpirvInstruction> list;
  for (std::size_t at = kHeaderWords; at < module.size();) {
    const std::size_t length = module[at] >> 16;
    CL_CHECK(length > 0 && at + length <= module.size());
    list.push_back({module.subspan(at, length)});
    at += length;
  }
  return list;
}

bool isOdd(const SpirvInstruction& i) {
  if (i.op() == SpirvOp::decorationGroup) return true;
  return i.op() == SpirvOp::capability &&
         std::find(std::begin(kOtherIntegers), std::end(kOtherIntegers), i.words[1]) != std::end(kOtherIntegers);
}

bool isForReaders(SpirvOp op) {
  return (op >= SpirvOp::source && op <= SpirvOp::memberName) || op == SpirvOp::string || op == SpirvOp::line ||
         op == SpirvOp::noLine || op == SpirvOp::moduleProcessed;
}

class Specializer {
 public:
  Specializer(std::span<const std::uint32_t> module, const std::vector<SpirvInstruction>& code,
              const Constants& constants)
      : module_(module), code_(code), values_(module[kBoundWord]), isType_(module[kBoundWord]) {
    for (const Constant& c : constants) given_[c.id] = c.bits;
  }

  std::vector<std::uint32_t> run() {
    const std::size_t functionsAt = readDeclarations();
    readFunctions(functionsAt);
    std::vector<std::uint32_t> bodies;
    for (auto& [id, function] : functions_) {
      if (called_.contains(id)) continue;
      for (const SpirvInstruction& i : codeOf_.at(id)) markDead(i);
    }
    std::vector<SpirvInstruction> dead;
    for (const std::uint32_t id : order_) {
      if (called_.contains(id)) functions_.at(id).write(values_, bodies, dead);
    }
    for (const SpirvInstruction& i : dead) markDead(i);
    std::vector<std::uint32_t> words(module_.begin(), module_.begin() + kHeaderWords);
    for (std::size_t i = 0; i < functionsAt; ++i) writeDeclaration(code_[i], words);
    words.insert(words.end(), bodies.begin(), bodies.end());
    return words;
  }

 private:
  // Up to the first function. Constants stand behind what they are made of.
  std::size_t readDeclarations() {
    std::size_t at = 0;
    for (; at < code_.size() && code_[at].op() != SpirvOp::function; ++at) {
      const SpirvInstruction& i = code_[at];
      const auto op = static_cast<std::uint32_t>(i.op());
      const bool decorates = i.op() == SpirvOp::decorate && i.words[2] == kDecorationSpecId;
      if (decorates) specIds_[i.words[1]] = i.words[3];
      if (i.op() == SpirvOp::entryPoint) wanted_.push_back(i.words[2]);
      constexpr auto kFirstType = 19u, kLastType = 38u;
      const bool ofRays = i.op() == SpirvOp::typeRayQuery || i.op() == SpirvOp::typeAccelerationStructure;
      if ((op >= kFirstType && op <= kLastType) || ofRays) isType_.at(i.words[1]) = true;
      if (i.op() == SpirvOp::typeBool) truthTypes_.insert(i.words[1]);
      readConstant(i);
    }
    return at;
  }

  std::uint32_t givenOr(std::uint32_t id, std::uint32_t otherwise) const {
    const auto specId = specIds_.find(id);
    if (specId == specIds_.end()) return otherwise;
    const auto given = given_.find(specId->second);
    return given == given_.end() ? otherwise : given->second;
  }

  void readConstant(const SpirvInstruction& i) {
    const std::uint32_t id = i.words.size() > 2 ? i.words[2] : 0;
    switch (i.op()) {
      case SpirvOp::constantTrue:
      case SpirvOp::constantFalse:
        return values_.set(id, i.op() == SpirvOp::constantTrue ? 1u : 0u);
      case SpirvOp::specConstantTrue:
      case SpirvOp::specConstantFalse:
        return values_.set(id, givenOr(id, i.op() == SpirvOp::specConstantTrue ? 1u : 0u) != 0 ? 1u : 0u);
      case SpirvOp::constant:
      case SpirvOp::specConstant:
        if (i.words.size() == 4) values_.set(id, givenOr(id, i.words[3]));
        return;
      case SpirvOp::specConstantOp:
        if (const auto bits = values_.result(static_cast<SpirvOp>(i.words[3]), i.words.subspan(4))) {
          values_.set(id, *bits);
        }
        return;
      default:
        return;
    }
  }

  void readFunctions(std::size_t at) {
    while (at < code_.size()) {
      std::size_t end = at;
      while (code_.at(end).op() != SpirvOp::functionEnd) ++end;
      const std::uint32_t id = code_[at].words[2];
      const auto body = std::span(code_).subspan(at, end + 1 - at);
      order_.push_back(id);
      codeOf_.emplace(id, body);
      functions_.emplace(id, SpirvFunction(body));
      at = end + 1;
    }
    while (!wanted_.empty()) {
      const std::uint32_t id = wanted_.back();
      wanted_.pop_back();
      if (!called_.insert(id).second) continue;
      SpirvFunction& function = functions_.at(id);
      function.solve(values_);
      for (const std::uint32_t callee : function.callees()) wanted_.push_back(callee);
    }
  }

  // What has a result names its type first; nothing else does.
  void markDead(const SpirvInstruction& i) {
    if (i.words.size() > 2 && i.words[1] < isType_.size() && isType_[i.words[1]]) dead_.insert(i.words[2]);
  }

  void writeDeclaration(const SpirvInstruction& i, std::vector<std::uint32_t>& words) const {
    if (isForReaders(i.op())) return;
    const bool decorates = i.op() == SpirvOp::decorate || i.op() == SpirvOp::decorateId;
    if (decorates && dead_.contains(i.words[1])) return;
    if (decorates && i.words[2] == kDecorationSpecId) return;
    const std::size_t start = words.size();
    words.insert(words.end(), i.words.begin(), i.words.end());
    const auto become = [&](SpirvOp op) { words[start] = (words[start] & ~0xffffu) | static_cast<std::uint32_t>(op); };
    if (i.op() < SpirvOp::specConstantTrue || i.op() > SpirvOp::specConstantOp) return;
    const auto bits = values_.of(i.words[2]);
    if (i.op() == SpirvOp::specConstant) {
      become(SpirvOp::constant);
      if (bits) words.back() = *bits;
    } else if (i.op() <= SpirvOp::specConstantFalse) {
      become(*bits != 0 ? SpirvOp::constantTrue : SpirvOp::constantFalse);
    } else if (i.op() == SpirvOp::specConstantOp && bits) {
      words.resize(start);
      writeResult(i, *bits, words);
    }
  }

  void writeResult(const SpirvInstruction& i, std::uint32_t bits, std::vector<std::uint32_t>& words) const {
    const bool truth = truthTypes_.contains(i.words[1]);
    const SpirvOp op = !truth ? SpirvOp::constant : (bits != 0 ? SpirvOp::constantTrue : SpirvOp::constantFalse);
    words.push_back((truth ? 3u : 4u) << 16 | static_cast<std::uint32_t>(op));
    words.insert(words.end(), {i.words[1], i.words[2]});
    if (!truth) words.push_back(bits);
  }

  std::span<const std::uint32_t> module_;
  const std::vector<SpirvInstruction>& code_;
  SpirvValues values_;
  std::vector<bool> isType_;                        // by id
  std::set<std::uint32_t> truthTypes_;              // OpTypeBool
  std::map<std::uint32_t, std::uint32_t> given_;    // by constant id
  std::map<std::uint32_t, std::uint32_t> specIds_;  // constant ids by id
  std::vector<std::uint32_t> wanted_, order_;
  std::map<std::uint32_t, std::span<const SpirvInstruction>> codeOf_;
  std::map<std::uint32_t, SpirvFunction> functions_;
  std::set<std::uint32_t> called_, dead_;
};

}  // namespace

std::vector<std::uint32_t> specialized(std::span<const std::uint32_t> module, const Constants& constants) {
  CL_CHECK(module.size() > kHeaderWords);
  const std::vector<SpirvInstruction> code = instructionsOf(module);
  if (std::any_of(code.begin(), code.end(), isOdd)) return {module.begin(), module.end()};
  return Specializer(module, code, constants).run();
}

}  // namespace crosslight::gpu

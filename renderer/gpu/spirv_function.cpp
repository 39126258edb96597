#include "gpu/spirv_function.h"

#include <algorithm>

namespace crosslight::gpu {
namespace {

// Of a conditional branch whose condition is known, the label that is taken; 0 elsewhere.
std::uint32_t takenLabel(const SpirvInstruction& end, const SpirvValues& values) {
  if (end.op() != SpirvOp::branchConditional) return 0;
  const auto condition = values.of(end.words[1]);
  return condition ? end.words[*condition != 0 ? 2 : 3] : 0;
}

void append(std::vector<std::uint32_t>& words, std::span<const std::uint32_t> more) {
  words.insert(words.end(), more.begin(), more.end());
}

void append(std::vector<std::uint32_t>& words, SpirvOp op, std::initializer_list<std::uint32_t> operands) {
  words.push_back(static_cast<std::uint32_t>(operands.size() + 1) << 16 | static_cast<std::uint32_t>(op));
  append(words, std::span(operands.begin(), operands.size()));
}

}  // namespace

SpirvFunction::SpirvFunction(std::span<const SpirvInstruction> code) : end_(code.back()) {
  for (const SpirvInstruction& instruction : code.first(code.size() - 1)) {
    if (instruction.op() == SpirvOp::label) {
      blockOf_[instruction.words[1]] = blocks_.size();
      blocks_.push_back({instruction.words[1], {}});
    }
    (blocks_.empty() ? head_ : blocks_.back().body).push_back(instruction);
  }
  runs_.assign(blocks_.size(), true);
}

std::vector<std::uint32_t> SpirvFunction::successors(const SpirvBlock& block, const SpirvValues& values) const {
  const SpirvInstruction& end = block.end();
  if (const std::uint32_t taken = takenLabel(end, values)) return {taken};
  if (end.op() == SpirvOp::branch) return {end.words[1]};
  if (end.op() == SpirvOp::branchConditional) return {end.words[2], end.words[3]};
  if (end.op() != SpirvOp::switchOver) return {};
  std::vector<std::uint32_t> labels{end.words[2]};
  for (std::size_t i = 4; i < end.words.size(); i += 2) labels.push_back(end.words[i]);
  return labels;
}

bool SpirvFunction::takes(std::uint32_t from, std::uint32_t to, const SpirvValues& values) const {
  const std::size_t block = blockOf_.at(from);
  const std::vector<std::uint32_t> labels = successors(blocks_[block], values);
  return runs_[block] && std::find(labels.begin(), labels.end(), to) != labels.end();
}

// Blocks stand behind those that dominate them, so that operands are known before their results; but for the values
// that a loop carries back, which count as unknown.
void SpirvFunction::evaluate(SpirvValues& values) const {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (!runs_[b]) continue;
    for (const SpirvInstruction& i : blocks_[b].body) {
      if (i.words.size() < 4) continue;
      if (i.op() != SpirvOp::phi) {
        if (const auto bits = values.result(i.op(), i.words.subspan(3))) values.set(i.words[2], *bits);
        continue;
      }
      std::optional<std::uint32_t> common;
      bool same = true;
      for (std::size_t at = 3; at + 1 < i.words.size(); at += 2) {
        if (!takes(i.words[at + 1], blocks_[b].label, values)) continue;
        const auto bits = values.of(i.words[at]);
        same = same && bits && (!common || common == bits);
        common = bits;
      }
      if (same && common) values.set(i.words[2], *common);
    }
  }
}

std::vector<bool> SpirvFunction::findRunning(const SpirvValues& values) const {
  std::vector<bool> found(blocks_.size());
  std::vector<std::size_t> waiting{0};
  found[0] = true;
  while (!waiting.empty()) {
    const std::size_t block = waiting.back();
    waiting.pop_back();
    for (const std::uint32_t label : successors(blocks_[block], values)) {
      const std::size_t next = blockOf_.at(label);
      if (!found[next]) waiting.push_back(next);
      found[next] = true;
    }
  }
  return found;
}

// From "all runs, little is known" to what follows from it, so that every step is right by itself.
void SpirvFunction::solve(SpirvValues& values) {
  if (blocks_.empty()) return;
  for (bool changes = true; changes;) {
    evaluate(values);
    std::vector<bool> running = findRunning(values);
    changes = running != runs_;
    runs_ = std::move(running);
  }
}

std::vector<std::uint32_t> SpirvFunction::callees() const {
  std::vector<std::uint32_t> ids;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (!runs_[b]) continue;
    for (const SpirvInstruction& i : blocks_[b].body) {
      if (i.op() == SpirvOp::functionCall) ids.push_back(i.words[3]);
    }
  }
  return ids;
}

SpirvFunction::NamedLabels SpirvFunction::namedLabels(const SpirvValues& values) const {
  NamedLabels named;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (!runs_[b]) continue;
    for (const SpirvInstruction& i : blocks_[b].body) {
      const bool loop = i.op() == SpirvOp::loopMerge;
      if (loop || (i.op() == SpirvOp::selectionMerge && takenLabel(blocks_[b].end(), values) == 0)) {
        named[i.words[1]] = 0;
      }
      if (loop) named[i.words[2]] = blocks_[b].label;
    }
  }
  return named;
}

// Values of the edges that are left. A loop's continue target that never runs stays as a block that goes back: what it
// would bring is the value that is there.
void SpirvFunction::writePhi(const SpirvInstruction& phi, std::uint32_t label, const SpirvValues& values,
                             const NamedLabels& named, std::vector<std::uint32_t>& words) const {
  const std::size_t start = words.size();
  append(words, phi.words.first(3));
  for (std::size_t at = 3; at + 1 < phi.words.size(); at += 2) {
    const std::uint32_t from = phi.words[at + 1];
    const auto name = named.find(from);
    if (takes(from, label, values)) {
      append(words, phi.words.subspan(at, 2));
    } else if (name != named.end() && name->second == label) {
      words.insert(words.end(), {phi.words[2], from});
    }
  }
  words[start] = static_cast<std::uint32_t>(words.size() - start) << 16 | static_cast<std::uint32_t>(SpirvOp::phi);
}

void SpirvFunction::writeBlock(const SpirvBlock& block, const SpirvValues& values, const NamedLabels& named,
                               std::vector<std::uint32_t>& words) const {
  const std::uint32_t taken = takenLabel(block.end(), values);
  for (const SpirvInstruction& i : block.body) {
    if (i.op() == SpirvOp::line || i.op() == SpirvOp::noLine) continue;
    if (i.op() == SpirvOp::selectionMerge && taken != 0) continue;
    if (i.op() == SpirvOp::phi) {
      writePhi(i, block.label, values, named, words);
    } else if (&i == &block.end() && taken != 0) {
      append(words, SpirvOp::branch, {taken});
    } else {
      append(words, i.words);
    }
  }
}

void SpirvFunction::write(const SpirvValues& values, std::vector<std::uint32_t>& words,
                          std::vector<SpirvInstruction>& dead) const {
  const auto named = namedLabels(values);
  for (const SpirvInstruction& i : head_) append(words, i.words);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const SpirvBlock& block = blocks_[b];
    if (runs_[b]) {
      writeBlock(block, values, named, words);
      continue;
    }
    dead.insert(dead.end(), block.body.begin(), block.body.end());
    const auto name = named.find(block.label);
    if (name == named.end()) continue;
    // Structured control flow wants the block to be there.
    append(words, SpirvOp::label, {block.label});
    if (name->second != 0) {
      append(words, SpirvOp::branch, {name->second});
    } else {
      append(words, SpirvOp::unreachable, {});
    }
  }
  append(words, end_.words);
}

}  // namespace crosslight::gpu

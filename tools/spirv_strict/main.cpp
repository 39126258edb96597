// spirv_strict IN OUT: decorates every floating-point arithmetic instruction of a SPIR-V module with NoContraction, as
// if each GLSL expression had been declared `precise`. Compilers may then neither fuse nor rearrange: what a pipeline
// computes does not depend on which of its neighbours a specialisation constant removed.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace {

using Words = std::vector<std::uint32_t>;

constexpr std::uint32_t kMagic = 0x07230203u;
constexpr std::size_t kHeaderWords = 5;
constexpr std::uint32_t kOpDecorate = 71;
constexpr std::uint32_t kNoContraction = 42;

// SPIR-V 1.6, 3.49.13 "Arithmetic Instructions": those on floating-point operands whose result is of that kind.
bool isFloatArithmetic(std::uint32_t opcode) {
  static const std::set<std::uint32_t> kOpcodes{127, 129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148};
  return kOpcodes.contains(opcode);
}

// Annotations stand between debug and type instructions: OpDecorate, OpMemberDecorate, OpDecorationGroup, ...
bool isAnnotation(std::uint32_t opcode) {
  return (opcode >= 71 && opcode <= 75) || opcode == 332 || opcode == 5632 || opcode == 5633;
}

[[noreturn]] void fail(const std::string& file, const std::string& what) {
  std::fprintf(stderr, "spirv_strict: %s: %s\n", file.c_str(), what.c_str());
  std::exit(3);
}

Words readModule(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  const std::vector<char> bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (bytes.size() % 4 != 0 || bytes.size() < 4 * kHeaderWords) fail(file, "is not a SPIR-V module");
  Words words(bytes.size() / 4);
  for (std::size_t i = 0; i < words.size(); ++i) {
    for (std::size_t b = 0; b < 4; ++b)
      words[i] |= std::uint32_t{static_cast<unsigned char>(bytes[4 * i + b])} << (8 * b);
  }
  if (words[0] != kMagic) fail(file, "does not begin with SPIR-V's magic number");
  return words;
}

// Calls visit(opcode, instruction) for each instruction in order; visit gets the instruction's words.
template <class Visit>
void forEachInstruction(const std::string& file, const Words& module, const Visit& visit) {
  for (std::size_t at = kHeaderWords; at < module.size();) {
    const std::size_t length = module[at] >> 16;
    if (length == 0 || at + length > module.size()) fail(file, "ends within an instruction");
    visit(module[at] & 0xffffu, std::span(module).subspan(at, length), at);
    at += length;
  }
}

Words decorated(const std::string& file, const Words& module) {
  std::set<std::uint32_t> already;
  std::vector<std::uint32_t> results;
  std::size_t insertAt = 0;  // behind the last annotation
  forEachInstruction(file, module, [&](std::uint32_t opcode, std::span<const std::uint32_t> words, std::size_t at) {
    if (opcode == kOpDecorate && words.size() > 2 && words[2] == kNoContraction) already.insert(words[1]);
    if (isAnnotation(opcode)) insertAt = at + words.size();
    if (isFloatArithmetic(opcode)) results.push_back(words[2]);
  });
  if (insertAt == 0) fail(file, "has no annotations to stand beside");
  Words result(module.begin(), module.begin() + static_cast<std::ptrdiff_t>(insertAt));
  for (const std::uint32_t id : results) {
    if (!already.contains(id)) result.insert(result.end(), {(3u << 16) | kOpDecorate, id, kNoContraction});
  }
  result.insert(result.end(), module.begin() + static_cast<std::ptrdiff_t>(insertAt), module.end());
  return result;
}

void writeModule(const std::string& file, const Words& words) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  for (const std::uint32_t word : words) {
    for (int b = 0; b < 4; ++b) out.put(static_cast<char>((word >> (8 * b)) & 0xffu));
  }
  if (!out.flush()) fail(file, "cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: spirv_strict IN.spv OUT.spv\n");
    return 2;
  }
  writeModule(argv[2], decorated(argv[1], readModule(argv[1])));
  return 0;
}

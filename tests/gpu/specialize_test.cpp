// Modules with constants put in: still SPIR-V by the rules, and without what they rule out.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "gpu/spirv_specialize.h"

namespace crosslight::gpu {
namespace {

constexpr std::uint32_t kConstantIds = 5;  // shaders/shared: models, lights, shapes, effects, variant
constexpr std::uint32_t kMagic = 0x07230203u;

Constants all(std::uint32_t bits) {
  Constants constants;
  for (std::uint32_t id = 0; id < kConstantIds; ++id) constants.push_back({id, bits});
  return constants;
}

std::vector<Constants> fewChoices() { return {all(0u), all(~0u), all(0x55555555u), all(0xaaaaaaaau)}; }

// And each bit of each constant alone.
std::vector<Constants> choices() {
  std::vector<Constants> list = fewChoices();
  for (std::uint32_t id = 0; id < kConstantIds; ++id) {
    for (std::uint32_t bit = 0; bit < 24; ++bit) {
      list.push_back(all(0u));
      list.back()[id].bits = 1u << bit;
    }
  }
  return list;
}

std::uint32_t count(std::span<const std::uint32_t> module, std::uint32_t opcode) {
  std::uint32_t found = 0;
  for (std::size_t at = 5; at < module.size(); at += module[at] >> 16) found += (module[at] & 0xffffu) == opcode;
  return found;
}

TEST(Specialized, LeavesNoConstantOpenThatIsGiven) {
  constexpr std::uint32_t kSpecConstant = 50;
  for (const ShaderCode& code : embeddedShaders()) {
    const std::vector<std::uint32_t> words = specialized(code.words, all(~0u));
    EXPECT_EQ(words.front(), kMagic);
    EXPECT_EQ(count(words, kSpecConstant), 0u) << code.name;
  }
}

TEST(Specialized, DoingItAgainChangesNothing) {
  for (const ShaderCode& code : embeddedShaders()) {
    for (const Constants& constants : choices()) {
      const std::vector<std::uint32_t> once = specialized(code.words, constants);
      EXPECT_EQ(specialized(once, {}), once) << code.name;
    }
  }
}

// What makes it worth while: shading with one model and one light needs a fraction of the kernel that knows all.
TEST(Specialized, RulesOutWholeBranchesAndFunctions) {
  constexpr std::uint32_t kFunction = 54, kLabel = 248;
  const ShaderCode shade = embeddedShader("shade.comp");
  const std::vector<std::uint32_t> none = specialized(shade.words, all(0u)), full = specialized(shade.words, all(~0u));
  EXPECT_LT(2 * count(none, kLabel), count(full, kLabel));
  EXPECT_LT(count(none, kFunction), count(full, kFunction));
}

TEST(Specialized, KeepsTheDefaultOfAConstantThatIsNotGiven) {
  const ShaderCode shade = embeddedShader("shade.comp");
  EXPECT_EQ(specialized(shade.words, {}).size(), specialized(shade.words, {{1000, 7u}}).size());
}

TEST(Specialized, IsValidWhateverIsChosen) {
  if (std::system("spirv-val --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no spirv-val (package spirv-tools)";
  const auto file = std::filesystem::temp_directory_path() / ("specialized" + std::to_string(getpid()) + ".spv");
  const std::string check = "spirv-val --target-env vulkan1.3 --scalar-block-layout " + file.string();
  std::vector<std::vector<std::uint32_t>> seen;
  for (const ShaderCode& code : embeddedShaders()) {
    // A process for each: every bit only of what all rooms of shaders go into.
    for (const Constants& constants : code.name == "shade.comp" ? choices() : fewChoices()) {
      const std::vector<std::uint32_t> words = specialized(code.words, constants);
      if (std::find(seen.begin(), seen.end(), words) != seen.end()) continue;
      seen.push_back(words);
      std::ofstream(file, std::ios::binary)
          .write(reinterpret_cast<const char*>(words.data()), static_cast<std::streamsize>(4 * words.size()));
      ASSERT_EQ(std::system(check.c_str()), 0)
          << code.name << " with constant bits " << constants[0].bits << ", " << constants[1].bits << ", "
          << constants[2].bits << ", " << constants[3].bits << ", " << constants[4].bits;
    }
  }
  std::filesystem::remove(file);
  EXPECT_GT(seen.size(), embeddedShaders().size());
}

}  // namespace
}  // namespace crosslight::gpu

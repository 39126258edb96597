// Parts of a picture join to the file of one run, and nothing else joins.
#include <fmt/format.h>

#include "cli/program.h"

namespace crosslight::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kMirrors = CROSSLIGHT_SOURCE_DIR "/scenes/showcase/spheres_checker.gltf";

class Parts : public CliTest {
 protected:
  std::string part(const std::string& share, const std::string& file, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"render", kMirrors, "-o", file, "--part", share, "-r", "30x53"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return file;
  }
  void expectRefused(const std::vector<std::string>& parts, const std::vector<std::string>& said) const {
    std::vector<std::string> arguments = {"merge", "-o", "merged.png"};
    arguments.insert(arguments.end(), parts.begin(), parts.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exitCode, 3) << outcome.err;
    for (const std::string& words : said) EXPECT_THAT(outcome.err, HasSubstr(words));
    EXPECT_FALSE(std::filesystem::exists(path("merged.png")));
  }
};

TEST_F(Parts, joinToTheBytesOfOneRun) {
  struct Case {
    int count;
    std::string output;
    std::vector<std::string> options;
  };
  const std::vector<Case> cases = {
      {1, "a.exr", {"-m", "phong", "--aov", "all"}},
      {3, "a.exr", {"-m", "whitted", "--aov", "all", "--spp", "3", "--seed", "5"}},
      {5, "a.png", {"-m", "whitted", "--exposure", "0.5", "--tone-map", "reinhard", "--alpha"}},
      {2, "a.exr", {"-m", "wireframe", "--exposure", "1"}},
      {4, "a.pfm", {"-m", "flat"}},
  };
  for (const Case& item : cases) {
    std::vector<std::string> arguments = {"render", kMirrors, "-o", item.output, "-r", "30x53"};
    arguments.insert(arguments.end(), item.options.begin(), item.options.end());
    ASSERT_EQ(run(arguments).exitCode, 0);
    const std::string whole = read(item.output);
    std::vector<std::string> merge = {"merge", "-o", item.output};
    for (int i = item.count; i >= 1; --i) {
      merge.push_back(part(fmt::format("{}/{}", i, item.count), fmt::format("p{}.clpart", i), item.options));
    }
    std::filesystem::remove(path(item.output));
    const Outcome outcome = run(merge);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_TRUE(read(item.output) == whole) << item.count << " parts of " << testing::PrintToString(item.options);
  }
}

TEST_F(Parts, areTheSameBytesEveryTime) {
  part("2/3", "a.clpart");
  part("2/3", "b.clpart");
  EXPECT_TRUE(read("a.clpart") == read("b.clpart"));
}

TEST_F(Parts, thatAreMissingTwiceThereOrForeignAreRefused) {
  const std::string one = part("1/3", "1.clpart"), two = part("2/3", "2.clpart"), three = part("3/3", "3.clpart");
  expectRefused({one, three}, {"3 parts", "2 is missing"});
  expectRefused({two}, {"1, 3 are missing"});
  std::filesystem::copy_file(path(one), path("copy.clpart"));
  expectRefused({one, two, three, "copy.clpart"}, {"copy.clpart", "part 1 of 3", "once"});
  expectRefused({one, two, part("3/3", "seed.clpart", {"--seed", "1", "--spp", "2"})},
                {"seed.clpart", "/same/seed", "spp"});
  expectRefused({one, two, part("3/3", "method.clpart", {"-m", "flat"})}, {"method.clpart", "/same/method"});
  expectRefused({one, two, part("3/4", "four.clpart")}, {"four.clpart", "/parts"});
  // The same file name with another content.
  const std::string other = std::string("/scenes/showcase/teapots.gltf");
  ASSERT_EQ(
      run({"render", CROSSLIGHT_SOURCE_DIR + other, "-o", "scene.clpart", "--part", "3/3", "-r", "30x53"}).exitCode, 0);
  expectRefused({one, two, "scene.clpart"}, {"scene.clpart", "/same/scene/hash"});
}

TEST_F(Parts, thatAreDamagedAreRefused) {
  const std::string one = part("1/2", "1.clpart"), two = part("2/2", "2.clpart");
  const std::string good = read(two);
  write("bad.clpart", good.substr(0, good.size() - 9));
  expectRefused({one, "bad.clpart"}, {"bad.clpart", "cut off"});
  write("bad.clpart", good + "x");
  expectRefused({one, "bad.clpart"}, {"bad.clpart", "after its end"});
  for (std::size_t at = 0; at < good.size(); at += 1 + at / 8) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 1);
    write("bad.clpart", bad);
    expectRefused({one, "bad.clpart"}, {"bad.clpart"});
  }
  write("bad.clpart", "no part at all, but long enough for a header");
  expectRefused({one, "bad.clpart"}, {"bad.clpart", "no part file"});
  expectRefused({one, "nosuch.clpart"}, {"nosuch.clpart"});
  expectRefused({one, "."}, {"folder"});
}

TEST_F(Parts, thatCannotBeMeantAreTwo) {
  const std::vector<std::vector<std::string>> cases = {
      {"-o", "a.png", "--part", "1/2"},    {"-o", "a.clpart"},
      {"-o", "a.clpart", "--part", "0/2"}, {"-o", "a.clpart", "--part", "3/2"},
      {"-o", "a.clpart", "--part", "1"},   {"-o", "a.clpart", "--part", "1/2/3"},
      {"-o", "a.clpart", "--part", "1/x"}, {"-o", "a.clpart", "--part", "1/9", "-r", "8x8"},
  };
  for (const auto& more : cases) {
    std::vector<std::string> arguments = {"render", kMirrors};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run(arguments).exitCode, 2) << testing::PrintToString(arguments);
  }
  part("1/1", "a.clpart", {"--aov", "depth"});
  const Outcome outcome = run({"merge", "a.clpart", "-o", "a.png"});
  EXPECT_EQ(outcome.exitCode, 2);
  EXPECT_THAT(outcome.err, HasSubstr("-o a.exr"));
  EXPECT_THAT(files(), ElementsAre("a.clpart"));
}

}  // namespace
}  // namespace crosslight::test

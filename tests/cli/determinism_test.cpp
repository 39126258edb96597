// The same command gives the same bytes: again, with any number of the software driver's threads, and whatever the
// driver's and our own caches hold.
#include <algorithm>

#include "cli/program.h"

namespace crosslight::test {
namespace {

const std::string kScenes = CROSSLIGHT_SOURCE_DIR "/scenes/";

// Rays with shadows, mirrors, glass and several samples; and a raster method over many draws.
struct Picture {
  const char* name;
  std::vector<std::string> arguments;
};
void PrintTo(const Picture& p, std::ostream* out) { *out << p.name; }

const Picture kPictures[] = {
    {"whitted", {kScenes + "showcase/spheres_checker.gltf", "-m", "whitted", "--spp", "4", "--seed", "3"}},
    {"phong", {kScenes + "showcase/teapots.gltf", "-m", "phong"}},
};

class Determinism : public CliTest, public testing::WithParamInterface<Picture> {
 protected:
  // The file's bytes: the picture, every AOV and the attributes that say what made it.
  std::string bytesWith(const Environment& environment) const {
    std::vector<std::string> arguments = GetParam().arguments;
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), {"-o", "out.exr", "--aov", "all", "-r", "160x120", "--quiet"});
    const Outcome outcome = run(arguments, environment);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return read("out.exr");
  }

  // In words for a failure: bytes themselves are no help.
  static std::string difference(const std::string& a, const std::string& b) {
    if (a.size() != b.size()) return std::to_string(a.size()) + " and " + std::to_string(b.size()) + " bytes";
    const auto at = std::mismatch(a.begin(), a.end(), b.begin()).first;
    if (at == a.end()) return "";
    return "byte " + std::to_string(at - a.begin()) + " of " + std::to_string(a.size()) + " is the first that differs";
  }
};

TEST_P(Determinism, secondRunGivesTheSameBytes) {
  const std::string first = bytesWith({});
  EXPECT_GT(first.size(), std::size_t{160 * 120 * 4}) << "too small to hold the picture and its AOVs";
  EXPECT_EQ(difference(first, bytesWith({})), "");
}

TEST_P(Determinism, numberOfThreadsChangesNoByte) {
  const std::string first = bytesWith({{"LP_NUM_THREADS", "0"}});
  for (const char* threads : {"1", "2", "7"}) {
    EXPECT_EQ(difference(first, bytesWith({{"LP_NUM_THREADS", threads}})), "") << threads << " threads";
  }
}

TEST_P(Determinism, stateOfTheCachesChangesNoByte) {
  const Environment fresh{{"MESA_SHADER_CACHE_DIR", path("mesa").string()}, {"XDG_CACHE_HOME", path("xdg").string()}};
  const std::string cold = bytesWith(fresh);
  const auto isFilled = [](const std::filesystem::path& folder) {
    return std::filesystem::exists(folder) && !std::filesystem::is_empty(folder);
  };
  EXPECT_TRUE(isFilled(path("mesa")) || isFilled(path("xdg"))) << "nothing was cached: cold and warm are the same";
  EXPECT_EQ(difference(cold, bytesWith(fresh)), "") << "cold and warm cache";
  Environment none = fresh;
  none["MESA_SHADER_CACHE_DISABLE"] = "true";
  EXPECT_EQ(difference(cold, bytesWith(none)), "") << "cold cache and none";
}

// The comparison sees a change that is there.
TEST_P(Determinism, anotherPictureHasOtherBytes) {
  const std::string first = bytesWith({});
  ASSERT_EQ(run({"render", GetParam().arguments.front(), "-o", "out.exr", "--aov", "all", "-r", "160x120", "--quiet",
                 "-m", "gouraud"})
                .exitCode,
            0);
  EXPECT_NE(difference(first, read("out.exr")), "");
}

INSTANTIATE_TEST_SUITE_P(Each, Determinism, testing::ValuesIn(kPictures),
                         [](const auto& i) { return std::string(i.param.name); });

}  // namespace
}  // namespace crosslight::test

// Frames have the bits of single pictures at the same time and from the same place; videos get those pictures, whole or
// not at all.
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/animation.h"
#include "cli/program.h"
#include "image/image_io.h"

namespace crosslight::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Frames : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    write("moving.gltf", movingTriangle());
  }

  // A folder with a program "ffmpeg" that is this shell script; "$out" is the file to make.
  Environment fakeEncoder(const std::string& script) const {
    const std::filesystem::path bin = path("bin");
    std::filesystem::create_directory(bin);
    write("bin/ffmpeg", "#!/bin/sh\nfor out; do :; done\n" + script + "\n");
    std::filesystem::permissions(bin / "ffmpeg", std::filesystem::perms::owner_all);
    return {{"PATH", bin.string() + ":/usr/bin:/bin"}};
  }

  std::string singlePicture(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"render", "moving.gltf", "-o", "single.exr", "-r", "24x18", "--aov", "all"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return read("single.exr");
  }
};

TEST_F(Frames, haveTheBytesOfSinglePicturesAtTheirTime) {
  for (const std::string method : {"phong", "whitted"}) {
    const Outcome outcome = run({"render", "moving.gltf", "-o", "f_##.exr", "-r", "24x18", "--aov", "all", "--frames",
                                 "2-9", "--fps", "4", "-m", method, "--json", "record.json"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const std::vector<std::pair<std::string, std::string>> timeOf = {
        {"f_02.exr", "0.5"}, {"f_03.exr", "0.75"}, {"f_09.exr", "2.25"}};
    for (const auto& [file, seconds] : timeOf) {
      EXPECT_TRUE(read(file) == singlePicture({"-m", method, "--time", seconds})) << method << " " << file;
    }
    EXPECT_FALSE(read("f_02.exr") == read("f_03.exr")) << "nothing moves";
    EXPECT_FALSE(std::filesystem::exists(path("f_01.exr")) || std::filesystem::exists(path("f_10.exr")));
  }
  const json record = json::parse(read("record.json"));
  ASSERT_EQ(record["frames"].size(), 8u);
  EXPECT_EQ(record["frames"][1]["timeSeconds"], 0.75);
  EXPECT_EQ(record["frames"][1]["output"], "f_03.exr");
}

TEST_F(Frames, ofOneAnimationLeaveTheOthersAlone) {
  const auto draw = [this](const std::vector<std::string>& more) { return singlePicture(more); };
  const std::string all = draw({"--time", "0.5"}), fly = draw({"--time", "0.5", "--animation", "fly"});
  const std::string roll = draw({"--time", "0.5", "--animation", "1"});
  EXPECT_FALSE(all == fly);
  EXPECT_FALSE(all == roll);
  EXPECT_FALSE(fly == roll);
  ASSERT_EQ(run({"render", "moving.gltf", "-o", "f_#.exr", "-r", "24x18", "--aov", "all", "--frames", "1", "--fps", "4",
                 "--time", "0.5", "--animation", "fly"})
                .exitCode,
            0);
  EXPECT_TRUE(read("f_0.exr") == fly);
  const Outcome unknown = run({"render", "moving.gltf", "-o", "a.png", "--animation", "swim"});
  EXPECT_EQ(unknown.exitCode, 2);
  EXPECT_THAT(unknown.err, HasSubstr("'fly'"));
}

TEST_F(Frames, ofATurntableHaveTheBytesOfTurnedCameras) {
  for (const std::string method : {"gouraud", "whitted"}) {
    ASSERT_EQ(run({"render", "moving.gltf", "-o", "t_###.exr", "-r", "24x18", "--aov", "all", "--turntable", "8", "-m",
                   method, "--set", "two-sided=always"})
                  .exitCode,
              0);
    const std::vector<std::pair<std::string, std::string>> turnOf = {
        {"t_000.exr", "0"}, {"t_001.exr", "45"}, {"t_006.exr", "270"}};
    for (const auto& [file, degrees] : turnOf) {
      EXPECT_TRUE(read(file) == singlePicture({"-m", method, "--turn", degrees, "--set", "two-sided=always"}))
          << method << " " << file;
    }
    EXPECT_FALSE(read("t_000.exr") == read("t_001.exr")) << "nothing turns";
  }
}

TEST_F(Frames, thatCannotBeMeantAreTwo) {
  struct Case {
    std::vector<std::string> arguments;
    std::string said;
  };
  const std::vector<Case> cases = {
      {{"-o", "a.png", "--frames", "3"}, "frame_####.png"},
      {{"-o", "a_#_#.png", "--frames", "3"}, "frame_####.png"},
      {{"-o", "a_#.jpg", "--frames", "3"}, ".png"},
      {{"-o", "a_#.png", "--frames", "0"}, "'0'"},
      {{"-o", "a_#.png", "--frames", "5-4"}, "'5-4'"},
      {{"-o", "a_#.png", "--frames", "1-"}, "'1-'"},
      {{"-o", "a_#.png", "--frames", "x"}, "'x'"},
      {{"-o", "a_#.png", "--frames", "2", "--fps", "0"}, "0.001"},
      {{"-o", "a.mp4"}, "--frames"},
      {{"-o", "a_#.clpart", "--frames", "3", "--part", "1/2"}, "--part"},
  };
  for (const Case& item : cases) {
    std::vector<std::string> arguments = {"render", "moving.gltf"};
    arguments.insert(arguments.end(), item.arguments.begin(), item.arguments.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exitCode, 2) << testing::PrintToString(arguments) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(item.said));
  }
  EXPECT_THAT(files(), ElementsAre("moving.gltf"));
}

TEST_F(Frames, goToTheEncoderAsTheyAreShown) {
  const Environment fake = fakeEncoder("echo \"$@\" > words; cat > \"$out\"");
  const Outcome outcome =
      run({"render", "moving.gltf", "-o", "a.mkv", "-r", "10x7", "--frames", "3", "--fps", "12.5"}, fake);
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  ASSERT_EQ(run({"render", "moving.gltf", "-o", "f_#.exr", "-r", "10x7", "--frames", "3", "--fps", "12.5"}).exitCode,
            0);
  std::string expected;
  for (const char* frame : {"f_0.exr", "f_1.exr", "f_2.exr"}) {
    const DisplayPicture shown = displayPicture(readImage(path(frame)), {});
    expected.append(shown.codes.begin(), shown.codes.end());
  }
  EXPECT_EQ(expected.size(), 3u * 10 * 7 * 3);
  EXPECT_TRUE(read("a.mkv") == expected);
  for (const char* words : {"-video_size 10x7", "-framerate 12.5", "rgb24"})
    EXPECT_THAT(read("words"), HasSubstr(words));
}

TEST_F(Frames, withoutAnEncoderAreFourWithARemedy) {
  const Outcome outcome = run({"render", "moving.gltf", "-o", "a.mp4", "--frames", "3"}, {{"PATH", "/nonexistent"}});
  EXPECT_EQ(outcome.exitCode, 4) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("package ffmpeg"));
  EXPECT_THAT(files(), ElementsAre("moving.gltf"));
}

TEST_F(Frames, areFourWhenTheEncoderFailsAndLeaveTheOldFile) {
  write("a.mp4", "the film of yesterday");
  for (const char* script : {"echo 'no such codec' >&2; exit 3", "cat > \"$out\"; echo 'no such codec' >&2; exit 3",
                             "echo 'no such codec' >&2; kill -9 $$"}) {
    const Environment fake = fakeEncoder(script);
    const Outcome outcome = run({"render", "moving.gltf", "-o", "a.mp4", "-r", "400x300", "--frames", "3"}, fake);
    EXPECT_EQ(outcome.exitCode, 4) << script << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("no such codec"));
    std::filesystem::remove_all(path("bin"));
    EXPECT_THAT(files(), ElementsAre("a.mp4", "moving.gltf")) << script;
    EXPECT_EQ(read("a.mp4"), "the film of yesterday");
  }
}

TEST_F(Frames, thatAreInterruptedLeaveNothingHalf) {
  // An encoder that takes nothing and says where it is.
  const Environment fake = fakeEncoder("echo $$ > pid; sleep 600");
  Running program({"render", "moving.gltf", "-o", "a.mp4", "-r", "400x300", "--frames", "1000", "-v"}, folder_, fake);
  ASSERT_TRUE(program.waitForStderr("frame 0 drawn"));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  program.signal(SIGINT);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.exitCode, 130) << outcome.err;
  EXPECT_THAT(files(), ElementsAre("bin", "moving.gltf", "pid"));
  EXPECT_NE(::kill(std::stoi(read("pid")), 0), 0) << "the encoder still runs";
}

TEST_F(Frames, becomeAVideoByTheRealEncoder) {
  if (std::system("command -v ffmpeg > /dev/null") != 0) GTEST_SKIP() << "ffmpeg is not installed";
  for (const std::string name : {"a.mp4", "a.mkv", "a.webm", "a.gif"}) {
    const Outcome outcome = run({"render", "moving.gltf", "-o", name, "-r", "33x17", "--frames", "5"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_GT(read(name).size(), 100u) << name;
  }
  EXPECT_THAT(files(), ElementsAre("a.gif", "a.mkv", "a.mp4", "a.webm", "moving.gltf"));
  EXPECT_EQ(read("a.gif").substr(0, 6), "GIF89a");
  EXPECT_EQ(read("a.mp4").substr(4, 4), "ftyp");
}

}  // namespace
}  // namespace crosslight::test

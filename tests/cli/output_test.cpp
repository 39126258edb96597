// Output files are written whole or not at all, and nothing else is left in the folder.
#include <csignal>
#include <thread>

#include "cli/program.h"
#include "image/image_io.h"

namespace crosslight::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Output = CliTest;

// Hours of samples: nothing but a signal ends it in time.
const std::vector<std::string> kEndless = {"render", scene(),   "-o",     "long.png",  "-r",       "1024x1024",
                                           "--spp",  "1048576", "--json", "long.json", "--verbose"};

TEST_F(Output, everyFormatHoldsTheWholePicture) {
  for (const std::string name : {"a.png", "a.exr", "a.hdr", "a.pfm", "A.PNG"}) {
    const Outcome outcome = run({"render", scene(), "-o", name, "-r", "24x16"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_THAT(outcome.out, IsEmpty()) << name;
    const Image image = readImage(path(name));
    EXPECT_EQ(image.width, 24u) << name;
    EXPECT_EQ(image.height, 16u) << name;
    float most = 0;
    for (const float sample : image.picture().samples) most = std::max(most, sample);
    EXPECT_GT(most, 0.05f) << name << " is black";
  }
  EXPECT_THAT(files(), ElementsAre("A.PNG", "a.exr", "a.hdr", "a.pfm", "a.png"));
}

TEST_F(Output, exrHoldsTheLayersThatWereAskedFor) {
  const Outcome outcome = run({"render", scene(), "-o", "a.exr", "-r", "8x8", "--aov", "normal,depth"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const Image image = readImage(path("a.exr"));
  EXPECT_NE(image.find("depth"), nullptr);
  EXPECT_NE(image.find("normal"), nullptr);
  EXPECT_EQ(image.find("uv"), nullptr);
}

TEST_F(Output, sameCommandGivesTheSameBytes) {
  for (const std::string name : {"a.exr", "b.exr"}) {
    ASSERT_EQ(run({"render", scene(), "-o", name, "-r", "32x32", "--spp", "4", "--seed", "3"}).exitCode, 0);
  }
  EXPECT_TRUE(read("a.exr") == read("b.exr")) << "two runs differ";
}

TEST_F(Output, placesThatCannotTakeItAreFoundBeforeTheSceneIsRead) {
  write("file", "");
  std::filesystem::create_directory(path("folder.png"));
  for (const std::string place : {"nofolder/a.png", "file/a.png", "folder.png", "/proc/a.png"}) {
    const Outcome outcome = run({"render", "missing.gltf", "-o", place});
    EXPECT_EQ(outcome.exitCode, 3) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(place));
    EXPECT_THAT(outcome.err, testing::Not(HasSubstr("missing.gltf"))) << "the scene was looked at first";
  }
  const Outcome record = run({"render", "missing.gltf", "-o", "a.png", "--json", "nofolder/a.json"});
  EXPECT_EQ(record.exitCode, 3);
  EXPECT_THAT(record.err, HasSubstr("nofolder/a.json"));
  EXPECT_THAT(files(), ElementsAre("file", "folder.png"));
}

TEST_F(Output, folderWithoutPermissionIsRefusedWithNothingLeft) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere; /proc stands in for it in another test";
  std::filesystem::permissions(folder_, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const Outcome outcome = run({"render", scene(), "-o", "a.png"});
  EXPECT_EQ(outcome.exitCode, 3) << outcome.err;
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(Output, interruptionIs130AndLeavesTheFolderAsItWas) {
  for (const int number : {SIGINT, SIGTERM}) {
    write("long.png", "the picture of yesterday");
    Running program(kEndless, folder_);
    ASSERT_TRUE(program.waitForStderr("drawing on")) << program.wait().err;
    std::this_thread::sleep_for(std::chrono::milliseconds(500));  // into the drawing itself
    program.signal(number);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exitCode, 130) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("interrupted"));
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(files(), ElementsAre("long.png"));
    EXPECT_EQ(read("long.png"), "the picture of yesterday");
  }
}

TEST_F(Output, fullDiskIsThreeNotSilence) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const std::string line =
      std::string("'") + CROSSLIGHT_BINARY_DIR "/crosslight' man > /dev/full 2> '" + path("err").string() + "'";
  const int status = std::system(line.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_THAT(read("err"), HasSubstr("standard output"));
}

TEST_F(Output, writingThatFailsHalfWayIsThreeAndLeavesNothing) {
  for (const std::string name : {"a.png", "a.exr", "a.hdr", "a.pfm"}) {
    // Files may grow to four blocks (2 or 4 KiB, as the shell counts them), and nobody dies of trying more.
    const std::string line = "cd '" + folder_.string() + "' && trap '' XFSZ && ulimit -f 4 && exec '" +
                             CROSSLIGHT_BINARY_DIR "/crosslight' render '" + scene() + "' -r 256x256 --quiet -o " +
                             name + " 2>/dev/null";
    const int status = std::system(line.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 3) << name;
    EXPECT_THAT(files(), IsEmpty()) << name;
  }
}

TEST_F(Output, quietSaysNothingAndNormalSaysOneLineWithTimes) {
  const Outcome quiet = run({"render", scene(), "-o", "a.png", "-r", "8x8", "--quiet"});
  ASSERT_EQ(quiet.exitCode, 0) << quiet.err;
  EXPECT_THAT(quiet.err, IsEmpty());
  const Outcome normal = run({"render", scene(), "-o", "a.png", "-r", "8x8"});
  for (const char* phase : {"a.png", "load ", "pipelines ", "render ", "encode "}) {
    EXPECT_THAT(normal.err, HasSubstr(phase));
  }
}

TEST_F(Output, optionsThatTheMethodDoesNotHeedAreNamed) {
  const Outcome outcome = run(
      {"render", scene(), "-o", "a.png", "-r", "8x8", "--method", "phong", "--set", "shadows=off", "--max-depth", "2"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("--set shadows has no effect on the method phong"));
  EXPECT_THAT(outcome.err, HasSubstr("--max-depth has no effect on the method phong"));
}

TEST_F(Output, sheetShowsAllImages) {
  ASSERT_EQ(run({"render", scene(), "-o", "a.png", "-r", "40x30"}).exitCode, 0);
  ASSERT_EQ(run({"render", scene(), "-o", "b.exr", "-r", "40x30"}).exitCode, 0);
  const Outcome outcome = run({"sheet", "a.png", "b.exr", "--caption", "left", "--columns", "2", "-o", "sheet.png"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_GT(readImage(path("sheet.png")).width, 80u);
  EXPECT_GT(readImage(path("sheet.png")).height, 30u);
  const Outcome missing = run({"sheet", "a.png", "nosuch.png", "-o", "other.png"});
  EXPECT_EQ(missing.exitCode, 3);
  EXPECT_THAT(missing.err, HasSubstr("nosuch.png"));
  const Outcome toomany = run({"sheet", "a.png", "-o", "other.png", "--note", "1", "--note", "2"});
  EXPECT_EQ(toomany.exitCode, 2) << toomany.err;
  EXPECT_THAT(files(), ElementsAre("a.png", "b.exr", "sheet.png"));
}

}  // namespace
}  // namespace crosslight::test

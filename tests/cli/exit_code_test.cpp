// Each way to fail has its exit code, names what is wrong, and leaves stdout and the folder empty.
#include <fmt/format.h>

#include "cli/program.h"

namespace crosslight::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

using ExitCodes = CliTest;

TEST_F(ExitCodes, wrongUseIsTwoAndTellsWhatThereIs) {
  struct Case {
    std::vector<std::string> arguments;
    std::vector<std::string> said;
  };
  const std::string s = scene();
  const std::vector<Case> cases = {
      {{}, {"no command given"}},
      {{"rendr"}, {"unknown command 'rendr'", "Did you mean 'render'?", "devices"}},
      {{"--fast"}, {"unknown option '--fast'"}},
      {{"render"}, {"no scene given"}},
      {{"render", s}, {"no output given"}},
      {{"render", s, "-o", "a.jpg"}, {"a.jpg", ".png, .exr, .hdr or .pfm"}},
      {{"render", s, "-o", "noextension"}, {"noextension"}},
      {{"render", s, "-o", "a.png", "--metod", "phong"}, {"unknown option '--metod'", "Did you mean '--method'?"}},
      {{"render", s, "-o", "a.png", "--method", "fong"}, {"unknown method 'fong'", "whitted", "Did you mean 'phong'?"}},
      {{"render", s, "-o", "a.png", "--method"}, {"--method"}},
      {{"render", s, "-o", "a.png", "--method", ""}, {"unknown method ''"}},
      {{"render", s, "-o", "a.png", "--resolution", "0x10"}, {"'0x10'", "from 1 to 65536", "640x480"}},
      {{"render", s, "-o", "a.png", "--spp", "0"}, {"'0' is not a whole number from 1 to"}},
      {{"render", s, "-o", "a.png", "--spp", "-1"}, {"'-1' is not a whole number"}},
      {{"render", s, "-o", "a.png", "--spp", "1e3"}, {"'1e3' is not a whole number"}},
      {{"render", s, "-o", "a.png", "--seed", "18446744073709551616"}, {"is not a whole number"}},
      {{"render", s, "-o", "a.png", "--msaa", "3"}, {"unknown msaa '3'", "1, 2, 4, 8"}},
      {{"render", s, "-o", "a.png", "--exposure", "nan"}, {"'nan' is not a number"}},
      {{"render", s, "-o", "a.png", "--time", "-1"}, {"'-1' is not a number from 0"}},
      {{"render", s, "-o", "a.png", "--filter", "boks"}, {"unknown filter 'boks'", "box, tent, gaussian, mitchell"}},
      {{"render", s, "-o", "a.png", "--sampler", "halton"}, {"unknown sampler 'halton'", "sobol, regular, jittered"}},
      {{"render", s, "-o", "a.png", "--lighting", "gl"}, {"unknown lighting 'gl'", "standard, opengl"}},
      {{"render", s, "-o", "a.png", "--set", "shadow=on"}, {"unknown key 'shadow'", "Did you mean 'shadows'?"}},
      {{"render", s, "-o", "a.png", "--set", "shadows=1"}, {"unknown value '1'", "on, off"}},
      {{"render", s, "-o", "a.png", "--aov", "depth"}, {"-o a.exr"}},
      {{"render", s, "-o", "a.exr", "--aov", "dept"}, {"unknown AOV 'dept'", "Did you mean 'depth'?"}},
      {{"render", s, "-o", "a.png", "--camera", "no such camera"}, {"no such camera"}},
      {{"render", s, "-o", "a.png", "--scene", "no such scene"}, {"no such scene"}},
      {{"render", s, "-o", "a.clpart", "--part", "1/2", "--spp", "64", "--adaptive", "0.1"}, {"leave out --part"}},
      {{"render", s, "-o", "a.png", "--ray-tree", "1,1"}, {"--ray-tree is of rays", "--method whitted"}},
      {{"render", s, "-o", "a.png", "--method", "whitted", "-r", "8x6", "--ray-tree", "8,0"}, {"'8,0'", "0 to 7"}},
      {{"render", s, "-o", "a.png", "--method", "whitted", "--ray-tree", "1"}, {"is no pixel X,Y"}},
      {{"render", s, "-o", "a.png", "--quiet", "--verbose"}, {"excludes"}},
      {{"render", s, s, "-o", "a.png"}, {"unexpected argument"}},
      {{"info"}, {"SCENE is required"}},
      {{"completion", "tcsh"}, {"bash, zsh, fish"}},
      {{"sheet", "-o", "a.png"}, {"IMAGE is required"}},
  };
  for (const Case& item : cases) {
    const std::string line = testing::PrintToString(item.arguments);
    const Outcome outcome = run(item.arguments);
    EXPECT_EQ(outcome.exitCode, 2) << line << "\n" << outcome.err;
    EXPECT_THAT(outcome.out, IsEmpty()) << line;
    for (const std::string& words : item.said) EXPECT_THAT(outcome.err, HasSubstr(words)) << line;
  }
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(ExitCodes, unreadableInputIsThreeAndNamesTheFile) {
  write("empty.gltf", "");
  write("broken.gltf", R"({"asset": {"version": "2.0"}, "nodes": [)");
  write("broken.glb", std::string("glTF\x02\0\0\0\xff\xff\0\0", 12));
  write("scene.obj", "v 0 0 0\n");
  write("needs.gltf",
        R"({"asset": {"version": "2.0"}, "extensionsUsed": ["X_unheard"], "extensionsRequired": ["X_unheard"]})");
  write("loop.gltf",
        R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"children": [0]}]})");
  for (const std::string command : {"render", "info"}) {
    for (const std::string file :
         {"missing.gltf", "empty.gltf", "broken.gltf", "broken.glb", "scene.obj", "needs.gltf", "loop.gltf", "."}) {
      std::vector<std::string> arguments = {command, file};
      if (command == "render") arguments.insert(arguments.end(), {"-o", "a.png"});
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.exitCode, 3) << command << " " << file << "\n" << outcome.err;
      EXPECT_THAT(outcome.err, HasSubstr(file)) << command;
      EXPECT_THAT(outcome.out, IsEmpty()) << command << " " << file;
    }
  }
  EXPECT_THAT(run({"info", "needs.gltf"}).err, HasSubstr("X_unheard"));
  EXPECT_FALSE(std::filesystem::exists(path("a.png")));
}

TEST_F(ExitCodes, missingDeviceIsFourAndListsThoseThereAre) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"render", scene(), "-o", "a.png", "--device", "nosuch"},
        std::vector<std::string>{"render", scene(), "-o", "a.png", "--device", "4294967295"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exitCode, 4) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(arguments.back()));
    EXPECT_THAT(outcome.out, IsEmpty());
  }
  EXPECT_EQ(run({"devices", "--device", "nosuch"}).exitCode, 4);
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(ExitCodes, noDriverAtAllIsFourForWorkAndZeroForAList) {
  const Environment noDriver = {{"VK_DRIVER_FILES", "/nonexistent.json"}, {"VK_ICD_FILENAMES", "/nonexistent.json"}};
  const Outcome drawn = run({"render", scene(), "-o", "a.png"}, noDriver);
  EXPECT_EQ(drawn.exitCode, 4) << drawn.err;
  EXPECT_THAT(drawn.err, HasSubstr("mesa-vulkan-drivers"));
  const Outcome listed = run({"devices"}, noDriver);
  EXPECT_EQ(listed.exitCode, 0) << listed.err;
  EXPECT_THAT(listed.out, HasSubstr("No Vulkan driver"));
  EXPECT_EQ(run({"devices", "--require-device"}, noDriver).exitCode, 4);
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(ExitCodes, requiredDeviceIsHardwareUnlessNamed) {
  const Outcome listed = run({"devices"});
  ASSERT_EQ(listed.exitCode, 0) << listed.err;
  if (listed.out.find("software driver") == std::string::npos) GTEST_SKIP() << "there is no software driver here";
  const Outcome named =
      run({"render", scene(), "-o", "a.png", "-r", "8x8", "--require-device", "--device", "lavapipe"});
  EXPECT_EQ(named.exitCode, 0) << named.err;
  EXPECT_THAT(named.err, HasSubstr("software driver"));
  const bool onlyDevice = listed.out.find("\n1: ") == std::string::npos;
  const Outcome unnamed = run({"render", scene(), "-o", "b.png", "-r", "8x8", "--require-device"});
  EXPECT_TRUE(unnamed.exitCode == 4 || !onlyDevice) << unnamed.err;
  if (onlyDevice) {
    EXPECT_THAT(unnamed.err, HasSubstr("--device lavapipe"));
  }
}

}  // namespace
}  // namespace crosslight::test

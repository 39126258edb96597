// JSON records have the fields that the design promises, and they agree with what was asked and made.
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace crosslight::test {
namespace {

using nlohmann::json;
using testing::IsEmpty;

class Records : public CliTest {
 protected:
  static void expectHead(const json& record, const std::string& command) {
    for (const char* key : {"schema", "version", "commit", "device", "driver", "cpu", "command", "seed", "timings"}) {
      EXPECT_TRUE(record.contains(key)) << command << " lacks " << key;
    }
    EXPECT_EQ(record["command"], command);
    EXPECT_EQ(record["schema"], 1);
  }

  json onStdout(const std::vector<std::string>& arguments) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return json::parse(outcome.out);
  }
};

TEST_F(Records, rayTreeLiesBesideThePicture) {
  const json record = onStdout(
      {"render", scene(), "-o", "a.png", "-r", "20x10", "--method", "whitted", "--ray-tree", "10,5", "--json", "-"});
  EXPECT_EQ(record["rayTree"], "a.tree.json");
  const json tree = json::parse(read("a.tree.json"));
  EXPECT_EQ(tree["pixel"], json({10, 5}));
  EXPECT_EQ(tree["nodes"][0]["ray"], "primary");
  EXPECT_THAT(read("a.tree.svg"), testing::StartsWith("<svg"));
  EXPECT_THAT(files(), testing::ElementsAre("a.png", "a.tree.json", "a.tree.svg"));
}

TEST_F(Records, renderTellsWhatWasMeasured) {
  const json record = onStdout({"render", scene(), "-o", "a.exr", "-r", "20x10", "--spp", "2", "--seed", "9",
                                "--method", "whitted", "--aov", "depth", "--json", "-"});
  expectHead(record, "render");
  for (const char* key :
       {"output", "method", "plan", "rays", "counters", "nonfinite", "promise", "pixelFilter", "gpu"}) {
    EXPECT_TRUE(record.contains(key)) << key;
  }
  EXPECT_EQ(record["output"], "a.exr");
  EXPECT_EQ(record["method"], "whitted");
  EXPECT_EQ(record["seed"], 9);
  EXPECT_EQ(record["nonfinite"], 0);
  EXPECT_EQ(record["settings"]["width"], 20);
  EXPECT_EQ(record["settings"]["height"], 10);
  EXPECT_EQ(record["settings"]["spp"], 2);
  EXPECT_EQ(record["layers"], json({"picture", "depth"}));
  // The samples' own, and one at each pixel's center for the depth.
  EXPECT_EQ(record["rays"]["primary"], 20 * 10 * 2 + 20 * 10);
  EXPECT_GT(record["deviceBytes"], 0);
  ASSERT_FALSE(record["plan"]["effects"].empty());
  for (const json& effect : record["plan"]["effects"]) EXPECT_NE(effect["reason"], "") << effect["name"];
}

// What ran beside other phases is named; the rest, with what was waited for it, adds up.
TEST_F(Records, phasesOfARenderAddUpToNoMoreThanTheTotal) {
  const json record = onStdout({"render", scene(), "-o", "a.png", "-r", "20x10", "--json", "-"});
  const json& times = record["timings"];
  const json& beside = record["overlapped"];
  EXPECT_EQ(beside, json({"instance", "device"}));
  double sumMs = 0;
  for (const char* phase :
       {"load", "instance", "device", "deviceWait", "bvh", "upload", "pipelines", "render", "readback", "encode"}) {
    const std::string key = std::string(phase) + "Ms";
    ASSERT_TRUE(times.contains(key)) << key;
    EXPECT_GE(times[key], 0.0) << key;
    const bool overlaps = std::find(beside.begin(), beside.end(), phase) != beside.end();
    if (!overlaps) sumMs += times[key].get<double>();
  }
  EXPECT_LE(sumMs, times["totalMs"].get<double>());
}

TEST_F(Records, goToAFileAsWell) {
  const Outcome outcome = run({"render", scene(), "-o", "a.png", "-r", "8x8", "--json", "a.json"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_THAT(outcome.out, IsEmpty());
  expectHead(json::parse(read("a.json")), "render");
}

TEST_F(Records, infoTellsWhatTheSceneHas) {
  const json record = onStdout({"info", scene(), "--json", "-"});
  expectHead(record, "info");
  EXPECT_TRUE(record["device"].is_null());
  const json& s = record["scene"];
  EXPECT_GT(s["counts"]["triangles"], 0);
  EXPECT_GT(s["hostBytes"], 0);
  ASSERT_FALSE(s["cameras"].empty());
  ASSERT_FALSE(s["lights"].empty());
  bool phong = false;
  for (const json& material : s["materials"]) phong = phong || material["model"] == "phong";
  EXPECT_TRUE(phong) << "the scene of the model phong has no phong material";
  for (int axis = 0; axis < 3; ++axis) EXPECT_LE(s["bounds"]["lower"][axis], s["bounds"]["upper"][axis]);
}

TEST_F(Records, infoAgreesWithTheFileItself) {
  std::ifstream in(scene());
  const json file = json::parse(in);
  const json s = onStdout({"info", scene(), "--json", "-"})["scene"];
  EXPECT_EQ(s["counts"]["nodes"], file["nodes"].size());
  for (const json& name : file["extensionsUsed"]) {
    const bool named = std::find(s["extensions"].begin(), s["extensions"].end(), name) != s["extensions"].end();
    EXPECT_TRUE(named) << name;
  }
}

TEST_F(Records, devicesSayUsableOrWhyNot) {
  const json record = onStdout({"devices", "--json", "-"});
  expectHead(record, "devices");
  ASSERT_FALSE(record["devices"].empty());
  for (const json& device : record["devices"]) {
    EXPECT_EQ(device["usable"].get<bool>(), device["refusals"].empty()) << device["name"];
    EXPECT_GT(device["limits"]["maxImageSize"], 0) << device["name"];
  }
}

TEST_F(Records, namesFromAFileDoNotSteerTheTerminal) {
  write("names.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"name": "a\u001b[2Jb", "nodes": [0]}],
    "nodes": [{"camera": 0}],
    "cameras": [{"type": "perspective", "name": "c\u0007d", "perspective": {"yfov": 1, "znear": 0.1}}]})");
  const Outcome outcome = run({"info", "names.gltf"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::HasSubstr("a?[2Jb"));
  EXPECT_THAT(outcome.out, testing::HasSubstr("c?d"));
  EXPECT_EQ(outcome.out.find_first_of("\x1b\x07"), std::string::npos);
}

TEST_F(Records, ofATableForPeopleHaveTheSameFacts) {
  const std::string table = run({"info", scene()}).out;
  const json s = onStdout({"info", scene(), "--json", "-"})["scene"];
  EXPECT_THAT(table, testing::HasSubstr(std::to_string(s["counts"]["triangles"].get<int>()) + " triangles"));
}

}  // namespace
}  // namespace crosslight::test

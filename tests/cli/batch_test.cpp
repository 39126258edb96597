// A batch draws what its items say, each with the bits of a run of its own, and tells exactly which of them failed.
#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace crosslight::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Batches = CliTest;

const std::string kMirrors = CROSSLIGHT_SOURCE_DIR "/scenes/showcase/spheres_checker.gltf";

TEST_F(Batches, itemsHaveTheBytesOfSingleRuns) {
  const json items = {
      {{"scene", scene()}, {"output", "a.exr"}, {"method", "phong"}, {"aov", "all"}, {"spp", 2}},
      {{"scene", kMirrors}, {"output", "b.exr"}, {"method", "whitted"}, {"resolution", "40x30"}},
      // The same scene from the same place: what is on the device is used again, with other settings.
      {{"scene", kMirrors}, {"output", "c.exr"}, {"method", "whitted"}, {"set", {"shadows=off"}}, {"max-depth", 1}},
      {{"scene", kMirrors}, {"output", "d.exr"}, {"method", "whitted"}, {"spp", 3}, {"seed", 7}, {"aov", "normal"}},
      {{"scene", scene()}, {"output", "e.png"}, {"turn", 30}, {"alpha", true}},
  };
  write("batch.json", items.dump());
  const Outcome outcome = run({"render", "--batch", "batch.json", "-r", "32x24", "--json", "batch_record.json"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  for (const json& item : items) {
    const std::string batched = read(item["output"]);
    std::vector<std::string> arguments = {"render", item["scene"], "-o", item["output"]};
    if (!item.contains("resolution")) arguments.insert(arguments.end(), {"-r", "32x24"});
    for (const auto& [key, value] : item.items()) {
      if (key == "scene" || key == "output") continue;
      arguments.push_back("--" + key);
      if (value.is_array()) arguments.push_back(value[0]);
      if (value.is_number()) arguments.push_back(value.dump());
      if (value.is_string()) arguments.push_back(value);
    }
    ASSERT_EQ(run(arguments).exitCode, 0) << testing::PrintToString(arguments);
    EXPECT_TRUE(batched == read(item["output"])) << item["output"] << " has other bytes alone";
  }
  const json record = json::parse(read("batch_record.json"));
  ASSERT_EQ(record["items"].size(), 5u);
  EXPECT_EQ(record["summary"], json({{"items", 5}, {"done", 5}, {"failed", 0}, {"skipped", 0}, {"exitCode", 0}}));
  EXPECT_THAT(record["items"][1]["reused"], IsEmpty());
  EXPECT_EQ(record["items"][2]["reused"], json({"scene"}));
  for (const json& item : record["items"]) EXPECT_GT(item["timings"]["totalMs"], 0) << item["output"];
}

TEST_F(Batches, linesAndStandardInputWorkToo) {
  const json item = {{"scene", scene()}, {"output", "a.png"}};
  write("lines", item.dump() + "\n\n" + R"({"output": "b.png", "method": "flat"})" + "\n");
  const std::string line = std::string("cd '") + folder_.string() + "' && '" + CROSSLIGHT_BINARY_DIR +
                           "/crosslight' render '" + scene() + "' -r 8x8 -q --json - --batch - < lines > record";
  ASSERT_EQ(std::system(line.c_str()), 0);
  const json record = json::parse(read("record"));
  EXPECT_EQ(record["items"][0]["method"], "phong");
  EXPECT_EQ(record["items"][1]["method"], "flat");
  EXPECT_EQ(record["items"][1]["scene"]["file"], scene()) << "the command line's scene holds for items without one";
}

TEST_F(Batches, mistakesInTheFileAreThreeAndDrawNothing) {
  struct Case {
    std::string text;
    std::vector<std::string> said;
  };
  const std::string good = json({{"scene", scene()}, {"output", "good.png"}}).dump();
  const std::vector<Case> cases = {
      {"[" + good + R"(, {"scene": "x", "outptu": "y.png"}])",
       {"/1", "unknown key 'outptu'", "Did you mean 'output'?"}},
      {good + "\n" + R"({"output": "b.png", "method": "fong"})", {"line 2", "unknown method 'fong'", "'phong'"}},
      {"[" + good + R"(, {"output": "b.png", "spp": 0}])", {"/1", "'0' is not a whole number"}},
      {"[" + good + R"(, {"output": "b.png", "alpha": 1}])", {"/1/alpha", "true or false"}},
      {"[" + good + R"(, {"output": "b.png", "spp": true}])", {"/1/spp", "string or a number"}},
      {"[" + good + R"(, {"output": "b.png", "spp": {}}])", {"/1/spp", "string or a number"}},
      {"[" + good + R"(, {"output": "b.png", "device": "0"}])", {"/1/device", "command line"}},
      {"[" + good + R"(, {"output": "b.jpg"}])", {"item 2", ".png"}},
      {"[" + good + R"(, {"output": "b.png", "json": "-"}])", {"/1/json", "name a file"}},
      {"[" + good + ", 7]", {"/1", "no JSON object"}},
      {"[" + good + ", " + good + "]", {"item 2", "good.png", "item 1"}},
      {"[" + good, {"not valid JSON"}},
      {"", {"no items"}},
      {"[]", {"no items"}},
  };
  for (const Case& item : cases) {
    write("batch.json", item.text);
    const Outcome outcome = run({"render", scene(), "--batch", "batch.json"});
    EXPECT_EQ(outcome.exitCode, 3) << item.text << "\n" << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("batch.json"));
    for (const std::string& words : item.said) EXPECT_THAT(outcome.err, HasSubstr(words)) << item.text;
    EXPECT_THAT(files(), ElementsAre("batch.json"));
  }
  EXPECT_EQ(run({"render", "--batch", "missing.json"}).exitCode, 3);
}

TEST_F(Batches, oneFailureDoesNotStopTheOthersUnlessAsked) {
  const json items = {{{"scene", scene()}, {"output", "a.png"}},
                      {{"scene", "missing.gltf"}, {"output", "b.png"}},
                      {{"scene", scene()}, {"output", "c.png"}, {"camera", "nobody"}},
                      {{"scene", scene()}, {"output", "nofolder/d.png"}},
                      {{"scene", scene()}, {"output", "e.png"}}};
  write("batch.json", items.dump());
  const Outcome outcome = run({"render", "--batch", "batch.json", "-r", "8x8", "--json", "record.json"});
  EXPECT_EQ(outcome.exitCode, 3) << "the first failure is a missing file";
  for (const char* words : {"missing.gltf", "nobody", "nofolder", "3 of 5 items failed"}) {
    EXPECT_THAT(outcome.err, HasSubstr(words));
  }
  EXPECT_THAT(files(), ElementsAre("a.png", "batch.json", "e.png", "record.json"));
  const json record = json::parse(read("record.json"));
  std::vector<int> codes;
  for (const json& item : record["items"]) codes.push_back(item["exitCode"]);
  EXPECT_THAT(codes, ElementsAre(0, 3, 2, 3, 0));
  EXPECT_EQ(record["summary"]["exitCode"], 3);
  EXPECT_THAT(record["items"][1]["error"].get<std::string>(), HasSubstr("does not exist"));

  std::filesystem::remove(path("a.png"));
  std::filesystem::remove(path("e.png"));
  const Outcome stopped = run({"render", "--batch", "batch.json", "-r", "8x8", "--stop-on-error", "--json", "-"});
  EXPECT_EQ(stopped.exitCode, 3);
  EXPECT_EQ(json::parse(stopped.out)["summary"]["skipped"], 3);
  EXPECT_THAT(files(), ElementsAre("a.png", "batch.json", "record.json"));
}

TEST_F(Batches, aMissingDeviceFailsEveryItemWithFour) {
  write("batch.json",
        json({{{"scene", scene()}, {"output", "a.png"}}, {{"scene", scene()}, {"output", "b.png"}}}).dump());
  const Outcome outcome = run({"render", "--batch", "batch.json", "--device", "nosuch"});
  EXPECT_EQ(outcome.exitCode, 4) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("2 of 2 items failed"));
  EXPECT_THAT(files(), ElementsAre("batch.json"));
}

}  // namespace
}  // namespace crosslight::test

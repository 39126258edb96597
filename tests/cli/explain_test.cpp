// `crosslight explain` says what a scene calls for, for people and as JSON, and measures it.
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/program.h"

namespace crosslight::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::string sceneNamed(const std::string& name) {
  return std::string(CROSSLIGHT_SOURCE_DIR) + "/scenes/" + name + ".gltf";
}

class Explain : public CliTest {};

json effectOf(const json& record, const std::string& name) {
  for (const json& effect : record["effects"]) {
    if (effect["name"] == name) return effect;
  }
  return {};
}

TEST_F(Explain, quickNamesTheObjectsAndDrawsNothing) {
  const Outcome outcome = run({"explain", sceneNamed("feature/mirror"), "-m", "whitted", "--quick"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              HasSubstr("material 'mirror' reflects like a mirror (reflectionFactor 0.9) on sphere 'ball', "
                        "in view"));
  EXPECT_THAT(outcome.out, HasSubstr("only material 'mirror' on sphere 'ball' mirrors, and never its own rays"));
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120u) << line;
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("costs")));
}

TEST_F(Explain, measuresWhatIsOnAndComparesThePlans) {
  const Outcome outcome =
      run({"explain", sceneNamed("feature/fog_exp"), "-r", "24x16", "--rounds", "2", "--json", "-"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_THAT(outcome.err, testing::Not(HasSubstr("left out because asked")));
  const json record = json::parse(outcome.out);
  EXPECT_EQ(record["command"], "explain");
  const json fog = effectOf(record, "fog");
  EXPECT_TRUE(fog["on"]);
  EXPECT_GT(fog["error"]["max"], 0.01);
  EXPECT_GT(fog["cost"]["ratio"], 0.0);
  EXPECT_LE(fog["cost"]["ci95"][0], fog["cost"]["ci95"][1]);
  const json mirror = effectOf(record, "reflection");
  EXPECT_FALSE(mirror["on"]);
  EXPECT_TRUE(mirror["cost"].is_null());
  EXPECT_EQ(mirror["error"]["max"], 0.0);
  EXPECT_GT(record["full"]["pipelines"].size(), 0u);
  for (const char* plan : {"specialized", "full"}) {
    for (const json& pipeline : record[plan]["pipelines"]) EXPECT_GT(pipeline["bytes"], 0) << pipeline;
  }
}

TEST_F(Explain, heedsWhatIsForcedAndRefusesWhatIsUnknown) {
  const Outcome forced = run({"explain", sceneNamed("feature/fog_exp"), "--quick", "--effects", "-fog", "--json", "-"});
  ASSERT_EQ(forced.exitCode, 0) << forced.err;
  const json fog = effectOf(json::parse(forced.out), "fog");
  EXPECT_FALSE(fog["on"]);
  EXPECT_TRUE(fog["leftOut"]);
  EXPECT_THAT(fog["reason"], HasSubstr("left out because asked: the scene has fog"));
  const Outcome unknown = run({"explain", scene(), "--effects", "-fogg"});
  EXPECT_EQ(unknown.exitCode, 2);
  EXPECT_THAT(unknown.err, HasSubstr("Did you mean 'fog'?"));
  EXPECT_EQ(run({"explain", "absent.gltf", "--quick"}).exitCode, 3);
}

TEST_F(Explain, renderWarnsAndRecordsWhatIsForced) {
  const Outcome outcome = run({"render", sceneNamed("feature/fog_exp"), "-o", "a.png", "-r", "20x10", "--effects",
                               "-fog,+shadows", "--json", "-"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("the image is not the scene's: left out because asked, though called for: fog"));
  const json plan = json::parse(outcome.out)["plan"];
  EXPECT_EQ(plan["forced"], json({"-fog", "+shadows"}));
  EXPECT_TRUE(plan.contains("rayDepth"));
}

}  // namespace
}  // namespace crosslight::test

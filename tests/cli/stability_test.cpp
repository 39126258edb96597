// `crosslight stability` runs hard cases, for people, as JSON and as a page.
#include <nlohmann/json.hpp>
#include <regex>

#include "cli/program.h"

namespace crosslight::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class Stability : public CliTest {};

TEST_F(Stability, runsOneCaseAndSaysWhatIsHardGotAndExpected) {
  const Outcome outcome = run({"stability", "--case", "R17"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("R17  thin fog: pass"));
  EXPECT_THAT(outcome.out, HasSubstr("1 - exp(-x) keeps no digit"));
  EXPECT_THAT(outcome.out, HasSubstr("got "));
  EXPECT_THAT(outcome.out, HasSubstr("expected "));
  EXPECT_THAT(outcome.out, HasSubstr("bound: "));
  EXPECT_THAT(outcome.out, HasSubstr("1 cases: 1 pass, 0 fail"));
}

TEST_F(Stability, recordsEveryFigureAndWhatIsNotRun) {
  const Outcome outcome = run({"stability", "--case", "[TG]1", "--json", "-"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const json record = json::parse(outcome.out);
  EXPECT_EQ(record["command"], "stability");
  EXPECT_GT(record["probe"]["functions"].size(), 10u);
  EXPECT_TRUE(record["probe"]["facts"].contains("dotOrder"));
  std::set<std::string> techniques;
  bool furnace = false;
  for (const json& c : record["cases"]) {
    if (c["id"] == "T1") {
      techniques.insert(c["technique"]);
      for (const char* field : {"name", "what", "got", "expected", "bound", "source", "verdict"})
        EXPECT_TRUE(c.contains(field)) << field;
      EXPECT_EQ(c["verdict"], "pass");
    }
    furnace = furnace || (c["id"] == "G1" && c["verdict"] == "not-applicable" && c.contains("reason"));
  }
  EXPECT_EQ(techniques, (std::set<std::string>{"phong", "whitted"}));
  EXPECT_TRUE(furnace);
}

TEST_F(Stability, writesOnePageThatNeedsNoOtherFile) {
  const Outcome outcome = run({"stability", "--case", "T21", "-o", "report/deep", "--quiet"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const std::string page = read("report/deep/stability.html");
  EXPECT_THAT(page, HasSubstr("<h2 id=\"T21\">"));
  EXPECT_THAT(page, HasSubstr("src=\"data:image/png;base64,iVBOR"));
  EXPECT_THAT(page, HasSubstr("The platform"));
  EXPECT_FALSE(std::regex_search(page, std::regex("(src|href)=\"(?!data:)"))) << "the page refers to other files";
  EXPECT_THAT(files(), testing::ElementsAre("report"));
}

TEST_F(Stability, probesWithoutRunningCases) {
  const Outcome outcome = run({"stability", "--probe"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("does fma() round once"));
  EXPECT_THAT(outcome.out, HasSubstr("pow(x, y)"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("cases:")));
}

TEST_F(Stability, refusesWhatIsNotThere) {
  const Outcome unknown = run({"stability", "--case", "Q*"});
  EXPECT_EQ(unknown.exitCode, 2);
  EXPECT_THAT(unknown.err, HasSubstr("there are R1, R2, "));
  write("file", "");
  EXPECT_EQ(run({"stability", "--case", "R17", "-o", "file/folder"}).exitCode, 3);
  EXPECT_EQ(run({"stability", "--case", "R17", "--json", "absent/a.json"}).exitCode, 3);
  EXPECT_EQ(run({"stability", "--device", "99", "--case", "R17"}).exitCode, 4);
}

}  // namespace
}  // namespace crosslight::test

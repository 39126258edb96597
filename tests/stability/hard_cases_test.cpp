// Every case of the catalog on this device: its figures keep their bounds, and the textbook's formula, evaluated in
// single precision on the same input, does not: a case that it passes too proves nothing.
#include <algorithm>
#include <map>

#include "app/study_draw.h"
#include "study/platform.h"
#include "study/stability.h"
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

using study::HardCase;
using study::JudgedCase;
using study::Measurement;
using study::Verdict;

std::string describe(const Measurement& m) {
  return m.technique + ", " + m.what + ": got " + std::to_string(m.got) + ", expected " + std::to_string(m.expected) +
         ", error " + std::to_string(m.error) + " " + m.unit + ", bound " + std::to_string(m.bound) + ", of " +
         std::to_string(m.compared) + " compared";
}

class HardCases : public ::testing::TestWithParam<std::size_t> {
 protected:
  const HardCase& hardCase() const { return study::hardCases()[GetParam()]; }
};

TEST_P(HardCases, keepTheirBoundsWhereTheTextbookDoesNot) {
  RenderSession session(device());
  const study::Bench bench{device(), drawBy(session)};
  const JudgedCase judged = study::runCases(bench, {&hardCase()}, {})[0];
  ASSERT_FALSE(judged.result.measurements().empty());
  bool textbookFails = false, textbookAsked = false;
  for (const Measurement& m : judged.result.measurements()) {
    EXPECT_GT(m.compared, 0u) << describe(m);
    if (hardCase().expectedFailure == nullptr) {
      EXPECT_TRUE(m.holds()) << describe(m);
    }
    textbookAsked = textbookAsked || m.naive.has_value();
    textbookFails = textbookFails || (m.naive && !m.naiveHolds());
  }
  if (hardCase().expectedFailure != nullptr) {
    EXPECT_EQ(judged.verdict(), Verdict::expectedFail) << "healed: " << hardCase().expectedFailure;
  }
  if (hardCase().noNaive == nullptr) {
    EXPECT_TRUE(textbookFails) << (textbookAsked ? "the textbook's formula passes too" : "no formula to compare with");
  }
}

INSTANTIATE_TEST_SUITE_P(Catalog, HardCases, ::testing::Range(std::size_t{0}, study::hardCases().size()),
                         [](const auto& i) {
                           return std::string(study::hardCases()[i.param].id) + "number" + std::to_string(i.param);
                         });

TEST(HardCaseCatalog, namesEveryCaseAsRunOrNot) {
  const std::map<char, int> counts{{'R', 20}, {'I', 21}, {'T', 26}, {'X', 4}, {'M', 4}, {'G', 12}};
  std::map<std::string, int> run, listed;
  for (const HardCase& c : study::hardCases()) ++run[c.id];
  for (const study::Uncovered& u : study::uncoveredCases()) ++listed[u.id];
  std::size_t all = 0;
  for (const auto& [letter, count] : counts) {
    for (int i = 1; i <= count; ++i, ++all) {
      const std::string id = letter + std::to_string(i);
      EXPECT_EQ((run.contains(id) ? 1 : 0) + listed[id], 1) << id;
    }
  }
  EXPECT_EQ(all, 87u);
  for (const auto& [id, count] : run) EXPECT_TRUE(counts.contains(id[0])) << id;
  EXPECT_EQ(run.size() + std::count_if(listed.begin(), listed.end(), [](const auto& l) { return l.second > 0; }), all);
}

TEST(HardCaseCatalog, isChosenFromByIdAndName) {
  EXPECT_EQ(study::casesFor("R17", false).size(), 1u);
  EXPECT_GT(study::casesFor("T*", false).size(), 5u);
  EXPECT_GE(study::casesFor("I21", false).size(), 1u);  // not of the default set, but asked for
  EXPECT_TRUE(study::casesFor("Q1", false).empty());
  EXPECT_EQ(study::casesFor("", true).size(), study::hardCases().size());
  EXPECT_LT(study::casesFor("", false).size(), study::hardCases().size());
}

HardCase caseKnownToFail(const char* reason) {
  HardCase c{};
  c.id = "Z1";
  c.expectedFailure = reason;
  return c;
}

TEST(HardCaseVerdict, failsBeyondTheBoundAndOnWhatIsNoNumber) {
  const HardCase plain = caseKnownToFail(nullptr), known = caseKnownToFail("a reason");
  study::Worst good, bad, none;
  good.addAbsolute(1.0, 1.5);
  bad.addAbsolute(std::nan(""), 1.0);
  bad.addAbsolute(1.0, 1.0);
  const auto verdict = [](const HardCase& c, const study::Worst& worst, double bound) {
    JudgedCase judged;
    judged.hardCase = &c;
    judged.result.measure("host", "something", worst, bound, "absolute");
    return judged.verdict();
  };
  EXPECT_EQ(verdict(plain, good, 0.5), Verdict::pass);
  EXPECT_EQ(verdict(plain, good, 0.4), Verdict::fail);
  EXPECT_EQ(verdict(known, good, 0.4), Verdict::expectedFail);
  EXPECT_EQ(verdict(known, good, 0.5), Verdict::pass);
  EXPECT_EQ(verdict(plain, bad, 1e9), Verdict::fail);
  EXPECT_EQ(verdict(plain, none, 1.0), Verdict::fail);  // nothing was compared
  JudgedCase empty;
  empty.hardCase = &plain;
  EXPECT_EQ(empty.verdict(), Verdict::fail);
}

TEST(PlatformProbe, findsFunctionsWithinWhatVulkanPermits) {
  const study::Platform platform = study::probePlatform(device());
  EXPECT_EQ(platform.functions.size(), 14u);
  for (const study::FunctionPrecision& f : platform.functions) {
    EXPECT_TRUE(f.holds()) << f.name << ": " << f.worstShare << " of what is permitted, at " << f.x << ", " << f.y;
    EXPECT_GT(f.samples, 10000u) << f.name;
    EXPECT_GT(f.worstAbsolute, 0.0) << f.name;
  }
  std::map<std::string, std::string> facts;
  for (const study::PlatformFact& f : platform.facts) facts[f.name] = f.answer;
  // Every module is decorated so: on any device.
  EXPECT_EQ(facts.at("contraction"), "no");
  EXPECT_EQ(facts.at("reassociation"), "no");
  EXPECT_TRUE(facts.contains("fusedMultiplyAdd") && facts.contains("powerOfZeroToZero") && facts.contains("dotOrder"));
}

}  // namespace
}  // namespace crosslight::testing

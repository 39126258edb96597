#include "app/progress.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace crosslight {
namespace {

using testing::HasSubstr;

TEST(Progress, drawsABarOnATerminalOnly) {
  EXPECT_EQ(progressModeOf("auto", true), ProgressMode::bar);
  EXPECT_EQ(progressModeOf("auto", false), ProgressMode::none);
  EXPECT_EQ(progressModeOf("bar", true), ProgressMode::bar);
  EXPECT_EQ(progressModeOf("bar", false), ProgressMode::plain);
  EXPECT_EQ(progressModeOf("plain", true), ProgressMode::plain);
  EXPECT_EQ(progressModeOf("none", true), ProgressMode::none);
}

TEST(Progress, plainSaysEveryTenthOnce) {
  std::vector<std::string> lines;
  Progress progress("phong", ProgressMode::plain, [&lines](const std::string& text) { lines.push_back(text); });
  for (std::uint64_t done = 0; done <= 1000; ++done) progress.update(done, 1000);
  ASSERT_EQ(lines.size(), 10u);
  EXPECT_THAT(lines.front(), HasSubstr("phong 10 %"));
  EXPECT_THAT(lines.back(), HasSubstr("phong 100 %"));
  for (const std::string& line : lines) {
    EXPECT_EQ(line.back(), '\n');
    EXPECT_EQ(line.find('\r'), std::string::npos);
  }
}

TEST(Progress, plainSkipsTenthsThatPassedTogether) {
  std::vector<std::string> lines;
  Progress progress("phong", ProgressMode::plain, [&lines](const std::string& text) { lines.push_back(text); });
  progress.update(1, 2);
  progress.update(2, 2);
  EXPECT_EQ(lines.size(), 2u);
}

TEST(Progress, noneSaysNothingAndAnEmptyTaskDoesNotDivide) {
  int calls = 0;
  {
    Progress progress("phong", ProgressMode::none, [&calls](const std::string&) { ++calls; });
    progress.update(5, 10);
  }
  {
    Progress progress("phong", ProgressMode::plain, [&calls](const std::string&) { ++calls; });
    progress.update(0, 0);
  }
  EXPECT_EQ(calls, 0);
}

TEST(Progress, shortTasksShowNoBarAndLeaveNoTrace) {
  std::string written;
  {
    Progress progress("phong", ProgressMode::bar, [&written](const std::string& text) { written += text; });
    progress.update(1, 2);
    progress.update(2, 2);
  }
  EXPECT_EQ(written, "");
}

TEST(Progress, barIsTakenAwayAtTheEnd) {
  std::string written;
  {
    Progress progress("phong", ProgressMode::bar, [&written](const std::string& text) { written += text; });
    const Stopwatch watch;
    while (written.empty() && watch.elapsedMs() < 10000) progress.update(1, 2);
    EXPECT_THAT(written, HasSubstr("50 %"));
  }
  EXPECT_THAT(written, testing::EndsWith("\r\033[K"));
}

}  // namespace
}  // namespace crosslight

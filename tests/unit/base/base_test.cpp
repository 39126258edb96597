// Checks, hashing, the log and the interrupt flag: what every room relies on without looking.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <functional>
#include <limits>
#include <thread>

#include "base/check.h"
#include "base/hash.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/time.h"

namespace crosslight {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const InternalError& error) {
    EXPECT_EQ(error.code(), ExitCode::internal);
    return error.what();
  }
  return "";
}

TEST(Check, PrintsTheConditionBothValuesAndThePlace) {
  const int width = 3;
  EXPECT_THAT(messageOf([&] { CL_CHECK_EQ(width, 4); }),
              AllOf(HasSubstr("width == 4"), HasSubstr("3 and 4"), HasSubstr("base_test.cpp:")));
  EXPECT_THAT(messageOf([&] { CL_CHECK(width > 5); }), HasSubstr("width > 5"));
  EXPECT_THAT(messageOf([&] { CL_CHECK_LT(width, 3); }), HasSubstr("width < 3"));
  EXPECT_EQ(messageOf([&] { CL_CHECK_LE(width, 3); }), "");
}

TEST(Check, EvaluatesItsArgumentsOnce) {
  int calls = 0;
  CL_CHECK_EQ(++calls, 1);
  CL_CHECK_LE(++calls, 2);
  EXPECT_EQ(calls, 2);
}

TEST(Check, FailsOnNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(messageOf([&] { CL_CHECK_LE(nan, 1.0); }), "");
  EXPECT_NE(messageOf([&] { CL_CHECK_EQ(nan, nan); }), "");
}

TEST(Errors, CarryTheExitCodesOfTheCommandLine) {
  EXPECT_EQ(static_cast<int>(UsageError("").code()), 2);
  EXPECT_EQ(static_cast<int>(InputError("", "").code()), 3);
  EXPECT_EQ(static_cast<int>(DeviceError("").code()), 4);
  EXPECT_EQ(static_cast<int>(InternalError("").code()), 5);
  EXPECT_EQ(static_cast<int>(Interrupted().code()), 130);
  EXPECT_STREQ(InputError("a.gltf: /meshes/0", "has no primitives").what(), "a.gltf: /meshes/0: has no primitives");
}

std::uint64_t hashOf(const std::string& text) { return hashBytes(std::as_bytes(std::span(text.data(), text.size()))); }

// Test vectors of the FNV authors (Fowler, Noll, Vo; draft-eastlake-fnv, appendix C).
TEST(Hash, IsFnv1a) {
  EXPECT_EQ(hexOf(hashOf("")), "cbf29ce484222325");
  EXPECT_EQ(hexOf(hashOf("a")), "af63dc4c8601ec8c");
  EXPECT_EQ(hexOf(hashOf("foobar")), "85944171f73967e8");
  EXPECT_EQ(hexOf(0xfu), "000000000000000f");
}

TEST(Hash, ContinuesFromAnEarlierPart) {
  const std::string text = "foobar";
  const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
  EXPECT_EQ(hashBytes(bytes.subspan(3), hashBytes(bytes.first(3))), hashBytes(bytes));
}

class LogTest : public ::testing::Test {
 protected:
  ~LogTest() override { setLogLevel(LogLevel::normal); }
};

TEST_F(LogTest, SaysAWarningOnceAndRemembersItInOrder) {
  const std::size_t before = loggedWarnings().size();
  ::testing::internal::CaptureStderr();
  logWarning("the first thing");
  logWarning("the second thing");
  logWarning("the first thing");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(),
            "crosslight: warning: the first thing\ncrosslight: warning: the second thing\n");
  const auto warnings = loggedWarnings();
  ASSERT_EQ(warnings.size(), before + 2);
  EXPECT_EQ(warnings[before], "the first thing");
  EXPECT_EQ(warnings[before + 1], "the second thing");
}

TEST_F(LogTest, KeepsQuietWhatItsLevelKeepsQuiet) {
  const auto printedAt = [](LogLevel level, const std::string& unique) {
    setLogLevel(level);
    ::testing::internal::CaptureStderr();
    logInfo("info");
    logVerbose("detail");
    logWarning("warning " + unique);
    logError("error");
    return ::testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(printedAt(LogLevel::quiet, "q"), "crosslight: error: error\n");
  EXPECT_EQ(printedAt(LogLevel::normal, "n"),
            "crosslight: info\ncrosslight: warning: warning n\ncrosslight: error: error\n");
  EXPECT_EQ(printedAt(LogLevel::verbose, "v"),
            "crosslight: info\ncrosslight: detail\ncrosslight: warning: warning v\ncrosslight: error: error\n");
  EXPECT_THAT(loggedWarnings(), ::testing::Contains("warning q")) << "a quiet warning still goes into the record";
}

TEST_F(LogTest, TakesWarningsFromManyThreadsAtOnce) {
  setLogLevel(LogLevel::quiet);
  const std::size_t before = loggedWarnings().size();
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([] {
        for (int i = 0; i < 200; ++i) logWarning("parallel " + std::to_string(i));
      });
    }
  }
  EXPECT_EQ(loggedWarnings().size(), before + 200);
}

// In a process of its own: the flag cannot be taken back.
TEST(InterruptDeathTest, OneSignalSetsTheFlagAndTheSecondEndsTheProcess) {
  const auto afterOne = [](int signal) {
    installInterruptHandler();
    throwIfInterrupted();
    std::raise(signal);
    try {
      throwIfInterrupted();
    } catch (const Interrupted& error) {
      std::_Exit(interruptRequested() ? static_cast<int>(error.code()) : 1);
    }
    std::_Exit(1);
  };
  EXPECT_EXIT(afterOne(SIGINT), ::testing::ExitedWithCode(130), "");
  EXPECT_EXIT(afterOne(SIGTERM), ::testing::ExitedWithCode(130), "");
  const auto afterTwo = [] {
    installInterruptHandler();
    std::raise(SIGINT);
    std::raise(SIGINT);
    std::_Exit(1);
  };
  EXPECT_EXIT(afterTwo(), ::testing::KilledBySignal(SIGINT), "");
}

TEST(StopwatchTest, CountsForwardAndLapsAddUp) {
  Stopwatch watch;
  const Stopwatch whole = watch;
  double laps = 0;
  for (int i = 0; i < 3; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const double lap = watch.lapMs();
    EXPECT_GE(lap, 2.0);
    laps += lap;
  }
  EXPECT_LE(laps, whole.elapsedMs());
}

}  // namespace
}  // namespace crosslight

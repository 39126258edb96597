// The timing protocol, with contenders whose times are known beforehand.
#include "bench/rounds.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "base/error.h"
#include "bench/cpu_time.h"

namespace crosslight::bench {
namespace {

// Another process that computes for as long as it lives.
class Burner {
 public:
  Burner() : process_(fork()) {
    if (process_ == 0) {
      for (volatile unsigned spins = 0;;) spins = spins + 1;
    }
  }
  ~Burner() {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  Burner(const Burner&) = delete;
  Burner& operator=(const Burner&) = delete;

 private:
  pid_t process_;
};

Measured sleepFor(const char* name, int ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(ms));
  return {{name, static_cast<double>(ms)}};
}

TEST(Rounds, ContendersTakeTurns) {
  std::string order;
  const Contender a = [&] { return order += 'a', Measured{{"a", 1.0}}; };
  const Contender b = [&] { return order += 'b', Measured{{"b", 2.0}}; };
  const Rounds rounds = interleave({a, b}, {.rounds = 3, .warmUps = 2, .shortestSeconds = 0});
  std::string expected;
  for (std::size_t i = 0; i < 2 + rounds.count + rounds.repeated; ++i) expected += "ab";
  EXPECT_EQ(order, expected);
}

TEST(Rounds, AreAsManyAsAskedForAndLeaveOutTheWarmUps) {
  double ms = 0;
  const Contender growing = [&] { return Measured{{"growing", ++ms}}; };
  const Rounds rounds = interleave({growing}, {.rounds = 4, .warmUps = 2, .shortestSeconds = 0});
  EXPECT_EQ(rounds.count, 4u);
  ASSERT_EQ(rounds.of("growing").size(), 4u);
  EXPECT_GT(rounds.of("growing").front(), 2.0);
}

TEST(Rounds, ShortContendersRunOftenAndTheMedianOfTheRunsCounts) {
  int runs = 0;
  // One run in three is disturbed: it would move a mean.
  const Contender some = [&] { return sleepFor("x", 1), Measured{{"x", runs++ % 3 == 2 ? 1000.0 : 2.0}}; };
  const Rounds rounds = interleave({some}, {.rounds = 1, .warmUps = 0, .shortestSeconds = 0.2});
  EXPECT_GT(runs, 2);
  EXPECT_EQ(rounds.of("x"), std::vector<double>{2.0});
}

TEST(Rounds, LoadOfOthersIsSeenAndRepeatsAreBounded) {
  if (!OtherCpuTimer().otherSeconds()) GTEST_SKIP() << "this system has no /proc/stat";
  const Burner burner;
  int runs = 0;
  const Contender idle = [&] { return ++runs, sleepFor("idle", 300); };
  const Rounds rounds = interleave({idle}, {.rounds = 2, .warmUps = 0, .shortestSeconds = 0});
  EXPECT_EQ(runs, 4);
  EXPECT_EQ(rounds.repeated, 2u);
  EXPECT_EQ(rounds.count, 2u);
  // The burner shares its CPU with whatever else runs: a tenth of the time is the least to expect.
  EXPECT_GT(rounds.otherCpuSeconds.value(), 0.1 * 2 * 0.3);
}

TEST(Rounds, NamesThatWereNotMeasuredAreRefused) {
  const Rounds rounds = interleave({[] {
                                     return Measured{{"x", 1.0}};
                                   }},
                                   {.rounds = 1, .warmUps = 0, .shortestSeconds = 0});
  EXPECT_THROW(rounds.of("y"), InternalError);
}

}  // namespace
}  // namespace crosslight::bench

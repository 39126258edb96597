// The threads of a build: every turn is taken once, and what one of them throws arrives.
#include "accel/bvh_team.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace crosslight::accel {
namespace {

TEST(Team, TakesEveryTurnOnce) {
  for (const std::uint32_t threads : {1u, 2u, 7u}) {
    Team team(threads);
    EXPECT_EQ(team.size(), threads);
    for (const std::uint32_t count : {0u, 1u, 2u, 5u, 1000u}) {
      for (int round = 0; round < 50; ++round) {
        std::vector<int> taken(count, 0);
        team.forEach(count, [&](std::uint32_t i) { ++taken[i]; });
        ASSERT_EQ(std::count(taken.begin(), taken.end(), 1), static_cast<std::ptrdiff_t>(count));
      }
    }
  }
}

TEST(Team, ThrowsWhatOneThreadThrewAndGoesOnAfterwards) {
  for (const std::uint32_t threads : {1u, 2u, 5u}) {
    Team team(threads);
    for (int round = 0; round < 50; ++round) {
      const auto body = [](std::uint32_t i) {
        if (i == 37) throw std::runtime_error("turn 37");
      };
      EXPECT_THROW(team.forEach(100, body), std::runtime_error);
      std::atomic<std::uint32_t> sum{0};
      team.forEach(100, [&](std::uint32_t i) { sum += i; });
      ASSERT_EQ(sum, 99u * 100u / 2);
    }
  }
}

TEST(Team, IsAsLargeAsThereIsWork) {
  EXPECT_EQ(usefulThreads(8, 0), 1u);
  EXPECT_EQ(usefulThreads(8, 100), 1u);
  EXPECT_EQ(usefulThreads(8, 10'000'000), 8u);
  EXPECT_EQ(usefulThreads(1, 10'000'000), 1u);
  EXPECT_GE(usefulThreads(0, 10'000'000), 1u);
}

}  // namespace
}  // namespace crosslight::accel

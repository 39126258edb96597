// Work shared out to threads covers every row once, and what one thread throws arrives.
#include "image/row_threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace crosslight {
namespace {

constexpr std::uint64_t kMany = 1u << 20;  // values per row: enough for a thread each

TEST(RowThreads, coverEveryRowOnce) {
  for (const std::uint32_t rows : {1u, 2u, 3u, 7u, 64u, 1000u}) {
    for (const std::uint64_t values : {std::uint64_t{1}, kMany}) {
      std::vector<std::atomic<int>> visits(rows);
      forRowRanges(rows, values, [&](std::uint32_t first, std::uint32_t end) {
        for (std::uint32_t row = first; row < end; ++row) ++visits[row];
      });
      for (std::uint32_t row = 0; row < rows; ++row) EXPECT_EQ(visits[row], 1) << row << " of " << rows;
    }
  }
}

TEST(RowThreads, areUsedForMuchWorkOnly) {
  const auto threadsOf = [](std::uint64_t valuesPerRow) {
    std::mutex mutex;
    std::set<std::thread::id> ids;
    forRowRanges(64, valuesPerRow, [&](std::uint32_t, std::uint32_t) {
      const std::scoped_lock lock(mutex);
      ids.insert(std::this_thread::get_id());
    });
    return ids.size();
  };
  EXPECT_EQ(threadsOf(1), 1u);
  EXPECT_EQ(threadsOf(kMany) > 1, std::thread::hardware_concurrency() > 1);
}

TEST(RowThreads, passExceptionsOn) {
  for (const std::uint32_t bad : {0u, 63u}) {
    const auto work = [bad](std::uint32_t first, std::uint32_t end) {
      if (first <= bad && bad < end) throw std::runtime_error("row");
    };
    EXPECT_THROW(forRowRanges(64, kMany, work), std::runtime_error) << bad;
  }
}

}  // namespace
}  // namespace crosslight

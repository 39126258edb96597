// Every row of a picture belongs to one part, and parts are alike in size.
#include "app/part.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace crosslight {
namespace {

TEST(PartRows, coverEveryRowOnceInOrder) {
  for (const std::uint32_t height : {1u, 2u, 7u, 53u, 64u, 480u, 1081u, 16384u}) {
    for (const std::uint32_t count : {1u, 2u, 3u, 7u, 16u, 64u}) {
      if (count > height) continue;
      std::vector<int> owners(height, 0);
      for (std::uint32_t index = 1; index <= count; ++index) {
        std::uint32_t next = 0;
        for (const Band& band : rowsOfPart({index, count}, height)) {
          EXPECT_GE(band.firstRow, next) << "not in order";
          EXPECT_GT(band.rowCount, 0u);
          next = band.firstRow + band.rowCount;
          ASSERT_LE(next, height);
          for (std::uint32_t row = band.firstRow; row < next; ++row) ++owners[row];
        }
        EXPECT_GT(next, 0u) << "part " << index << " of " << count << " of " << height << " rows is empty";
      }
      EXPECT_EQ(owners, std::vector<int>(height, 1)) << count << " parts of " << height << " rows";
    }
  }
}

// A run is at most 1/8 of a part: shares differ by one run, and none is one stretch of the picture.
TEST(PartRows, areSharedOutAlike) {
  for (const std::uint32_t count : {2u, 3u, 8u}) {
    std::uint32_t least = 4096, most = 0;
    for (std::uint32_t index = 1; index <= count; ++index) {
      std::uint32_t rows = 0;
      const std::vector<Band> bands = rowsOfPart({index, count}, 4096);
      for (const Band& band : bands) rows += band.rowCount;
      EXPECT_GE(bands.size(), 8u);
      least = std::min(least, rows);
      most = std::max(most, rows);
    }
    EXPECT_LE(most - least, 4096 / (8 * count)) << count;
  }
}

TEST(PartRows, ofOnePartAreAllInOneRun) {
  const std::vector<Band> rows = rowsOfPart({1, 1}, 1000);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].rowCount, 1000u);
}

TEST(PartRows, needARowForEachPart) { EXPECT_THROW(rowsOfPart({1, 9}, 8), UsageError); }

}  // namespace
}  // namespace crosslight

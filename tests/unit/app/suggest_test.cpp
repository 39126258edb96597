#include "app/suggest.h"

#include <gmock/gmock.h>

#include <vector>

namespace crosslight {
namespace {

TEST(Suggest, countsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(editDistance("phong", "phong"), 0u);
  EXPECT_EQ(editDistance("phong", "phon"), 1u);
  EXPECT_EQ(editDistance("fong", "phong"), 2u);
  EXPECT_EQ(editDistance("phogn", "phong"), 1u);  // neighbors swapped
  EXPECT_EQ(editDistance("", "box"), 3u);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3u);
}

TEST(Suggest, namesTheNearestAndNoStranger) {
  const std::vector<std::string> known = {"wireframe", "flat", "gouraud", "phong"};
  EXPECT_EQ(nearest("fong", known), "phong");
  EXPECT_EQ(nearest("Gouraud", known), "gouraud");
  EXPECT_EQ(nearest("gourad", known), "gouraud");
  EXPECT_FALSE(nearest("radiosity", known).has_value());
  EXPECT_FALSE(nearest("x", known).has_value());
}

TEST(Suggest, messageListsAllAndAsksForTheNearest) {
  const std::vector<std::string> known = {"box", "tent"};
  EXPECT_EQ(unknownWord("filter", "tend", known), "unknown filter 'tend'; there are box, tent. Did you mean 'tent'?");
  EXPECT_THAT(unknownWord("filter", "mitchell", known), testing::Not(testing::HasSubstr("Did you mean")));
}

}  // namespace
}  // namespace crosslight

// Text from files on its way to a terminal.
#include "base/text.h"

#include <gtest/gtest.h>

namespace crosslight {
namespace {

TEST(Printable, showsControlCharactersAsQuestionMarksAndKeepsTheRest) {
  EXPECT_EQ(printable("a\x1b[2Jb\x07"), "a?[2Jb?");
  EXPECT_EQ(printable("two\nlines"), "two\nlines");
  EXPECT_EQ(printable("gl\xc3\xa4sern \x7f"), "gl\xc3\xa4sern ?");
  EXPECT_EQ(printable(""), "");
}

}  // namespace
}  // namespace crosslight

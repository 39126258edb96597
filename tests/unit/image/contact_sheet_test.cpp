// The sheet: every picture is there with its own codes, captions are drawn and cut to fit, and nothing overlaps.
#include "image/contact_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"

namespace crosslight {
namespace {

Image filled(std::uint32_t width, std::uint32_t height, float r, float g, float b) {
  Image image = makeImage(width, height);
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    const float color[4] = {r, g, b, 1};
    std::copy_n(color, 4, image.picture().samples.begin() + static_cast<std::ptrdiff_t>(4 * i));
  }
  return image;
}

std::size_t pixelsOf(const DisplayPicture& sheet, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < sheet.codes.size(); i += 3) {
    count += sheet.codes[i] == r && sheet.codes[i + 1] == g && sheet.codes[i + 2] == b;
  }
  return count;
}

TEST(ContactSheet, ShowsEveryPictureWithItsOwnCodes) {
  const Image red = filled(100, 80, 1, 0, 0), green = filled(60, 80, 0, 1, 0), bright = filled(100, 40, 0, 0, 3);
  const SheetEntry entries[] = {
      {"red", "1 ms", &red, {}}, {"green", "", &green, {}}, {"blue", "", &bright, {.toneMap = ToneMap::reinhard}}};
  const DisplayPicture sheet = displayPicture(makeContactSheet(entries), {});
  EXPECT_EQ(pixelsOf(sheet, 255, 0, 0), 100u * 80u);
  EXPECT_EQ(pixelsOf(sheet, 0, 255, 0), 60u * 80u);
  EXPECT_EQ(pixelsOf(sheet, 0, 0, srgbCodeFromLinear(0.75f)), 100u * 40u);
}

TEST(ContactSheet, DrawsCaptionsInInkAndNotesPaler) {
  const Image picture = filled(200, 50, 1, 1, 1);
  const auto inkOf = [&](const char* caption, const char* note, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    const SheetEntry entry{caption, note, &picture, {}};
    return pixelsOf(displayPicture(makeContactSheet({&entry, 1}), {}), r, g, b);
  };
  EXPECT_EQ(inkOf("", "", 34, 34, 38), 0u);
  EXPECT_GT(inkOf("phong", "", 34, 34, 38), 100u);
  EXPECT_EQ(inkOf("phong", "", 112, 112, 118), 0u);
  EXPECT_GT(inkOf("phong", "3 ms", 112, 112, 118), 50u);
  EXPECT_GT(inkOf("phong phong", "", 34, 34, 38), inkOf("phong", "", 34, 34, 38));
}

TEST(ContactSheet, CutsTextThatIsTooLongAndSurvivesAnyCharacter) {
  const Image picture = filled(64, 64, 0, 0, 0);
  std::string every;
  for (int c = 1; c < 256; ++c) every += static_cast<char>(c);
  const SheetEntry entries[] = {{std::string(500, 'W'), every, &picture, {}}, {every, "", &picture, {}}};
  const Image sheet = makeContactSheet(entries, {.title = every + every, .columns = 2});
  // The margins hold nothing but paper: no text runs out of its cell.
  const DisplayPicture shown = displayPicture(sheet, {});
  for (std::uint32_t y = 0; y < shown.height; ++y) {
    for (const std::uint32_t x : {0u, 15u, shown.width - 16, shown.width - 1})
      ASSERT_EQ(shown.codes[3 * (y * shown.width + x)], 246);
  }
}

TEST(ContactSheet, AveragesLargePicturesInLinearLight) {
  Image checker = makeImage(64, 64);
  for (std::size_t i = 0; i < checker.pixels(); ++i) {
    const float value = static_cast<float>((i % 64 + i / 64) % 2);
    for (std::size_t c = 0; c < 3; ++c) checker.picture().samples[4 * i + c] = value;
  }
  const SheetEntry entry{"", "", &checker, {}};
  const DisplayPicture sheet = displayPicture(makeContactSheet({&entry, 1}, {.maxPictureSide = 32}), {});
  EXPECT_EQ(pixelsOf(sheet, 188, 188, 188), 32u * 32u);  // half the light, not half the code
}

TEST(ContactSheet, HasTheAskedColumnsOrAScreensShape) {
  const Image picture = filled(100, 100, 0, 0, 0);
  const std::vector<SheetEntry> entries(6, SheetEntry{"a", "", &picture, {}});
  const Image row = makeContactSheet(entries, {.columns = 6}), column = makeContactSheet(entries, {.columns = 1});
  EXPECT_GT(row.width, 5 * row.height / 2);
  EXPECT_GT(column.height, 4 * column.width);
  const Image automatic = makeContactSheet(entries);
  EXPECT_GT(automatic.width, automatic.height);
  EXPECT_LT(automatic.width, 2 * automatic.height);
  EXPECT_THROW(makeContactSheet({}), InternalError);
}

}  // namespace
}  // namespace crosslight

// sRGB as the standard has it (R16 of the hard cases), and tone maps by their fixed points and monotony.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "image/image_io.h"

namespace crosslight {
namespace {

// One rounding to float of a value below 1.
constexpr float kRounded = 0x1p-24f;

TEST(Srgb, HasTheStandardsValues) {
  EXPECT_EQ(srgbFromLinear(0), 0);
  EXPECT_EQ(srgbFromLinear(1), 1);
  EXPECT_EQ(linearFromSrgb(0), 0);
  EXPECT_EQ(linearFromSrgb(1), 1);
  EXPECT_NEAR(srgbFromLinear(0.5f), 0.735356983052449, kRounded);
  EXPECT_NEAR(srgbFromLinear(0.001f), 0.01292, kRounded);
  EXPECT_NEAR(linearFromSrgb(0.5f), 0.214041140482232, kRounded);
  EXPECT_EQ(srgbCodeFromLinear(0.5f), 188);
  EXPECT_EQ(srgbCodeFromLinear(0.18f), 118);  // 117.646
}

// The two pieces do not meet exactly: the power falls short of the line by 2.85e-8 at the encoder's threshold and
// exceeds it by 2.33e-9 at the decoder's. Both pieces are formed here in double, and the function must take the right
// one on either side.
TEST(Srgb, ChangesPiecesAtTheStandardsThresholds) {
  const auto power = [](double x) { return 1.055 * std::pow(x, 1 / 2.4) - 0.055; };
  EXPECT_NEAR(power(0.0031308) - 12.92 * 0.0031308, -2.85e-8, 5e-11);
  const float below = std::nextafter(0.0031308f, 0.0f), above = std::nextafter(0.0031308f, 1.0f);
  EXPECT_EQ(srgbFromLinear(below), static_cast<float>(12.92 * double{below}));
  EXPECT_EQ(srgbFromLinear(above), static_cast<float>(power(above)));
  const auto inverse = [](double x) { return std::pow((x + 0.055) / 1.055, 2.4); };
  EXPECT_NEAR(inverse(0.04045) - 0.04045 / 12.92, 2.33e-9, 5e-12);
  const float low = std::nextafter(0.04045f, 0.0f), high = std::nextafter(0.04045f, 1.0f);
  EXPECT_EQ(linearFromSrgb(low), static_cast<float>(double{low} / 12.92));
  EXPECT_EQ(linearFromSrgb(high), static_cast<float>(inverse(high)));
}

TEST(Srgb, BringsAll256CodesBack) {
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(srgbCodeFromLinear(linearFromSrgb(static_cast<float>(code) / 255.0f)), code);
  }
}

TEST(Srgb, TableGivesTheFormulasCodeRoundedHalfUp) {
  // Every 97th float from 0 to 1, which meets each of the table's buckets about 670 times.
  const std::uint32_t one = std::bit_cast<std::uint32_t>(1.0f);
  for (std::uint32_t bits = 0; bits <= one; bits += 97) {
    const float x = std::bit_cast<float>(bits);
    const double srgb = srgbFromLinear(x);
    const int code = srgbCodeFromLinear(x);
    ASSERT_EQ(code, static_cast<int>(std::floor(255.0 * srgb + 0.5))) << "linear " << x;
  }
}

TEST(Srgb, CodesErrByHalfACodeAtMost) {
  for (int i = 0; i <= 100000; ++i) {
    const float x = static_cast<float>(i) / 100000.0f;
    const double exact = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(double{x}, 1 / 2.4) - 0.055;
    // R16: half a code, and 2.1e-7 for a transfer function in single precision.
    ASSERT_LE(std::abs(srgbCodeFromLinear(x) / 255.0 - exact), 0.5 / 255 + 2.1e-7) << "linear " << x;
  }
}

TEST(Srgb, CodesClampWhatIsOutside) {
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(srgbCodeFromLinear(-1), 0);
  EXPECT_EQ(srgbCodeFromLinear(-inf), 0);
  EXPECT_EQ(srgbCodeFromLinear(2), 255);
  EXPECT_EQ(srgbCodeFromLinear(inf), 255);
  EXPECT_EQ(srgbCodeFromLinear(std::numeric_limits<float>::quiet_NaN()), 0);
}

float gray(float x, ToneMap toneMap) { return applyToneMap({x, x, x}, toneMap).g; }

TEST(ToneMapping, KeepsBlackAndNeverFalls) {
  for (const ToneMap toneMap : {ToneMap::none, ToneMap::clamp, ToneMap::reinhard, ToneMap::neutral}) {
    EXPECT_EQ(gray(0, toneMap), 0);
    float last = 0;
    for (float x = 1e-6f; x < 1e30f; x *= 1.01f) {
      const float y = gray(x, toneMap);
      // Near 1 neutral rounds four times per value: twice for the new peak, twice for the mix.
      ASSERT_GE(y, last - 2 * 4 * kRounded) << "at " << x;
      ASSERT_TRUE(toneMap == ToneMap::none || y <= 1.0f) << "at " << x;
      last = y;
    }
  }
}

TEST(ToneMapping, HasItsFixedPoints) {
  EXPECT_EQ(gray(7, ToneMap::none), 7);
  EXPECT_EQ(gray(-1, ToneMap::none), -1);
  EXPECT_EQ(gray(0.3f, ToneMap::clamp), 0.3f);
  EXPECT_EQ(gray(7, ToneMap::clamp), 1);
  EXPECT_EQ(gray(1, ToneMap::reinhard), 0.5f);
  EXPECT_EQ(gray(3, ToneMap::reinhard), 0.75f);
  // Neutral: from F90 * 2 = 0.08 to the start of compression, 0.8, it subtracts F90 = 0.04; below, x - (x - x^2/0.16).
  EXPECT_NEAR(gray(0.5f, ToneMap::neutral), 0.46f, 2 * kRounded);
  EXPECT_NEAR(gray(0.8f, ToneMap::neutral), 0.76f, 2 * kRounded);
  EXPECT_NEAR(gray(0.04f, ToneMap::neutral), 0.01f, 2 * kRounded);
  // Above: 1 - 0.24^2 / (peak + 0.24 - 0.76) with peak = 1.96.
  EXPECT_NEAR(gray(2, ToneMap::neutral), 1 - 0.0576 / 1.44, 4 * kRounded);
}

TEST(ToneMapping, NeutralKeepsHuesBelowCompressionAndWhitensAbove) {
  const Rgb dim = applyToneMap({0.6f, 0.3f, 0.1f}, ToneMap::neutral);
  EXPECT_NEAR(dim.r - dim.g, 0.3f, 2 * kRounded);
  EXPECT_NEAR(dim.g - dim.b, 0.2f, 2 * kRounded);
  const Rgb bright = applyToneMap({1000, 0, 0}, ToneMap::neutral);
  EXPECT_GT(bright.g, 0.9f);
  EXPECT_GE(bright.r, bright.g);
}

// A device reads the code of x out of the table by the rule that the header states.
TEST(CodeTable, GivesDevicesTheSameCodes) {
  const std::vector<std::uint32_t> table = displayCodeTable();
  const std::uint32_t one = std::bit_cast<std::uint32_t>(1.0f);
  ASSERT_EQ(table.size(), (one >> 16) + 1);
  const auto check = [&](std::uint32_t bits) {
    const std::uint32_t word = table[bits >> 16];
    const std::uint32_t code = (word >> 17) + ((bits & 0xffffu) >= (word & 0x1ffffu) ? 1 : 0);
    ASSERT_EQ(code, srgbCodeFromLinear(std::bit_cast<float>(bits))) << std::bit_cast<float>(bits);
  };
  for (std::uint32_t bits = 0; bits < one; bits += 97) check(bits);
  check(one);
  for (std::uint32_t code = 1; code < 256; ++code) {  // the last float below each step, and the first above
    std::uint32_t below = 0, above = one;
    while (above - below > 1) {
      const std::uint32_t middle = below + (above - below) / 2;
      (srgbCodeFromLinear(std::bit_cast<float>(middle)) >= code ? above : below) = middle;
    }
    check(below);
    check(above);
  }
}

TEST(CodeTable, IsForTransformsThatOnlyClamp) {
  EXPECT_TRUE(hasCodeTable({}));
  EXPECT_TRUE(hasCodeTable({.toneMap = ToneMap::none, .exposureStops = 3}));
  EXPECT_FALSE(hasCodeTable({.toneMap = ToneMap::reinhard}));
  EXPECT_FALSE(hasCodeTable({.toneMap = ToneMap::neutral}));
  EXPECT_FALSE(hasCodeTable({.withAlpha = true}));
}

TEST(ToneMapping, FollowsTheExposure) {
  Image image = makeImage(1, 1);
  image.picture().samples = {0.25f, 0.5f, 2.0f, 0.5f};
  const DisplayPicture shown =
      displayPicture(image, {.toneMap = ToneMap::clamp, .exposureStops = 1, .withAlpha = true});
  EXPECT_EQ(shown.codes, (std::vector<std::uint8_t>{188, 255, 255, 128}));  // alpha: floor(127.5 + 0.5), no exposure
}

}  // namespace
}  // namespace crosslight

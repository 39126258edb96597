// Metrics on images small enough to work out by hand.
#include "measure/metrics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

namespace crosslight {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

Image grayImage(std::uint32_t width, std::uint32_t height, const std::vector<float>& samples) {
  Image image;
  image.width = width;
  image.height = height;
  addLayer(image, "", {"Y"}).samples = samples;
  return image;
}

TEST(Metrics, HaveTheirClosedForms) {
  // Errors 0, 1, -2, 0.5 against references 0, 1, 2, 0.
  const Image got = grayImage(2, 2, {0, 2, 0, 0.5f}), reference = grayImage(2, 2, {0, 1, 2, 0});
  const Metrics m = measureImages(got, reference);
  ASSERT_TRUE(m.valid());
  EXPECT_EQ(m.values, 4u);
  EXPECT_DOUBLE_EQ(m.rmse, std::sqrt(5.25 / 4));
  EXPECT_DOUBLE_EQ(m.mae, 3.5 / 4);
  EXPECT_DOUBLE_EQ(m.maxAbs, 2);
  EXPECT_DOUBLE_EQ(m.relMse, (1 / 1.01 + 4 / 4.01 + 0.25 / 0.01) / 4);
  EXPECT_DOUBLE_EQ(m.psnrDb, 10 * std::log10(4 / 5.25));
  EXPECT_DOUBLE_EQ(measureImages(got, reference, {.peak = 255}).psnrDb, 10 * std::log10(255 * 255 * 4 / 5.25));
  EXPECT_EQ(m.worst.x, 0u);
  EXPECT_EQ(m.worst.y, 1u);
  EXPECT_EQ(m.worst.channel, "Y");
  EXPECT_EQ(m.worst.got, 0);
  EXPECT_EQ(m.worst.reference, 2);
  EXPECT_THAT(describe(m), ::testing::HasSubstr("worst at (0, 1) Y: 0 instead of 2"));
}

TEST(Metrics, OfEqualImagesAreZeroAndAnInfinitePsnr) {
  const Image image = grayImage(2, 1, {3, -4});
  const Metrics m = measureImages(image, image);
  EXPECT_EQ(m.rmse, 0);
  EXPECT_EQ(m.maxAbs, 0);
  EXPECT_EQ(m.relMse, 0);
  EXPECT_EQ(m.psnrDb, std::numeric_limits<double>::infinity());
}

TEST(Metrics, FailEveryBoundWhenAValueIsNotFinite) {
  const Image sound = grayImage(3, 1, {1, 2, 3});
  for (const float bad : {kNaN, kInf, -kInf}) {
    const Image broken = grayImage(3, 1, {100, bad, bad});
    for (const bool swapped : {false, true}) {
      const Metrics m = swapped ? measureImages(sound, broken) : measureImages(broken, sound);
      EXPECT_FALSE(m.valid());
      EXPECT_EQ(m.nonFinite, 2u);
      for (const double error : {m.rmse, m.mae, m.maxAbs, m.relMse}) EXPECT_TRUE(!(error <= 1e300));
      EXPECT_TRUE(!(m.psnrDb >= 0));
      EXPECT_EQ(m.worst.x, 1u) << "the first one is the witness";
      EXPECT_THAT(describe(m), ::testing::HasSubstr("invalid"));
    }
  }
  const Image bothInfinite = grayImage(1, 1, {kInf});
  EXPECT_FALSE(measureImages(bothInfinite, bothInfinite).valid());
}

TEST(Metrics, LeaveOutWhatTheMaskLeavesOut) {
  const Image got = grayImage(3, 1, {1, 9, kNaN}), reference = grayImage(3, 1, {0, 0, 0});
  const std::vector<std::uint8_t> mask{1, 0, 0}, nothing{0, 0, 0};
  const Metrics m = measureImages(got, reference, {.mask = mask});
  EXPECT_EQ(m.values, 1u);
  EXPECT_EQ(m.rmse, 1);
  const Metrics empty = measureImages(got, reference, {.mask = nothing});
  EXPECT_FALSE(empty.valid());
  EXPECT_TRUE(!(empty.rmse <= 1e300)) << "nothing compared proves nothing";
}

TEST(Metrics, PairChannelsByNameAndAlphaOnRequest) {
  Image rgba = makeImage(1, 1), bgr;
  rgba.picture().samples = {1, 2, 3, 0.5f};
  bgr.width = bgr.height = 1;
  addLayer(bgr, "", {"B", "G", "R"}).samples = {3, 2, 1.25f};
  const Metrics m = measureImages(rgba, bgr);
  EXPECT_EQ(m.values, 3u);
  EXPECT_EQ(m.maxAbs, 0.25);
  EXPECT_EQ(m.worst.channel, "R");
  EXPECT_THROW(measureImages(rgba, bgr, {.withAlpha = true}), InputError);
  EXPECT_EQ(measureImages(rgba, rgba, {.withAlpha = true}).values, 4u);
}

TEST(Metrics, MeasureNamedLayers) {
  Image a = makeImage(1, 1), b = makeImage(1, 1);
  addLayer(a, "depth", {"Z"}).samples = {4};
  addLayer(b, "depth", {"Z"}).samples = {5};
  EXPECT_EQ(measureImages(a, b, {.layer = "depth"}).maxAbs, 1);
}

TEST(Metrics, RefuseWhatCannotBeCompared) {
  const Image gray = grayImage(2, 1, {0, 0});
  EXPECT_THROW(measureImages(gray, grayImage(1, 2, {0, 0})), InputError) << "sizes";
  EXPECT_THROW(measureImages(gray, makeImage(2, 1)), InputError) << "channels";
  EXPECT_THROW(measureImages(makeImage(2, 1), gray), InputError) << "channels";
  EXPECT_THROW(measureImages(gray, gray, {.layer = "depth"}), InputError) << "layers";
  Image ids = gray;
  addIntegerLayer(ids, "id", {"instance"});
  EXPECT_THROW(measureImages(ids, ids, {.layer = "id"}), InputError) << "ids have no distance";
  EXPECT_THROW(idAgreement(ids, ids, "id", "material"), InputError);
  EXPECT_THROW(idAgreement(ids, gray, "id", "instance"), InputError);
  EXPECT_THROW(idAgreement(ids, ids, "", "Y"), InputError);
}

Image idImage(std::uint32_t width, const std::vector<std::uint32_t>& ids) {
  Image image = makeImage(width, static_cast<std::uint32_t>(ids.size()) / width);
  addIntegerLayer(image, "id", {"instance"}).integers = ids;
  return image;
}

TEST(IdAgreement, CountsPixelsWhoseNeighborhoodIsUniformInBothImages) {
  // 5 x 4: only (1..3, 1..2) have 3 x 3 pixels. An edge between columns 3 and 4 in one image leaves (1, y) and (2, y).
  const std::vector<std::uint32_t> uniform(20, 7);
  std::vector<std::uint32_t> edge = uniform;
  for (std::size_t y = 0; y < 4; ++y) edge[5 * y + 4] = 8;
  const IdAgreement all = idAgreement(idImage(5, uniform), idImage(5, uniform), "id", "instance");
  EXPECT_EQ(all.interior, 6u);
  EXPECT_EQ(all.share(), 1);
  EXPECT_FALSE(all.first);
  for (const bool swapped : {false, true}) {
    const IdAgreement part =
        idAgreement(idImage(5, swapped ? uniform : edge), idImage(5, swapped ? edge : uniform), "id", "instance");
    EXPECT_EQ(part.interior, 4u);
    EXPECT_EQ(part.agreeing, 4u);
  }
}

TEST(IdAgreement, NamesTheFirstDisagreement) {
  // Ids above 2^24 that floats would round to the same value.
  const std::uint32_t id = (1u << 24) + 1;
  const IdAgreement none = idAgreement(idImage(4, std::vector<std::uint32_t>(16, id)),
                                       idImage(4, std::vector<std::uint32_t>(16, id - 1)), "id", "instance");
  EXPECT_EQ(none.interior, 4u);
  EXPECT_EQ(none.share(), 0);
  ASSERT_TRUE(none.first);
  EXPECT_EQ(none.first->x, 1u);
  EXPECT_EQ(none.first->y, 1u);
  EXPECT_EQ(none.first->got, id);
  EXPECT_EQ(none.first->reference, id - 1);
}

TEST(IdAgreement, AboutNothingIsNoAgreement) {
  for (const std::uint32_t width : {1u, 2u}) {
    const Image image = idImage(width, {1, 1, 1, 1});
    EXPECT_TRUE(!(idAgreement(image, image, "id", "instance").share() >= 0.999));
  }
}

}  // namespace
}  // namespace crosslight

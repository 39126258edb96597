// What is written is what is read: bits in EXR and PFM, codes in PNG, within the format's bound in HDR.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"
#include "base/log.h"
#include "image/image_io.h"
#include "temporary_folder.h"

namespace crosslight {
namespace {

using testing::contentOf;
using testing::TemporaryFolder;

// Bit patterns, so that NaN equals itself and -0 does not equal 0.
std::vector<std::uint32_t> bitsOf(const std::vector<float>& samples) {
  std::vector<std::uint32_t> bits(samples.size());
  std::transform(samples.begin(), samples.end(), bits.begin(), [](float x) { return std::bit_cast<std::uint32_t>(x); });
  return bits;
}

// Any bit pattern: denormals, infinities and NaN among them.
Image imageOfAllKinds(std::uint32_t width, std::uint32_t height) {
  std::mt19937 bits(1);
  Image image = makeImage(width, height);
  for (float& sample : image.picture().samples) sample = std::bit_cast<float>(static_cast<std::uint32_t>(bits()));
  return image;
}

Image gradient(std::uint32_t width, std::uint32_t height) {
  Image image = makeImage(width, height);
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    const auto x = static_cast<float>(i % width), y = static_cast<float>(i / width);
    float* const p = image.picture().samples.data() + 4 * i;
    p[0] = x / static_cast<float>(width);
    p[1] = y / static_cast<float>(height);
    p[2] = 0.25f;
    p[3] = 1;
  }
  return image;
}

TEST(Exr, KeepsEveryBitOfEveryLayerAndTheMetadata) {
  const TemporaryFolder folder;
  Image image = imageOfAllKinds(37, 23);
  Layer& depth = addLayer(image, "depth", {"Z"});
  for (std::size_t i = 0; i < depth.samples.size(); ++i)
    depth.samples[i] = std::ldexp(1.0f, static_cast<int>(i % 200) - 100);
  Layer& normal = addLayer(image, "normal", {"X", "Y", "Z"});
  for (std::size_t i = 0; i < normal.samples.size(); ++i) normal.samples[i] = static_cast<float>(i) * -0.001f;
  Layer& ids = addIntegerLayer(image, "id", {"instance", "primitive"});
  for (std::size_t i = 0; i < ids.integers.size(); ++i) ids.integers[i] = 0xffffffffu - static_cast<std::uint32_t>(i);
  image.metadata = {{"crosslight.method", "phong"}, {"note", "caf\xc3\xa9"}};
  writeImage(folder / "a.exr", image);
  const Image back = readImage(folder / "a.exr");

  ASSERT_EQ(back.width, image.width);
  ASSERT_EQ(back.height, image.height);
  ASSERT_EQ(back.layers.size(), image.layers.size());
  EXPECT_EQ(back.picture().name, "");
  for (const Layer& layer : image.layers) {
    const Layer* const other = back.find(layer.name);
    ASSERT_NE(other, nullptr) << layer.name;
    EXPECT_EQ(other->channelNames, layer.channelNames);
    EXPECT_EQ(other->isInteger, layer.isInteger);
    EXPECT_EQ(bitsOf(other->samples), bitsOf(layer.samples)) << layer.name;
    EXPECT_EQ(other->integers, layer.integers) << "ids above 2^24 survive";
  }
  EXPECT_EQ(back.metadata, image.metadata);
}

TEST(Exr, IsTheSameFileEveryTime) {
  const TemporaryFolder folder;
  writeImage(folder / "a.exr", gradient(64, 64));
  writeImage(folder / "b.exr", gradient(64, 64));
  EXPECT_EQ(contentOf(folder / "a.exr"), contentOf(folder / "b.exr"));
}

TEST(Exr, ScalesThePictureByTheExposureAndNothingElse) {
  const TemporaryFolder folder;
  Image image = gradient(8, 8);
  addLayer(image, "depth", {"Z"}).samples.assign(64, 3.0f);
  writeImage(folder / "a.exr", image, {.exposureStops = 2});
  const Image back = readImage(folder / "a.exr");
  for (std::size_t i = 0; i < image.picture().samples.size(); ++i) {
    EXPECT_EQ(back.picture().samples[i], image.picture().samples[i] * (i % 4 == 3 ? 1.0f : 4.0f));
  }
  EXPECT_EQ(back.find("depth")->samples, image.find("depth")->samples);
}

TEST(Pfm, KeepsEveryBitOfThePicture) {
  const TemporaryFolder folder;
  const Image image = imageOfAllKinds(19, 31);
  writeImage(folder / "a.pfm", image);
  const Image back = readImage(folder / "a.pfm");
  ASSERT_EQ(back.picture().channelNames, (std::vector<std::string>{"R", "G", "B"}));
  std::vector<float> colors;
  for (std::size_t i = 0; i < image.picture().samples.size(); ++i) {
    if (i % 4 != 3) colors.push_back(image.picture().samples[i]);
  }
  EXPECT_EQ(bitsOf(back.picture().samples), bitsOf(colors));
}

TEST(Pfm, HasTheBottomRowFirstInLittleEndian) {
  const TemporaryFolder folder;
  Image image;
  image.width = 1;
  image.height = 2;
  addLayer(image, "", {"Y"}).samples = {1.0f, 2.0f};
  writeImage(folder / "a.pfm", image);
  const std::string expected =
      std::string("Pf\n1 2\n-1.0\n") + std::string("\0\0\0\x40", 4) + std::string("\0\0\x80\x3f", 4);
  EXPECT_EQ(contentOf(folder / "a.pfm"), expected);
  EXPECT_EQ(readImage(folder / "a.pfm").picture().samples, image.picture().samples);
}

TEST(Pfm, ReadsBigEndianFiles) {
  const TemporaryFolder folder;
  testing::writeContent(folder / "a.pfm", std::string("Pf\r\n2 1\r\n1.0\n") + std::string("\x3f\x80\0\0\x40\0\0\0", 8));
  EXPECT_EQ(readImage(folder / "a.pfm").picture().samples, (std::vector<float>{1, 2}));
}

// The largest component's mantissa is in [128, 255], rounded to a half: 1/256 of that component for all three.
TEST(Hdr, KeepsEveryComponentWithin1In256OfTheLargest) {
  const TemporaryFolder folder;
  std::mt19937 bits(2);
  for (const std::uint32_t width : {3u, 8u, 200u, 1000u}) {
    Image image = makeImage(width, 7);
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      // Every exponent that RGBE can hold at full precision, and runs of equal pixels for the run lengths.
      const float scale = std::ldexp(1.0f, static_cast<int>(i / 5 * 37 % 240) - 120);
      for (std::size_t c = 0; c < 3; ++c) {
        const float value = i % 5 < 3 ? 0.7f : static_cast<float>(bits() >> 8) * 0x1p-24f;
        image.picture().samples[4 * i + c] = value * scale;
      }
    }
    writeImage(folder / "a.hdr", image);
    const Image back = readImage(folder / "a.hdr");
    ASSERT_EQ(back.width, width);
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      const float* const p = image.picture().samples.data() + 4 * i;
      const float largest = std::max({p[0], p[1], p[2]});
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_LE(std::abs(back.picture().samples[3 * i + c] - p[c]), largest / 256)
            << "pixel " << i << " of width " << width;
      }
    }
  }
}

TEST(Hdr, PacksRunsAndStoresWhatRgbeCannotHoldAsItsNearest) {
  const TemporaryFolder folder;
  Image image = makeImage(1000, 10);
  writeImage(folder / "a.hdr", image);
  EXPECT_LT(std::filesystem::file_size(folder / "a.hdr"), 1000u) << "one color takes a few bytes per row";
  image.picture().samples[0] = -1;
  image.picture().samples[1] = std::numeric_limits<float>::quiet_NaN();
  image.picture().samples[4] = std::numeric_limits<float>::infinity();
  image.picture().samples[8] = 1e-42f;
  const std::size_t warnings = loggedWarnings().size();
  writeImage(folder / "a.hdr", image);
  EXPECT_EQ(loggedWarnings().size(), warnings + 1);
  const Image back = readImage(folder / "a.hdr");
  EXPECT_EQ(back.picture().samples[0], 0);
  EXPECT_EQ(back.picture().samples[1], 0);
  EXPECT_EQ(back.picture().samples[3], std::ldexp(255.0f, 119)) << "the largest mantissa and exponent";
  EXPECT_EQ(back.picture().samples[6], 0);
}

TEST(Hdr, DividesByTheExposureOfItsHeader) {
  const TemporaryFolder folder;
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\nEXPOSURE= 4\n\n-Y 1 +X 1\n";
  testing::writeContent(folder / "a.hdr", header + std::string("\x80\x40\x20\x81", 4));
  EXPECT_EQ(readImage(folder / "a.hdr").picture().samples, (std::vector<float>{1.0f / 8, 0.5f / 8, 0.25f / 8}));
}

TEST(Png, ShowsTheExpectedCodes) {
  const TemporaryFolder folder;
  Image image = makeImage(256, 4);
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t code = c == 0 ? i % 256 : c == 1 ? 255 - i % 256 : i / 256 * 60;
      image.picture().samples[4 * i + c] = linearFromSrgb(static_cast<float>(code) / 255.0f);
    }
    image.picture().samples[4 * i + 3] = static_cast<float>(i % 256) / 255.0f;
  }
  for (const bool withAlpha : {false, true}) {
    writeImage(folder / "a.png", image, {.withAlpha = withAlpha});
    const Image back = readImage(folder / "a.png");
    ASSERT_EQ(back.picture().channels(), withAlpha ? 4u : 3u);
    // The decoder gives the linear value of a code; encoded codes were made from the same values.
    const std::size_t channels = back.picture().channels();
    for (std::size_t i = 0; i < image.pixels() * channels; ++i) {
      ASSERT_EQ(back.picture().samples[i], image.picture().samples[i / channels * 4 + i % channels]) << "sample " << i;
    }
  }
}

TEST(Png, ShowsNotANumberAsBlackAndSaysHowMany) {
  const TemporaryFolder folder;
  Image image = makeImage(4, 1);
  image.picture().samples[0] = std::numeric_limits<float>::quiet_NaN();
  image.picture().samples[5] = std::numeric_limits<float>::infinity();
  for (const ToneMap toneMap : {ToneMap::none, ToneMap::clamp, ToneMap::reinhard, ToneMap::neutral}) {
    const DisplayPicture shown = displayPicture(image, {.toneMap = toneMap});
    EXPECT_EQ(shown.nonFinite, 2u);
    EXPECT_EQ(shown.codes[0], 0);
    EXPECT_EQ(shown.codes[4], 255);
  }
  const std::string path = (folder / "nan.png").string();
  writeImage(path, image);
  const auto warnings = loggedWarnings();
  const bool said = std::any_of(warnings.begin(), warnings.end(),
                                [&](const std::string& w) { return w.find(path + ": 2 values") == 0; });
  EXPECT_TRUE(said);
}

TEST(Png, OfCodesHasThemAsTheyAre) {
  const TemporaryFolder folder;
  Image image = makeShownImage(5, 3);
  for (std::size_t i = 0; i < image.shownCodes.size(); ++i) {
    image.shownCodes[i] = static_cast<std::uint8_t>(17 * i);
  }
  EXPECT_EQ(displayPicture(image, {.exposureStops = 5}).codes, image.shownCodes) << "they were exposed before";
  writeImage(folder / "codes.png", image, {.exposureStops = 5});
  const Image back = readImage(folder / "codes.png");
  ASSERT_EQ(back.picture().channels(), 3u);
  for (std::size_t i = 0; i < image.shownCodes.size(); ++i) {
    ASSERT_EQ(srgbCodeFromLinear(back.picture().samples[i]), image.shownCodes[i]) << i;
  }
  EXPECT_THROW(writeImage(folder / "codes.exr", image), InternalError) << "there are no floats";
}

TEST(Png, CarriesTheMetadataAndItsColorSpace) {
  const TemporaryFolder folder;
  Image image = gradient(16, 16);
  image.metadata = {{"Title", "plain"}, {"Author", "\xc3\x84sop"}};
  writeImage(folder / "a.png", image);
  const std::string content = contentOf(folder / "a.png");
  EXPECT_NE(content.find(std::string("tEXtTitle\0plain", 15)), std::string::npos);
  EXPECT_NE(content.find(std::string("iTXtAuthor\0\0\0\0\0\xc3\x84sop", 20)), std::string::npos);
  EXPECT_NE(content.find("sRGB"), std::string::npos);
  EXPECT_EQ(readImage(folder / "a.png").width, 16u) << "its chunks have the right checksums";
}

TEST(ImageFormat, FollowsTheExtensionInAnyCase) {
  EXPECT_EQ(imageFormatOf("a/b.PNG"), ImageFormat::png);
  EXPECT_EQ(imageFormatOf("b.eXr"), ImageFormat::exr);
  EXPECT_EQ(imageFormatOf("b.hdr"), ImageFormat::hdr);
  EXPECT_EQ(imageFormatOf("b.pfm"), ImageFormat::pfm);
  for (const char* const bad : {"b.jpg", "b", "png", ".png"}) EXPECT_THROW(imageFormatOf(bad), UsageError) << bad;
}

TEST(Picture, OfAnyChannelsReadsAsColor) {
  const auto colorOf = [](const std::vector<std::string>& names, const std::vector<float>& samples) {
    Image image;
    image.width = image.height = 1;
    addLayer(image, "", names).samples = samples;
    float p[4];
    PixelReader(image, image.picture())(0, p);
    return std::vector<float>(p, p + 4);
  };
  EXPECT_EQ(colorOf({"R", "G", "B", "A"}, {1, 2, 3, 4}), (std::vector<float>{1, 2, 3, 4}));
  EXPECT_EQ(colorOf({"A", "B", "G", "R"}, {1, 2, 3, 4}), (std::vector<float>{4, 3, 2, 1}));
  EXPECT_EQ(colorOf({"Y"}, {5}), (std::vector<float>{5, 5, 5, 1}));
  EXPECT_EQ(colorOf({"Y", "A"}, {5, 0.5f}), (std::vector<float>{5, 5, 5, 0.5f}));
  EXPECT_EQ(colorOf({"X", "Y", "Z"}, {1, 2, 3}), (std::vector<float>{1, 2, 3, 1}));
  EXPECT_EQ(colorOf({"U", "V"}, {1, 2}), (std::vector<float>{1, 2, 0, 1}));
}

}  // namespace
}  // namespace crosslight

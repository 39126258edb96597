// The film means samples and hands every pixel over once; which rows it exposes, and what it exposed before, changes no
// bit.
#include "film/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace crosslight {
namespace {

using shared::AovRecord;

constexpr std::uint32_t kWidth = 37, kHeight = 53;

gpu::Device& device() {
  static gpu::Device value = [] {
    gpu::DeviceOptions options;
    options.validation = true;
    return gpu::Device::open(options);
  }();
  return value;
}

// Colors that depend on pixel and sample, in 24 bits so that the mean of two is exact.
glm::vec4 colorAt(std::uint32_t pixel, std::uint32_t sample) {
  const auto value = [&](std::uint32_t c) {
    return static_cast<float>((pixel * 2654435761u + sample * 40503u + c * 977u) >> 10) / 1024.0f;
  };
  return {value(0), value(1), value(2), value(3)};
}

class Pattern final : public Technique {
 public:
  explicit Pattern(FilmBuffers& buffers) : buffers_(buffers) {}
  void renderSample(const SampleRequest& request, Tally&) override {
    const std::uint32_t first = request.band.firstRow * kWidth, count = request.band.rowCount * kWidth;
    if (request.color) {
      std::vector<glm::vec4> colors;
      for (std::uint32_t p = first; p < first + count; ++p) colors.push_back(colorAt(p, sample_));
      if (nanAt < kWidth * kHeight && nanAt >= first && nanAt < first + count) {
        colors[nanAt - first].y = std::numeric_limits<float>::quiet_NaN();
      }
      buffers_.sampleColor.write(0, std::as_bytes(std::span(colors)));
    }
    if (request.aovs) {
      for (std::uint32_t p = first + first % 2; p < first + count; p += 2) {  // every other pixel is hit
        AovRecord record{};
        record.instanceId = p;
        record.depth = static_cast<float>(p);
        record.albedo = glm::vec3(static_cast<float>(sample_));
        buffers_.aovs.write((p - first) * sizeof(AovRecord), std::as_bytes(std::span(&record, 1)));
      }
    }
    sample_ = request.color ? sample_ + 1 : sample_;
  }
  std::string promise() const override { return "a pattern"; }

  std::uint32_t nanAt = ~0u;

 private:
  FilmBuffers& buffers_;
  std::uint32_t sample_ = 0;
};

struct Exposed {
  std::vector<glm::vec4> picture;
  std::vector<AovRecord> aovs;
  FilmResult result;
};

Exposed expose(Film& film, Pattern& pattern) {
  Exposed exposed;
  Tally tally;
  exposed.result = film.expose(pattern, tally, [&](const ExposedPixels& pixels) {
    EXPECT_EQ(pixels.first, exposed.picture.size()) << "a pixel is left out or comes twice";
    exposed.picture.insert(exposed.picture.end(), pixels.picture.begin(), pixels.picture.end());
    exposed.aovs.insert(exposed.aovs.end(), pixels.aovs.begin(), pixels.aovs.end());
  });
  EXPECT_EQ(exposed.picture.size(), film.exposedPixels());
  return exposed;
}

Exposed expose(const FilmSettings& settings) {
  Film film(device(), settings);
  Pattern pattern(film.buffers());
  return expose(film, pattern);
}

TEST(Film, isTheMeanOfItsSamples) {
  const Exposed exposed = expose({kWidth, kHeight, {{{0.25f, 0.5f}}, {{0.75f, 0.5f}}}, false, {}});
  ASSERT_EQ(exposed.picture.size(), kWidth * kHeight);
  for (std::uint32_t p = 0; p < kWidth * kHeight; ++p) {
    const glm::dvec4 sum = glm::dvec4(colorAt(p, 0)) + glm::dvec4(colorAt(p, 1));
    for (int c = 0; c < 4; ++c) ASSERT_EQ(exposed.picture[p][c], static_cast<float>(sum[c] / 2)) << p;
  }
}

TEST(Film, ofSomeRowsHasTheBitsOfTheWhole) {
  FilmSettings settings{kWidth, kHeight, {{{0.5f, 0.5f}}}, true, {}};
  const Exposed whole = expose(settings);
  settings.rows = {{3, 5}, {8, 1}, {40, 13}};
  Film film(device(), settings);
  // One sample per band and a band per run: the pattern must not count samples across bands.
  Exposed some;
  Tally tally;
  class Still final : public Technique {
   public:
    explicit Still(FilmBuffers& b) : buffers(b) {}
    void renderSample(const SampleRequest& request, Tally& t) override { Pattern(buffers).renderSample(request, t); }
    std::string promise() const override { return ""; }
    FilmBuffers& buffers;
  } still(film.buffers());
  film.expose(still, tally, [&](const ExposedPixels& pixels) {
    some.picture.insert(some.picture.end(), pixels.picture.begin(), pixels.picture.end());
    some.aovs.insert(some.aovs.end(), pixels.aovs.begin(), pixels.aovs.end());
  });
  std::size_t at = 0;
  for (const Band& band : settings.rows) {
    for (std::uint32_t p = band.firstRow * kWidth; p < (band.firstRow + band.rowCount) * kWidth; ++p, ++at) {
      ASSERT_EQ(some.picture.at(at), whole.picture[p]) << p;
      ASSERT_EQ(some.aovs.at(at).depth, whole.aovs[p].depth) << p;
    }
  }
  EXPECT_EQ(at, some.picture.size());
}

TEST(Film, ofCodesHandsThemOnAndCountsWhatIsNotFinite) {
  FilmSettings settings{kWidth, kHeight, {{{0.5f, 0.5f}}}, false, {}};
  settings.shownBy = DisplayTransform{.exposureStops = 1};
  Film film(device(), settings);
  EXPECT_TRUE(film.buffers().wantsCodes());
  EXPECT_EQ(film.buffers().displayGain, 2.0f);
  EXPECT_EQ(film.buffers().sampleColor.sizeBytes(), kWidth * kHeight * sizeof(std::uint32_t));
  class Counting final : public Technique {
   public:
    explicit Counting(FilmBuffers& b) : buffers(b) {}
    void renderSample(const SampleRequest&, Tally&) override {
      std::vector<std::uint32_t> codes(kWidth * kHeight);
      for (std::uint32_t p = 0; p < codes.size(); ++p) codes[p] = p | (p % 700 == 699 ? 0u : shared::kFiniteCode);
      buffers.sampleColor.write(0, std::as_bytes(std::span(codes)));
    }
    std::string promise() const override { return ""; }
    FilmBuffers& buffers;
  } counting(film.buffers());
  Tally tally;
  std::uint32_t next = 0;
  const FilmResult result = film.expose(counting, tally, [&](const ExposedPixels& pixels) {
    EXPECT_TRUE(pixels.picture.empty());
    for (const std::uint32_t code : pixels.codes) ASSERT_EQ(code & 0xffffffu, next++);
  });
  EXPECT_EQ(next, kWidth * kHeight);
  EXPECT_EQ(result.nonfinite, 2u);
  EXPECT_EQ(result.firstNonfinitePixel, 699u);
}

TEST(Film, tellsNothingHitFromHit) {
  const Exposed exposed = expose({kWidth, kHeight, {{{0.5f, 0.5f}}}, true, {}});
  for (std::uint32_t p = 0; p < kWidth * kHeight; ++p) {
    ASSERT_EQ(exposed.aovs[p].instanceId, p % 2 == 0 ? p : shared::kNoId);
    ASSERT_EQ(exposed.aovs[p].depth, p % 2 == 0 ? static_cast<float>(p) : 0.0f);
    ASSERT_EQ(exposed.aovs[p].primitiveId, p % 2 == 0 ? 0 : shared::kNoId);
  }
}

TEST(Film, meansThePartsOfTheAovs) {
  const Exposed exposed = expose({kWidth, kHeight, {{{0.25f, 0.5f}}, {{0.75f, 0.5f}}}, true, {}});
  for (std::uint32_t p = 0; p < kWidth * kHeight; p += 2) ASSERT_EQ(exposed.aovs[p].albedo.x, 0.5f) << p;
}

TEST(Film, countsNonfiniteSamplesOfThisPictureOnly) {
  Film film(device(), {kWidth, kHeight, {{{0.5f, 0.5f}}}, false, {}});
  Pattern broken(film.buffers());
  broken.nanAt = 5 * kWidth + 7;
  const Exposed first = expose(film, broken);
  EXPECT_EQ(first.result.nonfinite, 1u);
  EXPECT_EQ(first.result.firstNonfinitePixel, 5 * kWidth + 7);
  Pattern whole(film.buffers());
  const Exposed second = expose(film, whole);
  EXPECT_EQ(second.result.nonfinite, 0u);
  for (std::uint32_t p = 0; p < kWidth * kHeight; ++p) ASSERT_EQ(second.picture[p], colorAt(p, 0)) << p;
}

// No dispatch reaches further, and no buffer is larger: what the picture's size would need is shared out to bands.
TEST(Film, staysWithinTheDevicesLimitsWhateverThePicturesSize) {
  gpu::DeviceInfo small;
  small.name = "small";
  small.maxStorageBufferBytes = 1 << 20;
  small.maxWorkGroupCountX = 100;
  FilmSettings settings{1000, 100000, {}, false, {}};
  EXPECT_LE(filmBytes(small, settings), std::uint64_t{100} * 64 * 48);
  small.maxWorkGroupCountX = 65535;
  EXPECT_LE(filmBytes(small, settings), (std::uint64_t{1} << 20) / 32 * 48);
}

}  // namespace
}  // namespace crosslight

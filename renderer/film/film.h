// The film: sums samples of the picture on the device and reads them back. A Technique fills one sample; where it comes
// from (raster or rays) is its own affair.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bindings.h"
#include "film/adaptive_tiles.h"
#include "film/sample_pattern.h"
#include "gpu/commands.h"
#include "image/image_io.h"
#include "structs.h"

namespace crosslight {

// Rows of the image that are worked on at once: per-pixel buffers hold a band, whatever the image's size.
struct Band {
  std::uint32_t firstRow = 0;
  std::uint32_t rowCount = 0;
};

// Per-pixel buffers of the largest band. Those that nobody needs hold one dummy record.
struct FilmBuffers {
  gpu::Buffer sampleColor, aovs, film, parts, counters;
  // Where the film wants codes (FilmSettings::shownBy): displayCodeTable() and gainOf(); else none.
  gpu::Buffer codeTable;
  float displayGain = 1;
  bool wantsCodes() const { return bool(codeTable); }
  const gpu::Buffer* tileList = nullptr;  // where samples are adaptive: tiles of the band by their numbers
};

// Adds up milliseconds and counts by name over many submissions, in the order of first use.
class Tally {
 public:
  void add(const std::vector<gpu::TimedSpan>& spans);
  const std::vector<std::pair<std::string, double>>& spansMs() const { return spans_; }

 private:
  std::vector<std::pair<std::string, double>> spans_;
};

struct SampleRequest {
  Band band;
  std::uint32_t width = 0;
  glm::vec2 offset{0.5f};
  std::uint32_t index = 0;  // of the sample
  // Where samples are adaptive: how many tiles of FilmBuffers::tileList count. Others may be left as they are.
  std::optional<std::uint32_t> tiles = {};
  std::uint64_t pixels = 0;  // that get the sample
  bool color = true;
  bool aovs = false;
};

// Makes one sample of a band: writes FilmBuffers::sampleColor (premultiplied RGBA, linear) and, if asked, aovs. Where
// the film wants codes, a pixel of sampleColor is a word: red, green and blue as displayCodeTable() says from the
// lowest byte on, shared::kFiniteCode above.
class Technique {
 public:
  virtual ~Technique() = default;
  virtual void renderSample(const SampleRequest& request, Tally& tally) = 0;
  // Light paths that it computes, in Heckbert's notation, with what it leaves out in words.
  virtual std::string promise() const = 0;
  virtual std::map<std::string, std::uint64_t> rays() const { return {}; }
  virtual std::map<std::string, std::uint64_t> counters() const { return {}; }
};

struct FilmSettings {
  std::uint32_t width = 0, height = 0;
  std::vector<PixelSample> samples;
  bool wantAovs = false;
  std::vector<Band> rows = {};  // those that are exposed, ascending; empty: all
  // Only the codes of this transform are wanted, which hasCodeTable(): one sample, no AOVs, and a technique that can.
  std::optional<DisplayTransform> shownBy = {};
  // Standard error of a channel's mean, linear, that is good enough: tiles of 8 x 8 pixels get no more samples once all
  // their pixels and those of the tiles beside them have it. 0: all samples for all.
  float adaptiveError = 0;
};

// Finished pixels in a row. The pixels of the exposed rows count from 0 on, in their order, whatever lies between.
struct ExposedPixels {
  std::size_t first = 0;
  std::span<const glm::vec4> picture;            // premultiplied mean of the samples
  std::span<const std::uint32_t> codes = {};     // instead of `picture`, where codes are wanted
  std::span<const shared::AovRecord> aovs = {};  // at pixel centers; averaged parts replaced by their means
};
using PixelSink = std::function<void(const ExposedPixels&)>;

struct FilmResult {
  std::uint64_t nonfinite = 0;
  std::uint32_t firstNonfinitePixel = 0;  // when nonfinite > 0
  double renderMs = 0, readbackMs = 0;
  std::uint64_t samples = 0;        // over all pixels
  std::uint64_t pixelsNotDone = 0;  // adaptive: in tiles that had all samples and wanted more
};

class Film {
 public:
  Film(const gpu::Device& device, const FilmSettings& settings);
  FilmBuffers& buffers() { return buffers_; }
  // Loops over bands and samples; each finished pixel goes to `sink` once, in order. `progress` is called after each
  // sample of a band with (done, total). Ctrl-C is looked for here. May be called again, for another picture.
  FilmResult expose(Technique& technique, Tally& tally, const PixelSink& sink,
                    const std::function<void(std::uint64_t, std::uint64_t)>& progress = {});
  std::size_t exposedPixels() const;

 private:
  // Read back at once: 1 MiB of sums, about half of a core's second-level cache.
  static constexpr std::size_t kSlicePixels = std::size_t{1} << 15;

  std::vector<Band> bands() const;
  void resetCounters();
  void renderBand(Technique& technique, const Band& band, Tally& tally, const std::function<void()>& step,
                  FilmResult& result);
  void clearAovs(const Band& band);
  void accumulate(const Band& band, bool first, float weight, Tally& tally);
  void fetchSample(const Band& band);
  void readBand(const Band& band, std::size_t firstPixel, const PixelSink& sink, FilmResult& result);
  void readBandCodes(const Band& band, std::size_t firstPixel, const PixelSink& sink, FilmResult& result);
  void readMean(std::size_t first, std::span<glm::vec4> picture);
  void readSample(std::size_t first, std::span<glm::vec4> picture, std::uint32_t firstPixel, FilmResult& result);
  void readAovs(std::size_t first, std::span<shared::AovRecord> aovs);
  void readCounters(FilmResult& result);
  std::uint64_t sampleBytes() const;  // of one pixel of sampleColor
  double sumOfWeights() const;

  FilmSettings settings_;
  std::uint32_t bandRows_ = 0;
  bool single_ = false;       // one sample: it is the mean, and nothing is summed on the device
  bool readsSample_ = false;  // single, and the host reaches the sample where it lies
  FilmBuffers buffers_;
  std::unique_ptr<AdaptiveTiles> adaptive_;
  gpu::Buffer emptyAovs_;  // "nothing was hit", a few records; only when AOVs are wanted
  gpu::Commands commands_;
  gpu::BindingLayout layout_;
  gpu::BindingSet set_;
  gpu::ComputePipeline accumulate_;
  std::vector<shared::FilmPixel> pixels_;  // host copies of a slice, kept because fresh memory costs page faults
  std::vector<shared::FilmParts> parts_;
};

// Device memory of a film, for estimates before there is one.
std::uint64_t filmBytes(const gpu::DeviceInfo& device, const FilmSettings& settings);

}  // namespace crosslight

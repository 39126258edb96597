#include "measure/metrics.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "base/check.h"
#include "base/error.h"

namespace crosslight {
namespace {

// Keeps a relative error finite where the reference is black; part of the metric's definition.
constexpr double kRelMseFloor = 1e-2;

std::string quoted(const std::string& layer) { return layer.empty() ? "the picture" : "layer \"" + layer + "\""; }

void checkSameSize(const Image& got, const Image& reference) {
  if (got.width == reference.width && got.height == reference.height) return;
  throw InputError("comparison", fmt::format("the images are {} x {} and {} x {} pixels; they must have the same size",
                                             got.width, got.height, reference.width, reference.height));
}

const Layer& layerOf(const Image& image, const std::string& name, bool isInteger, const char* whose) {
  // The picture is the first layer, whatever its name.
  const Layer* const layer = name.empty() && !image.layers.empty() ? &image.layers.front() : image.find(name);
  if (layer == nullptr) throw InputError("comparison", fmt::format("{} image has no layer \"{}\"", whose, name));
  if (layer->isInteger != isInteger) {
    throw InputError("comparison", fmt::format("{} of {} image holds {}", quoted(name), whose,
                                               isInteger ? "no ids" : "ids, not values"));
  }
  CL_CHECK_EQ(isInteger ? layer->integers.size() : layer->samples.size(), image.pixels() * layer->channels());
  return *layer;
}

struct ChannelPair {
  std::string name;
  std::size_t got = 0;
  std::size_t reference = 0;
};

std::vector<ChannelPair> pairChannels(const Layer& got, const Layer& reference, bool withAlpha) {
  std::vector<ChannelPair> pairs;
  std::size_t expected = 0;
  for (const std::string& name : got.channelNames) expected += withAlpha || name != "A";
  for (std::size_t c = 0; c < reference.channels(); ++c) {
    const std::string& name = reference.channelNames[c];
    if (name == "A" && !withAlpha) continue;
    const std::size_t other = got.channel(name);
    if (other == got.channels())
      throw InputError("comparison", fmt::format("only the reference has a channel {}", name));
    pairs.push_back({name, other, c});
  }
  if (pairs.size() != expected) throw InputError("comparison", "the reference lacks channels that the image has");
  return pairs;
}

// Sums of one image; rows are summed apart, so that rounding grows with width plus height and not with their product.
struct Sums {
  double squared = 0, absolute = 0, relative = 0;

  void add(const Sums& row) {
    squared += row.squared;
    absolute += row.absolute;
    relative += row.relative;
  }
};

void finish(Metrics& metrics, const Sums& sums, double largest, double peak) {
  if (!metrics.valid()) return;
  const auto n = static_cast<double>(metrics.values);
  metrics.rmse = std::sqrt(sums.squared / n);
  metrics.mae = sums.absolute / n;
  metrics.maxAbs = largest;
  metrics.relMse = sums.relative / n;
  metrics.psnrDb = 10 * std::log10(peak * peak / (sums.squared / n));
}

}  // namespace

Metrics measureImages(const Image& got, const Image& reference, const MetricOptions& options) {
  checkSameSize(got, reference);
  const Layer& a = layerOf(got, options.layer, false, "the first");
  const Layer& b = layerOf(reference, options.layer, false, "the second");
  CL_CHECK(options.mask.empty() || options.mask.size() == got.pixels());
  const std::vector<ChannelPair> pairs = pairChannels(a, b, options.withAlpha);
  Metrics metrics;
  Sums sums;
  double largest = -1;
  for (std::uint32_t y = 0; y < got.height; ++y) {
    Sums row;
    for (std::uint32_t x = 0; x < got.width; ++x) {
      const std::size_t pixel = std::size_t{y} * got.width + x;
      if (!options.mask.empty() && options.mask[pixel] == 0) continue;
      for (const ChannelPair& pair : pairs) {
        const float value = a.samples[pixel * a.channels() + pair.got],
                    expected = b.samples[pixel * b.channels() + pair.reference];
        ++metrics.values;
        const bool finite = std::isfinite(value) && std::isfinite(expected);
        const double error = finite ? std::abs(double{value} - expected) : 0;
        if ((!finite && metrics.nonFinite++ == 0) || (finite && metrics.nonFinite == 0 && error > largest)) {
          metrics.worst = {x, y, pair.name, value, expected};
          largest = error;
        }
        row.squared += error * error;
        row.absolute += error;
        row.relative += error * error / (double{expected} * expected + kRelMseFloor);
      }
    }
    sums.add(row);
  }
  finish(metrics, sums, largest, options.peak);
  return metrics;
}

std::string describe(const Metrics& m) {
  const std::string worst = fmt::format("worst at ({}, {}) {}: {:.9g} instead of {:.9g}", m.worst.x, m.worst.y,
                                        m.worst.channel, m.worst.got, m.worst.reference);
  if (m.values == 0) return "nothing was compared";
  if (m.nonFinite > 0) return fmt::format("invalid: {} of {} values are not finite, {}", m.nonFinite, m.values, worst);
  return fmt::format("RMSE {:.3g}, MAE {:.3g}, max {:.3g}, relMSE {:.3g}, PSNR {:.2f} dB; {}", m.rmse, m.mae, m.maxAbs,
                     m.relMse, m.psnrDb, worst);
}

namespace {

struct IdView {
  const Layer& layer;
  std::size_t channel;
  std::uint32_t width;

  IdView(const Image& image, const std::string& layerName, const std::string& channelName, const char* whose)
      : layer(layerOf(image, layerName, true, whose)), channel(layer.channel(channelName)), width(image.width) {
    if (channel == layer.channels()) {
      throw InputError("comparison",
                       fmt::format("{} of {} image has no channel {}", quoted(layerName), whose, channelName));
    }
  }
  std::uint32_t operator()(std::uint32_t x, std::uint32_t y) const {
    return layer.integers[(std::size_t{y} * width + x) * layer.channels() + channel];
  }
  bool sameAround(std::uint32_t x, std::uint32_t y) const {
    const std::uint32_t id = (*this)(x, y);
    for (std::uint32_t j = y - 1; j <= y + 1; ++j) {
      for (std::uint32_t i = x - 1; i <= x + 1; ++i) {
        if ((*this)(i, j) != id) return false;
      }
    }
    return true;
  }
};

}  // namespace

IdAgreement idAgreement(const Image& got, const Image& reference, const std::string& layer,
                        const std::string& channel) {
  checkSameSize(got, reference);
  const IdView a(got, layer, channel, "the first"), b(reference, layer, channel, "the second");
  IdAgreement result;
  for (std::uint32_t y = 1; y + 1 < got.height; ++y) {
    for (std::uint32_t x = 1; x + 1 < got.width; ++x) {
      if (!a.sameAround(x, y) || !b.sameAround(x, y)) continue;
      ++result.interior;
      if (a(x, y) == b(x, y)) {
        ++result.agreeing;
      } else if (!result.first) {
        result.first = IdAgreement::Disagreement{x, y, a(x, y), b(x, y)};
      }
    }
  }
  return result;
}

}  // namespace crosslight

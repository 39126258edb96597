// What a numerically hard case is: a set-up, what it measures, and the bound that each figure must keep, with its
// origin. A case knows the device only through its bench.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "image/image.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace crosslight::study {

// A picture with the number of samples in it that are not finite; those do not fail the render.
struct Shot {
  Image image;
  std::uint64_t nonfinite = 0;
};
// Renders a scene: whoever runs cases brings it, so that this room knows no way from a scene to a picture.
using Draw = std::function<Shot(const Scene& scene, const RenderSettings& settings)>;

struct Bench {
  const gpu::Device& device;
  Draw draw;
  bool full = false;  // more samples of the same
};

// The worst of many comparisons. What is not a number is worse than everything.
class Worst {
 public:
  void add(double got, double expected, double error) {
    ++compared_;
    if (std::isnan(error_) || error <= error_) return;
    got_ = got;
    expected_ = expected;
    error_ = error;
  }
  void addAbsolute(double got, double expected) { add(got, expected, std::abs(got - expected)); }
  void addRelative(double got, double expected) { add(got, expected, std::abs(got / expected - 1.0)); }
  // The error that the textbook's formula in single precision makes of the same arguments.
  void addNaive(double error) {
    if (!naive_ || std::isnan(error) || error > *naive_) naive_ = error;
  }

  double got() const { return got_; }
  double expected() const { return expected_; }
  double error() const { return error_; }
  const std::optional<double>& naive() const { return naive_; }
  std::uint64_t compared() const { return compared_; }

 private:
  double got_ = 0, expected_ = 0, error_ = -1;
  std::optional<double> naive_;
  std::uint64_t compared_ = 0;
};

// One figure of a case by one technique.
struct Measurement {
  std::string technique;         // "phong", "whitted", "kernel" (the shaders' function alone), "host"
  std::string what;              // "direction of the refracted ray at 80 degrees"
  std::string unit;              // of error and bound: "absolute", "relative", "pixels", ...
  double got = 0, expected = 0;  // where the error is largest
  double error = 0, bound = 0;
  std::optional<double> naive;
  std::uint64_t compared = 0;  // values

  bool holds() const { return compared > 0 && error <= bound; }  // NaN does not
  bool naiveHolds() const { return naive && *naive <= bound; }
};

struct CasePicture {
  std::string title;
  Image image;
};

class CaseResult {
 public:
  void measure(std::string technique, std::string what, const Worst& worst, double bound, std::string unit);
  // How many of `compared` are wrong, where none should be.
  void count(std::string technique, std::string what, std::uint64_t wrong, std::uint64_t compared,
             std::optional<double> naive = {});
  void show(std::string title, Image image) { pictures_.push_back({std::move(title), std::move(image)}); }

  const std::vector<Measurement>& measurements() const { return measurements_; }
  const std::vector<CasePicture>& pictures() const { return pictures_; }

 private:
  std::vector<Measurement> measurements_;
  std::vector<CasePicture> pictures_;
};

struct HardCase {
  const char* id;      // of the catalogue
  const char* name;    // a few words
  const char* hard;    // what goes wrong, in a sentence
  const char* source;  // where the bound comes from
  bool inDefault;      // run without --full
  void (*run)(const Bench& bench, CaseResult& result);
  // Known to fail, and why; its healing is then what shows.
  const char* expectedFailure = nullptr;
  // Why no formula of textbooks is evaluated beside it.
  const char* noNaive = nullptr;
};

}  // namespace crosslight::study

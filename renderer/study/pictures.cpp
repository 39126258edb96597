#include "study/pictures.h"

#include "base/check.h"

namespace crosslight::study {

const char* techniqueOf(Method method) { return method == Method::whitted ? "whitted" : "phong"; }

glm::dvec3 rayThrough(const Camera& camera, double x, double y, std::uint32_t width, std::uint32_t height) {
  const double halfY = std::tan(0.5 * camera.yFov), halfX = halfY * width / height;
  return {(2 * x / width - 1) * halfX, (1 - 2 * y / height) * halfY, -1};
}

namespace {

std::optional<std::uint32_t> nearest(const Camera& camera, const std::vector<oracle::Triangle>& triangles, double x,
                                     double y, std::uint32_t width, std::uint32_t height) {
  const oracle::Ray ray{.origin = {}, .direction = rayThrough(camera, x, y, width, height), .tMin = camera.zNear};
  const auto hit = oracle::closestHitNaive<double>(triangles, ray);
  return hit ? std::optional(hit->id) : std::nullopt;
}

}  // namespace

Coverage coverageAt(const Camera& camera, const std::vector<oracle::Triangle>& triangles, double x, double y,
                    std::uint32_t width, std::uint32_t height, double margin) {
  Coverage coverage{true, nearest(camera, triangles, x, y, width, height)};
  for (const double dx : {-margin, margin}) {
    for (const double dy : {-margin, margin}) {
      coverage.certain = coverage.certain && nearest(camera, triangles, x + dx, y + dy, width, height) == coverage.id;
    }
  }
  return coverage;
}

std::uint32_t objectAt(const Image& image, std::size_t pixel) { return image.find("instanceId")->integers[pixel]; }

glm::dvec3 vectorAt(const Image& image, const char* aov, std::size_t pixel) {
  const Layer& layer = *image.find(aov);
  glm::dvec3 v(0.0);
  for (std::size_t c = 0; c < std::min<std::size_t>(3, layer.channels()); ++c)
    v[static_cast<int>(c)] = layer.samples[pixel * layer.channels() + c];
  return v;
}

void compareColors(const Image& got, const Image& expected, Worst& worst) {
  const std::vector<float>&a = got.picture().samples, &b = expected.picture().samples;
  CL_CHECK(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) worst.addAbsolute(a[i], b[i]);
}

std::uint64_t differentObjects(const Image& a, const Image& b) {
  std::uint64_t different = 0;
  for (std::size_t i = 0; i < a.pixels(); ++i) different += objectAt(a, i) != objectAt(b, i);
  return different;
}

Image differenceOf(const Image& a, const Image& b, float gain) {
  Image out = makeImage(a.width, a.height);
  std::vector<float>& samples = out.picture().samples;
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples[i] = i % 4 == 3 ? 1.0f : gain * std::abs(a.picture().samples[i] - b.picture().samples[i]);
  return out;
}

Image mirrored(const Image& image) {
  Image out = makeImage(image.width, image.height);
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const auto p = pixelAt(image, image.width - 1 - x, y);
      std::copy(p.begin(), p.end(), out.picture().samples.begin() + 4 * (std::ptrdiff_t{y} * image.width + x));
    }
  }
  return out;
}

}  // namespace crosslight::study

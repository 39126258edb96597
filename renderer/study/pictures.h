// What cases do with pictures: draw by raster and by rays, compare pixel by pixel.
#pragma once

#include <optional>
#include <string>

#include "accel/intersect.h"
#include "study/hard_case.h"
#include "study/stage.h"

namespace crosslight::study {

inline constexpr Method kRasterAndRays[] = {Method::phong, Method::whitted};
const char* techniqueOf(Method method);

// The direction of the ray through a point of the image, in pixels, of a camera at the origin that looks along -Z.
glm::dvec3 rayThrough(const Camera& camera, double x, double y, std::uint32_t width, std::uint32_t height);

// Index of the nearest triangle that the ray through each pixel meets, in double; none where within `margin` pixels
// another answer would be right.
struct Coverage {
  bool certain = false;
  std::optional<std::uint32_t> id;
};
Coverage coverageAt(const Camera& camera, const std::vector<oracle::Triangle>& triangles, double x, double y,
                    std::uint32_t width, std::uint32_t height, double margin);

std::uint32_t objectAt(const Image& image, std::size_t pixel);  // of the AOV instanceId
glm::dvec3 vectorAt(const Image& image, const char* aov, std::size_t pixel);

// Largest difference of a color value, as absolute error.
void compareColors(const Image& got, const Image& expected, Worst& worst);
std::uint64_t differentObjects(const Image& a, const Image& b);

// |a - b| times a gain, to be looked at.
Image differenceOf(const Image& a, const Image& b, float gain);
Image mirrored(const Image& image);  // left and right

}  // namespace crosslight::study

#include "accel/bvh_clip.h"

#include <algorithm>
#include <cmath>

namespace crosslight::accel {
namespace {

// Float at or below (above) a double that is off by `error` at most.
float roundedDown(double x) {
  const auto f = static_cast<float>(x);
  return double{f} > x ? std::nextafter(f, -kInfinity) : f;
}
float roundedUp(double x) {
  const auto f = static_cast<float>(x);
  return double{f} < x ? std::nextafter(f, kInfinity) : f;
}

// Adds the point where the edge from a to b meets the plane at `position`, which lies between them.
void addCrossing(const glm::vec3& a, const glm::vec3& b, int axis, float position, Box& box) {
  const double t = (double{position} - a[axis]) / (double{b[axis]} - a[axis]);
  Float4 lower = splat(0), upper = splat(0);
  for (int i = 0; i < 3; ++i) {
    // Differences of floats are exact up to 2^-53 of themselves, and so are quotient, product and sum: five roundings
    // of values below 2 (|a| + |b|).
    const double error = 16 * 0x1p-53 * (std::abs(double{a[i]}) + std::abs(double{b[i]}));
    const double x = a[i] + t * (double{b[i]} - a[i]);
    lower[i] = i == axis ? position : roundedDown(x - error);
    upper[i] = i == axis ? position : roundedUp(x + error);
  }
  box.lower = minimum(box.lower, lower);
  box.upper = maximum(box.upper, upper);
}

}  // namespace

Corners cornersOf(const BvhTriangles& triangles, std::uint32_t triangle) {
  const auto corner = [&](std::size_t k) { return triangles.positions[triangles.indices[3 * triangle + k]]; };
  return {{corner(0), corner(1), corner(2)}};
}

Box clippedBox(const Corners& triangle, const Box& box, int axis, float low, float high) {
  Box part;
  for (int k = 0; k < 3; ++k) {
    const glm::vec3 &a = triangle.points[k], &b = triangle.points[(k + 1) % 3];
    if (a[axis] >= low && a[axis] <= high) part.addPoint(Float4{a.x, a.y, a.z, 0} + splat(0));
    for (const float plane : {low, high}) {
      if ((a[axis] < plane && plane < b[axis]) || (b[axis] < plane && plane < a[axis]))
        addCrossing(a, b, axis, plane, part);
    }
  }
  part.lower = maximum(part.lower, box.lower);
  part.upper = minimum(part.upper, box.upper);
  return part;
}

}  // namespace crosslight::accel

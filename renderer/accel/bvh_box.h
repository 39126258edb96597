// Boxes as two vector registers, and references to primitives. Private to the room; bvh.h is the interface. Vectors are
// the compilers' own (GCC, Clang): every target has them, and their arithmetic is that of float, lane by lane.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "accel/bvh.h"

namespace crosslight::accel {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));
using Double4 = double __attribute__((vector_size(32)));

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

inline Float4 splat(float x) { return Float4{x, x, x, x}; }
inline Float4 minimum(const Float4& a, const Float4& b) { return a < b ? a : b; }
inline Float4 maximum(const Float4& a, const Float4& b) { return a > b ? a : b; }

// A box whose fourth lane is carried along but means nothing.
struct Box {
  Float4 lower = splat(kInfinity);
  Float4 upper = splat(-kInfinity);

  void add(const Box& other) {
    lower = minimum(lower, other.lower);
    upper = maximum(upper, other.upper);
  }
  void addPoint(const Float4& p) {
    lower = minimum(lower, p);
    upper = maximum(upper, p);
  }
  // Half the surface area; double, because the product of two float extents can overflow.
  double halfArea() const {
    const double x = double{upper[0]} - lower[0], y = double{upper[1]} - lower[1], z = double{upper[2]} - lower[2];
    return x < 0 ? 0.0 : x * y + y * z + z * x;
  }
};

inline Box joined(Box a, const Box& b) {
  a.add(b);
  return a;
}

// A primitive's box; the fourth lane of `lower` holds its index, so that references move as a whole.
struct Reference : Box {
  // The bits of an index alone would be a denormal number, which makes vector arithmetic on its lane slow.
  static constexpr std::uint32_t kNormal = 0x40000000u;

  Reference() = default;
  Reference(const Box& box, std::uint32_t index) : Box(box) {
    lower[3] = std::bit_cast<float>(kNormal | index);
    upper[3] = 0;
  }
  std::uint32_t index() const { return std::bit_cast<std::uint32_t>(float{lower[3]}) & shared::kBvhFirstMask; }
  // Halved before adding: the sum of two large floats may overflow.
  Float4 center() const { return lower * 0.5f + upper * 0.5f; }
  float center(int axis) const { return lower[axis] * 0.5f + upper[axis] * 0.5f; }
};
static_assert(sizeof(Reference) == 32);

inline glm::vec3 asVec3(const Float4& v) { return {v[0], v[1], v[2]}; }

// lower.w = child0, upper.w = child1 of BvhNode's two boxes are written with them: four stores make a node.
inline Float4 withWord(Float4 v, std::uint32_t word) {
  v[3] = std::bit_cast<float>(word);
  return v;
}

inline void writeNode(shared::BvhNode& node, const Box& box0, const Box& box1, std::uint32_t axis,
                      std::uint32_t parent) {
  const Float4 rows[4] = {box0.lower, box0.upper, withWord(box1.lower, axis), withWord(box1.upper, parent)};
  static_assert(sizeof(rows) == sizeof(node));
  std::memcpy(&node, rows, sizeof(rows));
}

}  // namespace crosslight::accel

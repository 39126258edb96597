#include "accel/intersect.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"

namespace crosslight::oracle {

Bounds Triangle::bounds() const {
  Bounds b;
  for (const glm::vec3& v : {v0, v1, v2}) b.add(v);
  return b;
}

namespace {

template <class Real>
using Vec = glm::vec<3, Real, glm::highp>;

// a b - c d with the exact sign: rounding is monotone, so unequal products are in the right order, and where they are
// equal their rounding errors decide, which fma gives exactly.
template <class Real>
Real determinant(Real a, Real b, Real c, Real d) {
  const Real p = a * b, q = c * d;
  return p != q ? p - q : std::fma(a, b, -p) - std::fma(c, d, -q);
}

// Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection": space sheared so that the ray is the z axis.
// A corner's image is the same in every triangle that has it, and edges are judged exactly on the images.
template <class Real>
struct Shear {
  int x, y, z;
  Real sx, sy, sz;
  Vec<Real> origin;

  explicit Shear(const Ray& ray) : origin(ray.origin) {
    const Vec<Real> d(ray.direction);
    z = 0;
    for (int i = 1; i < 3; ++i) {
      if (std::abs(d[i]) > std::abs(d[z])) z = i;
    }
    x = (z + 1) % 3;
    y = (z + 2) % 3;
    sx = d[x] / d[z];
    sy = d[y] / d[z];
    sz = 1 / d[z];
  }
  Vec<Real> operator()(const glm::vec3& corner) const {
    const Vec<Real> v = Vec<Real>(corner) - origin;
    return {v[x] - sx * v[z], v[y] - sy * v[z], sz * v[z]};
  }
};

template <class Hit>
bool isNearer(const Hit& a, const std::optional<Hit>& b) {
  return !b || a.t < b->t || (a.t == b->t && a.id < b->id);
}

}  // namespace

template <class Real>
std::optional<TriangleHit<Real>> intersectTriangle(const Triangle& triangle, const Ray& ray) {
  const Shear<Real> shear(ray);
  const Vec<Real> a = shear(triangle.v0), b = shear(triangle.v1), c = shear(triangle.v2);
  const Real wa = determinant(b.x, c.y, b.y, c.x), wb = determinant(c.x, a.y, c.y, a.x),
             wc = determinant(a.x, b.y, a.y, b.x);
  const bool inFront = wa >= 0 && wb >= 0 && wc >= 0, fromBehind = wa <= 0 && wb <= 0 && wc <= 0;
  if (!inFront && !fromBehind) return std::nullopt;
  const Real sum = wa + wb + wc;
  if (sum == 0) return std::nullopt;
  TriangleHit<Real> hit;
  hit.t = (wa * a.z + wb * b.z + wc * c.z) / sum;
  hit.u = wb / sum;
  hit.v = wc / sum;
  if (!(hit.t >= Real(ray.tMin) && hit.t <= Real(ray.tMax))) return std::nullopt;
  return hit;
}

template <class Real>
std::optional<TriangleHit<Real>> closestHitNaive(std::span<const Triangle> triangles, const Ray& ray) {
  std::optional<TriangleHit<Real>> best;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    auto hit = intersectTriangle<Real>(triangles[i], ray);
    if (!hit) continue;
    hit->id = static_cast<std::uint32_t>(i);
    if (isNearer(*hit, best)) best = hit;
  }
  return best;
}

template std::optional<TriangleHit<double>> intersectTriangle(const Triangle&, const Ray&);
template std::optional<TriangleHit<long double>> intersectTriangle(const Triangle&, const Ray&);
template std::optional<TriangleHit<double>> closestHitNaive(std::span<const Triangle>, const Ray&);
template std::optional<TriangleHit<long double>> closestHitNaive(std::span<const Triangle>, const Ray&);

namespace {

// The triangle test may accept a ray that passes outside by its rounding error. Sheared coordinates are at most 2 L, L
// the distance of the box's farthest corner, and carry three roundings; an edge function thus errs by less than
// 64 * 2^-53 L^2, that is a distance of 64 * 2^-53 L^2 / e at an edge of length e. Widening boxes by 2^-30 L covers all
// edges longer than 2^-17 L.
constexpr double kWidening = 0x1p-30;

bool entersBefore(const glm::vec3& lower, const glm::vec3& upper, const Ray& ray, double limit) {
  if (!(lower.x <= upper.x)) return false;
  double farthest = 0;
  for (int i = 0; i < 3; ++i) {
    farthest = std::max({farthest, std::abs(lower[i] - ray.origin[i]), std::abs(upper[i] - ray.origin[i])});
  }
  const double margin = farthest * kWidening;
  double enter = ray.tMin, leave = std::min(ray.tMax, limit);
  for (int i = 0; i < 3; ++i) {
    const double below = lower[i] - ray.origin[i] - margin, above = upper[i] - ray.origin[i] + margin;
    const double d = ray.direction[i];
    if (d == 0) {
      if (below > 0 || above < 0) return false;
      continue;
    }
    enter = std::max(enter, (d > 0 ? below : above) / d);
    leave = std::min(leave, (d > 0 ? above : below) / d);
  }
  return enter <= leave;
}

}  // namespace

std::optional<TriangleHit<double>> closestHit(const Bvh& bvh, std::span<const Triangle> triangles, const Ray& ray) {
  std::optional<TriangleHit<double>> best;
  std::array<std::uint32_t, shared::kBvhStackSize> stack;
  std::size_t size = 0;
  const auto visit = [&](std::uint32_t child) {
    if (!bvhIsLeaf(child)) {
      CL_CHECK_LT(size, stack.size());
      stack[size++] = child;
      return;
    }
    for (std::uint32_t i = 0; i < bvhLeafCount(child); ++i) {
      const std::uint32_t id = bvh.order[bvhLeafFirst(child) + i];
      auto hit = intersectTriangle<double>(triangles[id], ray);
      if (!hit) continue;
      hit->id = id;
      if (isNearer(*hit, best)) best = hit;
    }
  };
  visit(0);
  while (size > 0) {
    const shared::BvhNode& node = bvh.nodes[stack[--size]];
    if (entersBefore(node.lower0, node.upper0, ray, best ? best->t : ray.tMax)) visit(node.child0);
    if (entersBefore(node.lower1, node.upper1, ray, best ? best->t : ray.tMax)) visit(node.child1);
  }
  return best;
}

}  // namespace crosslight::oracle

// Roots of the torus' quartic by bisection between the roots of its derivatives: slow, but every step has a bracket.
#include "accel/intersect_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace crosslight::oracle {
namespace {

// x^4 + c2 x^2 + c1 x + c0: the cubic term vanishes, because the line is centered.
struct Quartic {
  Real c2, c1, c0;
  Real magnitude;  // sum of the absolute values of what c0 was computed from

  Real value(Real x) const { return ((x * x + c2) * x + c1) * x + c0; }
  Real slope(Real x) const { return (4 * x * x + 2 * c2) * x + c1; }
  // A value this small may be zero. c0 has about 16 roundings of terms below `magnitude`, Horner's scheme six more;
  // 32 covers both.
  Real uncertainty(Real x) const {
    const Real a = std::abs(x);
    return 32 * std::numeric_limits<Real>::epsilon() * (((a * a + std::abs(c2)) * a + std::abs(c1)) * a + magnitude);
  }
};

// Root of a function that is monotone between `low` and `high`, where its signs differ.
template <class F>
Real bisect(const F& f, Real low, Real high) {
  const bool rising = f(high) > 0;
  while (true) {
    const Real middle = low + (high - low) / 2;
    if (!(middle > low && middle < high)) return middle;
    ((f(middle) > 0) == rising ? high : low) = middle;
  }
}

// Zeros within [points.front(), points.back()] of a function that is monotone between neighboring points.
template <class F>
std::vector<Real> zerosBetween(const F& f, const std::vector<Real>& points) {
  std::vector<Real> zeros;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Real a = f(points[i]), b = f(points[i + 1]);
    if ((a < 0 && b > 0) || (a > 0 && b < 0)) zeros.push_back(bisect(f, points[i], points[i + 1]));
  }
  return zeros;
}

}  // namespace

// (|p|^2 + R^2 - r^2)^2 = 4 R^2 (x^2 + z^2) with p = o + s d, o.d = 0, |d| = 1.
std::vector<Real> torusRoots(const CenteredLine& line, Real centerRadius, Real tubeRadius) {
  const Vec3 &o = line.origin, &d = line.direction;
  const Real reach = centerRadius + tubeRadius;
  if (dot(o, o) > reach * reach * (1 + 8 * std::numeric_limits<Real>::epsilon())) return {};
  const Real fourR2 = 4 * centerRadius * centerRadius;
  const Real k = dot(o, o) + (centerRadius - tubeRadius) * (centerRadius + tubeRadius);
  Quartic q;
  q.c2 = 2 * k - fourR2 * (d.x * d.x + d.z * d.z);
  q.c1 = -2 * fourR2 * (o.x * d.x + o.z * d.z);
  q.c0 = k * k - fourR2 * (o.x * o.x + o.z * o.z);
  q.magnitude = k * k + fourR2 * (o.x * o.x + o.z * o.z);

  const Real end = 2 * reach;  // the surface lies within |s| <= reach
  std::vector<Real> inflections{-end, end};
  if (q.c2 < 0) {
    const Real inflection = std::sqrt(-q.c2 / 6);
    inflections = {-end, std::max(-inflection, -end), std::min(inflection, end), end};
  }
  const auto slope = [&](Real s) { return q.slope(s); };
  const auto value = [&](Real s) { return q.value(s); };
  std::vector<Real> extrema = zerosBetween(slope, inflections);
  // A double zero of the slope does not change its sign; the value may still touch zero there (an inflection).
  for (const Real s : inflections) {
    if (std::abs(s) < end) extrema.push_back(s);
  }
  extrema.push_back(0);  // symmetric lines have an extremum exactly here
  std::sort(extrema.begin(), extrema.end());

  std::vector<Real> points{-end};
  points.insert(points.end(), extrema.begin(), extrema.end());
  points.push_back(end);
  std::vector<Real> roots = zerosBetween(value, points);
  // Tangent: the value touches zero at an extremum without a crossing that bisection could have found.
  for (const Real s : extrema) {
    const bool isExtremum =
        std::abs(q.slope(s)) <=
        32 * std::numeric_limits<Real>::epsilon() * ((4 * s * s + 2 * std::abs(q.c2)) * std::abs(s) + std::abs(q.c1));
    if (isExtremum && std::abs(q.value(s)) <= q.uncertainty(s)) roots.push_back(s);
  }
  std::sort(roots.begin(), roots.end());
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  return roots;
}

Vec3 torusGradient(const Vec3& p, Real centerRadius, Real tubeRadius) {
  const Real k = dot(p, p) + (centerRadius - tubeRadius) * (centerRadius + tubeRadius);
  const Real twoR2 = 2 * centerRadius * centerRadius;
  return {p.x * (k - twoR2), p.y * k, p.z * (k - twoR2)};
}

}  // namespace crosslight::oracle

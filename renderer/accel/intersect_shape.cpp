// Shape oracles in long double. A line meets a convex solid in one interval: the intersection of the intervals of the
// simpler sets that make up the solid (slabs, an infinite cylinder, a cone). Each end knows the surface that set it.
#include "accel/intersect_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "accel/intersect.h"
#include "base/check.h"

namespace crosslight::oracle {
namespace {

constexpr Real kInfinity = std::numeric_limits<Real>::infinity();

enum class Surface { none, capX, capY, capZ, side };

struct End {
  Real s = 0;
  Surface surface = Surface::none;
};

// All s with enter <= s <= leave; empty if enter.s > leave.s.
struct Interval {
  End enter{-kInfinity, Surface::none};
  End leave{kInfinity, Surface::none};

  void clip(Real from, Real to, Surface surface) {
    if (from > enter.s) enter = {from, surface};
    if (to < leave.s) leave = {to, surface};
  }
  void makeEmpty() { clip(kInfinity, -kInfinity, Surface::none); }
  bool empty() const { return !(enter.s <= leave.s); }
};

// |coordinate| <= half
void clipSlab(Interval& interval, Real origin, Real direction, Real half, Surface surface) {
  if (direction == 0) {
    if (std::abs(origin) > half) interval.makeEmpty();
    return;
  }
  const Real a = (-half - origin) / direction, b = (half - origin) / direction;
  interval.clip(std::min(a, b), std::max(a, b), surface);
}

// All s with a s^2 + 2 b s + c <= 0, of which a negative `a` leaves two rays: `lowerRay` tells which one is meant.
// Roots without cancellation: Press et al., "Numerical Recipes", section "Quadratic and Cubic Equations".
void clipQuadratic(Interval& interval, Real a, Real b, Real c, bool lowerRay) {
  if (a == 0 && b == 0) {
    if (c > 0) interval.makeEmpty();
    return;
  }
  if (a == 0) {
    const Real root = -c / (2 * b);
    return b > 0 ? interval.clip(-kInfinity, root, Surface::side) : interval.clip(root, kInfinity, Surface::side);
  }
  const Real discriminant = b * b - a * c;
  if (discriminant < 0 && a > 0) return interval.makeEmpty();
  // With a < 0 the line runs within the cone's directions and meets both halves: below 0 is rounding only.
  const Real q = -(b + std::copysign(std::sqrt(std::max(discriminant, Real{0})), b));
  const Real first = q / a, second = q == 0 ? first : c / q;
  const Real low = std::min(first, second), high = std::max(first, second);
  if (a > 0) return interval.clip(low, high, Surface::side);
  return lowerRay ? interval.clip(-kInfinity, low, Surface::side) : interval.clip(high, kInfinity, Surface::side);
}

Interval sphereInterval(const CenteredLine& line, Real radius) {
  Interval interval;
  const Real distance = std::sqrt(dot(line.origin, line.origin));
  if (distance > radius) {
    interval.makeEmpty();
  } else {
    const Real half = std::sqrt((radius - distance) * (radius + distance));
    interval.clip(-half, half, Surface::side);
  }
  return interval;
}

Interval boxInterval(const CenteredLine& line, const Vec3& size) {
  Interval interval;
  clipSlab(interval, line.origin.x, line.direction.x, size.x / 2, Surface::capX);
  clipSlab(interval, line.origin.y, line.direction.y, size.y / 2, Surface::capY);
  clipSlab(interval, line.origin.z, line.direction.z, size.z / 2, Surface::capZ);
  return interval;
}

Interval cylinderInterval(const CenteredLine& line, Real radius, Real height) {
  const Vec3 &o = line.origin, &d = line.direction;
  Interval interval;
  clipSlab(interval, o.y, d.y, height / 2, Surface::capY);
  clipQuadratic(interval, d.x * d.x + d.z * d.z, o.x * d.x + o.z * d.z, o.x * o.x + o.z * o.z - radius * radius, false);
  return interval;
}

// x^2 + z^2 <= (k (height/2 - y))^2, k = radius / height. The other half of the double cone lies above the slab.
Interval coneInterval(const CenteredLine& line, Real radius, Real height) {
  const Vec3 &o = line.origin, &d = line.direction;
  const Real k = radius / height, below = k * (height / 2 - o.y), slope = -k * d.y;
  Interval interval;
  clipSlab(interval, o.y, d.y, height / 2, Surface::capY);
  clipQuadratic(interval, d.x * d.x + d.z * d.z - slope * slope, o.x * d.x + o.z * d.z - below * slope,
                o.x * o.x + o.z * o.z - below * below, d.y > 0);
  return interval;
}

Vec3 unitOr(const Vec3& v, const Vec3& otherwise) {
  const Real length = std::sqrt(dot(v, v));
  return length > 0 ? v / length : otherwise;
}

Vec3 capNormal(Real coordinate, int axis) {
  Vec3 n{0};
  n[axis] = coordinate < 0 ? Real{-1} : Real{1};
  return n;
}

Vec3 normalAt(ShapeKind kind, const glm::vec4& params, const Vec3& p, Surface surface) {
  const Vec3 up{0, 1, 0};
  switch (surface) {
    case Surface::capX:
      return capNormal(p.x, 0);
    case Surface::capY:
      return capNormal(p.y, 1);
    case Surface::capZ:
      return capNormal(p.z, 2);
    default:
      break;
  }
  if (kind == ShapeKind::sphere) return unitOr(p, up);
  if (kind == ShapeKind::cylinder) return unitOr({p.x, 0, p.z}, up);
  const Real axisDistance = std::sqrt(p.x * p.x + p.z * p.z);
  const Real slope = Real{params.x} / Real{params.y};
  return axisDistance > 0 ? unitOr({p.x, axisDistance * slope, p.z}, up) : up;
}

struct Crossing {
  Real s;
  Vec3 normal;
};

std::vector<Crossing> convexCrossings(ShapeKind kind, const glm::vec4& params, const CenteredLine& line) {
  Interval interval;
  switch (kind) {
    case ShapeKind::sphere:
      interval = sphereInterval(line, params.x);
      break;
    case ShapeKind::box:
      interval = boxInterval(line, Vec3(params));
      break;
    case ShapeKind::cylinder:
      interval = cylinderInterval(line, params.x, params.y);
      break;
    case ShapeKind::cone:
      interval = coneInterval(line, params.x, params.y);
      break;
    default:
      CL_CHECK(!"a convex solid");
  }
  if (interval.empty()) return {};
  std::vector<Crossing> result;
  for (const End& end : {interval.enter, interval.leave}) {
    if (!result.empty() && result.front().s == end.s) continue;
    result.push_back({end.s, normalAt(kind, params, line.at(end.s), end.surface)});
  }
  return result;
}

std::vector<Crossing> flatCrossings(ShapeKind kind, const glm::vec4& params, const CenteredLine& line) {
  if (line.direction.y == 0) return {};
  const Real s = -line.origin.y / line.direction.y;
  const Vec3 p = line.at(s);
  if (kind == ShapeKind::disk && p.x * p.x + p.z * p.z > Real{params.x} * Real{params.x}) return {};
  return {{s, {0, 1, 0}}};
}

std::vector<Crossing> torusCrossings(const glm::vec4& params, const CenteredLine& line) {
  std::vector<Crossing> result;
  for (const Real s : torusRoots(line, params.x, params.y)) {
    result.push_back({s, unitOr(torusGradient(line.at(s), params.x, params.y), {0, 1, 0})});
  }
  return result;
}

}  // namespace

std::vector<ShapeHit> shapeHits(ShapeKind kind, const glm::vec4& params, const Ray& ray) {
  const Vec3 origin(ray.origin), direction(ray.direction);
  const Real length = std::sqrt(dot(direction, direction));
  if (!(length > 0) || !std::isfinite(length)) return {};
  CenteredLine line;
  line.direction = direction / length;
  // Twice: the first step leaves an error of the far origin's size.
  const Real far = -dot(origin, line.direction);
  const Vec3 nearly = origin + far * line.direction;
  const Real rest = -dot(nearly, line.direction);
  line.origin = nearly + rest * line.direction;

  std::vector<Crossing> crossings;
  if (kind == ShapeKind::torus) {
    crossings = torusCrossings(params, line);
  } else if (kind == ShapeKind::plane || kind == ShapeKind::disk) {
    crossings = flatCrossings(kind, params, line);
  } else {
    crossings = convexCrossings(kind, params, line);
  }
  std::vector<ShapeHit> hits;
  for (const Crossing& crossing : crossings) {
    const Real t = (crossing.s + rest + far) / length;
    if (!(t >= Real{ray.tMin} && t <= Real{ray.tMax})) continue;
    hits.push_back({static_cast<double>(t), glm::dvec3(line.at(crossing.s)), glm::dvec3(crossing.normal)});
  }
  return hits;
}

std::optional<ShapeHit> closestShapeHit(ShapeKind kind, const glm::vec4& params, const Ray& ray) {
  const std::vector<ShapeHit> hits = shapeHits(kind, params, ray);
  if (hits.empty()) return std::nullopt;
  return hits.front();
}

}  // namespace crosslight::oracle

// What the shape oracles share; private to the room.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace crosslight::oracle {

using Real = long double;
using Vec3 = glm::vec<3, Real, glm::highp>;

inline Real dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// A line with unit direction whose origin is its point nearest to the object space's origin: the equations' terms stay
// as small as the shape, however far the ray starts. s counts in units of length.
struct CenteredLine {
  Vec3 origin;
  Vec3 direction;

  Vec3 at(Real s) const { return origin + s * direction; }
};

// Roots of the torus' equation along the line, ascending; a double root once or, split by rounding, twice.
std::vector<Real> torusRoots(const CenteredLine& line, Real centerRadius, Real tubeRadius);

// Gradient of the torus' equation: outward, not unit.
Vec3 torusGradient(const Vec3& p, Real centerRadius, Real tubeRadius);

}  // namespace crosslight::oracle

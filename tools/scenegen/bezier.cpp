// Bernstein's form throughout: its end weights are exactly 0 and 1.
#include "scenegen/bezier.h"

#include <glm/geometric.hpp>

namespace crosslight::scenegen {
namespace {

using Weights = std::array<double, 4>;

Weights bernstein(double t) {
  const double s = 1.0 - t;
  return {s * s * s, 3.0 * t * s * s, 3.0 * t * t * s, t * t * t};
}

Weights bernsteinDerivative(double t) {
  const double s = 1.0 - t;
  return {-3.0 * s * s, 3.0 * s * s - 6.0 * t * s, 6.0 * t * s - 3.0 * t * t, 3.0 * t * t};
}

glm::dvec3 combine(const BezierPatch& patch, const Weights& u, const Weights& v) {
  glm::dvec3 sum(0.0);
  for (std::size_t j = 0; j < 4; ++j) {
    glm::dvec3 row(0.0);
    for (std::size_t i = 0; i < 4; ++i) row += u[i] * patch.points[j][i];
    sum += v[j] * row;
  }
  return sum;
}

}  // namespace

glm::dvec3 pointAt(const BezierPatch& patch, double u, double v) { return combine(patch, bernstein(u), bernstein(v)); }

glm::dvec3 derivativeU(const BezierPatch& patch, double u, double v) {
  return combine(patch, bernsteinDerivative(u), bernstein(v));
}

glm::dvec3 derivativeV(const BezierPatch& patch, double u, double v) {
  return combine(patch, bernstein(u), bernsteinDerivative(v));
}

glm::dvec3 derivativeUV(const BezierPatch& patch, double u, double v) {
  return combine(patch, bernsteinDerivative(u), bernsteinDerivative(v));
}

glm::dvec3 normalAt(const BezierPatch& patch, double u, double v) {
  const std::size_t edge = v == 1.0 ? 3 : 0;
  const auto& row = patch.points[edge];
  const bool collapsed = (v == 0.0 || v == 1.0) && row[0] == row[1] && row[1] == row[2] && row[2] == row[3];
  if (!collapsed) return glm::normalize(glm::cross(derivativeU(patch, u, v), derivativeV(patch, u, v)));
  // du grows from zero as (distance from the edge) * d2/dudv inwards, and inwards is -v at v = 1.
  const double inwards = v == 0.0 ? 1.0 : -1.0;
  return glm::normalize(glm::cross(inwards * derivativeUV(patch, u, v), derivativeV(patch, u, v)));
}

}  // namespace crosslight::scenegen

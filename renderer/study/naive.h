// Textbook formulas in single precision, as cases are judged against: what the renderer must do better than.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace crosslight::study::naive {

// Moeller, Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection".
inline bool hitsTriangle(const glm::vec3& o, const glm::vec3& d, const glm::vec3& a, const glm::vec3& b,
                         const glm::vec3& c) {
  const glm::vec3 e1 = b - a, e2 = c - a, p = glm::cross(d, e2), s = o - a, q = glm::cross(s, e1);
  const float det = glm::dot(e1, p), u = glm::dot(s, p) / det, v = glm::dot(d, q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && glm::dot(e2, q) / det > 0;
}

// Where the ray meets the plane n.p = c: o + t d, moved along the normal by a fixed offset.
inline glm::vec3 pointOnPlane(const glm::vec3& o, const glm::vec3& d, const glm::vec3& n, float c, float offset) {
  const float t = (c - glm::dot(n, o)) / glm::dot(n, d);
  return o + t * d + offset * n;
}

// Kay, Kajiya 1986, "Ray Tracing Complex Scenes": slabs by min and max as processors have them, which lose a NaN that
// is their first operand.
inline bool hitsBox(const glm::vec3& o, const glm::vec3& d, const glm::vec3& low, const glm::vec3& high) {
  const auto lower = [](float a, float b) { return a < b ? a : b; };
  const auto upper = [](float a, float b) { return a > b ? a : b; };
  float t0 = 0, t1 = 3e38f;
  for (int i = 0; i < 3; ++i) {
    const float inverse = 1 / d[i], a = (low[i] - o[i]) * inverse, b = (high[i] - o[i]) * inverse;
    t0 = upper(lower(a, b), t0);
    t1 = lower(upper(a, b), t1);
  }
  return t0 <= t1;
}

}  // namespace crosslight::study::naive

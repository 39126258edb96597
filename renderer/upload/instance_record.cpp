#include "upload/instance_record.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace crosslight {
namespace {

constexpr double kUnitRoundoff = 0x1p-24;
// kMarginRoundings of shaders/accel/instances.glsl, where its derivation stands.
constexpr double kRoundings = 24.0;
constexpr double kMargin = kRoundings * kUnitRoundoff / (1.0 - kRoundings * kUnitRoundoff);
constexpr double kLargestMargin = 1.0 / 256.0;  // of the box: beyond, rays would walk through most of the tree

float roundedUp(double x) { return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity()); }

glm::dvec3 largestCoordinates(const DBounds& box) { return glm::max(glm::abs(box.lower), glm::abs(box.upper)); }

shared::InstanceRecord recordOf(const glm::dmat3& objectFromRender, const glm::dvec3& shift,
                                const glm::dvec3& renderReach) {
  shared::InstanceRecord record{};
  glm::vec4* const rows[] = {&record.objectFromRenderX, &record.objectFromRenderY, &record.objectFromRenderZ};
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 row(objectFromRender[0][i], objectFromRender[1][i], objectFromRender[2][i]);
    *rows[i] = glm::vec4(glm::vec3(row), static_cast<float>(shift[i]));
    record.margin[i] = roundedUp(kMargin * (glm::dot(glm::abs(row), renderReach) + std::abs(shift[i])));
  }
  return record;
}

bool isFinite(const shared::InstanceRecord& record) {
  for (const glm::vec4& row : {record.objectFromRenderX, record.objectFromRenderY, record.objectFromRenderZ}) {
    for (int i = 0; i < 4; ++i) {
      if (!std::isfinite(row[i])) return false;
    }
  }
  return std::isfinite(record.margin.x) && std::isfinite(record.margin.y) && std::isfinite(record.margin.z);
}

// Entries that are denormal have lost bits; beside a largest one of this size that is below its own rounding.
bool keepsItsBits(const shared::InstanceRecord& record) {
  constexpr float kLeast = std::numeric_limits<float>::min() * 0x1p24f;
  for (const glm::vec4& row : {record.objectFromRenderX, record.objectFromRenderY, record.objectFromRenderZ}) {
    if (!(std::max({std::abs(row.x), std::abs(row.y), std::abs(row.z)}) > kLeast)) return false;
  }
  return true;
}

}  // namespace

DBounds boundsOf(const Mesh& mesh) {
  DBounds box;
  for (const Primitive& p : mesh.primitives) {
    if (p.indices.size() < 3) continue;
    for (const glm::vec3& v : p.positions) box.add(glm::dvec3(v));
  }
  return box;
}

DBounds moved(const DBounds& box, const glm::dmat3& linear, const glm::dvec3& shift) {
  DBounds result;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p((corner & 1) ? box.upper.x : box.lower.x, (corner & 2) ? box.upper.y : box.lower.y,
                       (corner & 4) ? box.upper.z : box.lower.z);
    result.add(linear * p + shift);
  }
  return result;
}

std::optional<shared::InstanceRecord> objectMap(const glm::dmat4& worldFromObject, const glm::dvec3& origin,
                                                const DBounds& box) {
  const glm::dmat3 linear(worldFromObject);
  const glm::dvec3 renderShift = glm::dvec3(worldFromObject[3]) - origin;
  double largest = 0;
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) largest = std::max(largest, std::abs(linear[c][r]));
  }
  if (!(largest > 0) || !std::isfinite(largest) || box.empty()) return std::nullopt;
  // Scaled first: the determinant of a node scaled by 1e-120 must not vanish. What double loses in the inverse is below
  // a float's rounding of it as long as the margin, which grows with the transform's condition, is as small as asked.
  const glm::dmat3 inverse = glm::inverse(linear / largest) / largest;
  const glm::dvec3 reach = largestCoordinates(moved(box, linear, renderShift));
  const shared::InstanceRecord record = recordOf(inverse, -(inverse * renderShift), reach);
  if (!isFinite(record) || !keepsItsBits(record)) return std::nullopt;
  const glm::dvec3 extent = box.upper - box.lower;
  const double most = kLargestMargin * std::max({extent.x, extent.y, extent.z});
  const double margin = std::max({record.margin.x, record.margin.y, record.margin.z});
  return margin <= most ? std::optional(record) : std::nullopt;
}

shared::InstanceRecord renderSpaceMap(const Bounds& box) {
  return recordOf(glm::dmat3(1.0), glm::dvec3(0.0), largestCoordinates({glm::dvec3(box.lower), glm::dvec3(box.upper)}));
}

Bounds widened(const Bounds& box) {
  const glm::dvec3 reach = largestCoordinates({glm::dvec3(box.lower), glm::dvec3(box.upper)});
  Bounds result;
  for (int i = 0; i < 3; ++i) {
    result.lower[i] =
        std::nextafter(static_cast<float>(box.lower[i] - kMargin * reach[i]), -std::numeric_limits<float>::infinity());
    result.upper[i] = roundedUp(box.upper[i] + kMargin * reach[i]);
  }
  return result;
}

}  // namespace crosslight

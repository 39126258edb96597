// Normals and tangents that a file does not have, or not in a form that can be used.
#include "scene/mesh_repair.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace crosslight {
namespace {

template <class T>
void gather(std::vector<T>& values, const std::vector<std::uint32_t>& indices) {
  if (values.empty()) return;
  std::vector<T> gathered;
  gathered.reserve(indices.size());
  for (const std::uint32_t index : indices) gathered.push_back(values[index]);
  values = std::move(gathered);
}

// Scaled by the largest part first, so that no square leaves the range of a double.
glm::dvec3 safeNormalize(const glm::dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0.0) || !std::isfinite(largest)) return glm::dvec3(0.0);
  return glm::normalize(v / largest);
}

bool isZero(const glm::dvec3& v) { return v == glm::dvec3(0.0); }

template <class Vector>
bool allFinite(const Vector& v) {
  for (int i = 0; i < Vector::length(); ++i) {
    if (!std::isfinite(v[i])) return false;
  }
  return true;
}

glm::dvec3 orthogonalPart(const glm::dvec3& v, const glm::dvec3& n) { return v - n * glm::dot(n, v); }

}  // namespace

glm::dvec3 anyAcross(const glm::dvec3& n) {
  const glm::dvec3 size = glm::abs(n);
  const glm::dvec3 axis = size.x <= size.y && size.x <= size.z ? glm::dvec3(1.0, 0.0, 0.0)
                          : size.y <= size.z                   ? glm::dvec3(0.0, 1.0, 0.0)
                                                               : glm::dvec3(0.0, 0.0, 1.0);
  const glm::dvec3 tangent = safeNormalize(glm::cross(axis, n));
  return isZero(tangent) ? glm::dvec3(1.0, 0.0, 0.0) : tangent;
}

double cornerAngle(const Primitive& primitive, std::size_t triangle, std::size_t corner) {
  const auto at = [&](std::size_t c) {
    return glm::dvec3(primitive.positions[primitive.indices[triangle * 3 + (corner + c) % 3]]);
  };
  const glm::dvec3 a = safeNormalize(at(1) - at(0));
  const glm::dvec3 b = safeNormalize(at(2) - at(0));
  // Well-conditioned at all angles, unlike acos of the dot product.
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

std::uint32_t duplicateVertex(Primitive& primitive, std::uint32_t vertex) {
  const auto copy = [vertex](auto& values) {
    if (!values.empty()) values.push_back(values[vertex]);
  };
  const auto index = static_cast<std::uint32_t>(primitive.positions.size());
  copy(primitive.positions);
  copy(primitive.normals);
  copy(primitive.tangents);
  copy(primitive.uv0);
  copy(primitive.uv1);
  copy(primitive.colors);
  return index;
}

glm::dvec3 triangleCross(const Primitive& primitive, std::size_t triangle) {
  const auto at = [&](std::size_t c) { return glm::dvec3(primitive.positions[primitive.indices[triangle * 3 + c]]); };
  return glm::cross(at(1) - at(0), at(2) - at(0));
}

void splitVertices(Primitive& primitive) {
  gather(primitive.positions, primitive.indices);
  gather(primitive.normals, primitive.indices);
  gather(primitive.tangents, primitive.indices);
  gather(primitive.uv0, primitive.indices);
  gather(primitive.uv1, primitive.indices);
  gather(primitive.colors, primitive.indices);
  for (std::size_t i = 0; i < primitive.indices.size(); ++i) primitive.indices[i] = static_cast<std::uint32_t>(i);
}

void makeFlatNormals(Primitive& primitive) {
  primitive.normals.clear();
  primitive.tangents.clear();
  splitVertices(primitive);
  primitive.normals.resize(primitive.positions.size());
  for (std::size_t triangle = 0; triangle * 3 < primitive.indices.size(); ++triangle) {
    const glm::vec3 normal(safeNormalize(triangleCross(primitive, triangle)));
    for (std::size_t corner = 0; corner < 3; ++corner) primitive.normals[triangle * 3 + corner] = normal;
  }
  primitive.flatNormals = true;
}

std::size_t repairNormals(Primitive& primitive) {
  std::vector<bool> broken(primitive.normals.size(), false);
  std::size_t count = 0;
  for (std::size_t i = 0; i < primitive.normals.size(); ++i) {
    const glm::dvec3 unit = safeNormalize(glm::dvec3(primitive.normals[i]));
    broken[i] = isZero(unit) || !allFinite(primitive.normals[i]);
    primitive.normals[i] = broken[i] ? glm::vec3(0.0f) : glm::vec3(unit);
    if (broken[i]) ++count;
  }
  if (count == 0) return 0;
  for (std::size_t triangle = 0; triangle * 3 < primitive.indices.size(); ++triangle) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = primitive.indices[triangle * 3 + corner];
      if (!broken[vertex]) continue;
      const glm::dvec3 normal = safeNormalize(triangleCross(primitive, triangle));
      if (isZero(normal)) continue;
      primitive.normals[vertex] = glm::vec3(normal);
      broken[vertex] = false;
    }
  }
  return count;
}

std::size_t repairTangents(Primitive& primitive) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < primitive.tangents.size(); ++i) {
    const glm::vec4 tangent = primitive.tangents[i];
    const glm::dvec3 n(primitive.normals[i]);
    glm::dvec3 unit = safeNormalize(orthogonalPart(safeNormalize(glm::dvec3(tangent)), n));
    if (isZero(unit) || !allFinite(tangent)) {
      unit = anyAcross(n);
      ++count;
    }
    primitive.tangents[i] = glm::vec4(glm::vec3(unit), tangent.w < 0.0f ? -1.0f : 1.0f);
  }
  return count;
}

}  // namespace crosslight

#include "scenegen/meshes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>

#include "base/check.h"

namespace crosslight::scenegen {
namespace {

using glm::dvec2;
using glm::dvec3;
constexpr double kPi = std::numbers::pi;

std::uint32_t addVertex(Primitive& mesh, const dvec3& p, const dvec3& n, const dvec2& uv) {
  mesh.positions.emplace_back(p + 0.0);
  mesh.normals.emplace_back(n + 0.0);
  mesh.uv0.emplace_back(uv);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

void addQuad(Primitive& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
}

}  // namespace

Primitive gridMesh(const dvec3& center, const dvec3& halfU, const dvec3& halfV, int steps) {
  Primitive mesh;
  const dvec3 n = glm::normalize(glm::cross(halfU, halfV));
  for (int j = 0; j <= steps; ++j) {
    for (int i = 0; i <= steps; ++i) {
      const double s = static_cast<double>(i) / steps, t = static_cast<double>(j) / steps;
      addVertex(mesh, center + (2.0 * s - 1.0) * halfU + (2.0 * t - 1.0) * halfV, n, {s, 1.0 - t});
    }
  }
  const auto columns = static_cast<std::uint32_t>(steps);
  for (std::uint32_t j = 0; j < columns; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * (columns + 1) + i, d = a + columns + 1;
      addQuad(mesh, a, a + 1, d + 1, d);
    }
  }
  return mesh;
}

Primitive checkerMesh(double halfSize, int steps, int parity) {
  Primitive mesh;
  const auto along = [&](int i) { return halfSize * ((2.0 * i - steps) / steps); };
  const dvec3 up(0.0, 1.0, 0.0);
  for (int j = 0; j < steps; ++j) {
    for (int i = 0; i < steps; ++i) {
      if ((i + j) % 2 != parity) continue;
      const double x0 = along(i), x1 = along(i + 1), z0 = along(j), z1 = along(j + 1);
      const std::uint32_t a = addVertex(mesh, {x0, 0.0, z1}, up, {0.0, 1.0});
      const std::uint32_t b = addVertex(mesh, {x1, 0.0, z1}, up, {1.0, 1.0});
      const std::uint32_t c = addVertex(mesh, {x1, 0.0, z0}, up, {1.0, 0.0});
      addQuad(mesh, a, b, c, addVertex(mesh, {x0, 0.0, z0}, up, {0.0, 0.0}));
    }
  }
  return mesh;
}

Primitive quadMesh(std::span<const std::array<dvec3, 4>> quads, const dvec3& toward) {
  Primitive mesh;
  for (auto corners : quads) {
    dvec3 n = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (glm::dot(n, toward - corners[0]) < 0.0) {
      std::swap(corners[1], corners[3]);
      n = -n;
    }
    n = glm::normalize(n);
    const std::uint32_t a = addVertex(mesh, corners[0], n, {0.0, 1.0});
    const std::uint32_t b = addVertex(mesh, corners[1], n, {1.0, 1.0});
    const std::uint32_t c = addVertex(mesh, corners[2], n, {1.0, 0.0});
    addQuad(mesh, a, b, c, addVertex(mesh, corners[3], n, {0.0, 0.0}));
  }
  return mesh;
}

// The curve lies on a torus, so that torus' normal is square to the curve: with the tangent it spans an exact frame,
// and the tube's normals are exactly radial.
Primitive torusKnotMesh(double ringRadius, double crossRadius, double tubeRadius, int stepsAlong, int stepsAround) {
  Primitive mesh;
  for (int i = 0; i <= stepsAlong; ++i) {
    const double t = 2.0 * kPi * (i % stepsAlong) / stepsAlong;
    const double r = ringRadius + crossRadius * std::cos(3.0 * t);
    const dvec3 ring(std::cos(2.0 * t), 0.0, std::sin(2.0 * t)), along(-ring.z, 0.0, ring.x), up(0.0, 1.0, 0.0);
    const dvec3 center = r * ring + crossRadius * std::sin(3.0 * t) * up;
    const dvec3 outward = std::cos(3.0 * t) * ring + std::sin(3.0 * t) * up;
    const dvec3 tangent = 2.0 * r * along + 3.0 * crossRadius * (std::cos(3.0 * t) * up - std::sin(3.0 * t) * ring);
    const dvec3 aside = glm::cross(glm::normalize(tangent), outward);
    for (int j = 0; j <= stepsAround; ++j) {
      const double angle = 2.0 * kPi * (j % stepsAround) / stepsAround;
      const dvec3 n = glm::normalize(std::cos(angle) * outward + std::sin(angle) * aside);
      const dvec2 uv(static_cast<double>(i) / stepsAlong, static_cast<double>(j) / stepsAround);
      addVertex(mesh, center + tubeRadius * n, n, uv);
    }
  }
  const auto stride = static_cast<std::uint32_t>(stepsAround + 1);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(stepsAlong); ++i) {
    for (std::uint32_t j = 0; j + 1 < stride; ++j) {
      const std::uint32_t a = i * stride + j;
      addQuad(mesh, a, a + 1, a + stride + 1, a + stride);
    }
  }
  return mesh;
}

// Pairs of duals: the one's vertices are the other's face normals.
std::vector<PlatonicSolid> platonicSolids() {
  const double golden = std::numbers::phi;
  std::vector<dvec3> tetrahedron, opposite, cube, octahedron, icosahedron, dodecahedron;
  for (int bits = 0; bits < 8; ++bits) {
    const dvec3 corner(bits & 1 ? 1.0 : -1.0, bits & 2 ? 1.0 : -1.0, bits & 4 ? 1.0 : -1.0);
    cube.push_back(corner);
    dodecahedron.push_back(corner);
    (corner.x * corner.y * corner.z > 0.0 ? tetrahedron : opposite).push_back(corner);
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (int signs = 0; signs < 4; ++signs) {
      const double a = signs & 1 ? 1.0 : -1.0, b = signs & 2 ? 1.0 : -1.0;
      dvec3 p(0.0);
      p[(axis + 1) % 3] = a;
      p[(axis + 2) % 3] = b * golden;
      icosahedron.push_back(p);
      p[(axis + 1) % 3] = b * golden;
      p[(axis + 2) % 3] = a / golden;
      dodecahedron.push_back(p);
    }
    octahedron.push_back(dvec3(axis == 0, axis == 1, axis == 2));
    octahedron.push_back(-octahedron.back());
  }
  for (auto* points : {&tetrahedron, &opposite, &cube, &octahedron, &icosahedron, &dodecahedron}) {
    for (dvec3& p : *points) p = glm::normalize(p);
  }
  return {{"tetrahedron", tetrahedron, opposite},
          {"cube", cube, octahedron},
          {"octahedron", octahedron, cube},
          {"dodecahedron", dodecahedron, icosahedron},
          {"icosahedron", icosahedron, dodecahedron}};
}

Primitive polyhedronMesh(const PlatonicSolid& solid) {
  Primitive mesh;
  mesh.flatNormals = true;
  for (const dvec3& p : solid.vertices) mesh.positions.emplace_back(p + 0.0);
  for (const dvec3& n : solid.faceNormals) {
    double farthest = 0.0;
    for (const dvec3& p : solid.vertices) farthest = std::max(farthest, glm::dot(p, n));
    const dvec3 side = std::abs(n.x) < 0.5 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
    const dvec3 u = glm::normalize(glm::cross(side, n)), v = glm::cross(n, u);
    std::vector<std::pair<double, std::uint32_t>> face;  // by angle, counter-clockwise
    for (std::uint32_t i = 0; i < solid.vertices.size(); ++i) {
      const dvec3& p = solid.vertices[i];
      // Heights of a solid's vertices over a face differ by more than 0.3; rounding is 1e-15.
      if (farthest - glm::dot(p, n) < 0.1) face.emplace_back(std::atan2(glm::dot(p, v), glm::dot(p, u)), i);
    }
    std::sort(face.begin(), face.end());
    for (std::size_t i = 2; i < face.size(); ++i) {
      mesh.indices.insert(mesh.indices.end(), {face[0].second, face[i - 1].second, face[i].second});
    }
  }
  return mesh;
}

Primitive transformed(const Primitive& mesh, const glm::dmat4& transform) {
  Primitive result = mesh;
  const glm::dmat3 m(transform);
  const glm::dmat3 cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  const bool mirrors = glm::dot(m[0], cofactor[0]) < 0.0;
  for (glm::vec3& p : result.positions) p = glm::vec3(dvec3(transform * glm::dvec4(dvec3(p), 1.0)) + 0.0);
  for (glm::vec3& n : result.normals) {
    n = glm::vec3(glm::normalize(cofactor * dvec3(n)) * (mirrors ? -1.0 : 1.0) + 0.0);
  }
  for (std::size_t i = 0; mirrors && i < result.indices.size(); i += 3) {
    std::swap(result.indices[i + 1], result.indices[i + 2]);
  }
  return result;
}

Primitive joined(const Primitive& a, const Primitive& b) {
  Primitive result = a;
  const auto base = static_cast<std::uint32_t>(a.positions.size());
  result.positions.insert(result.positions.end(), b.positions.begin(), b.positions.end());
  result.normals.insert(result.normals.end(), b.normals.begin(), b.normals.end());
  result.uv0.insert(result.uv0.end(), b.uv0.begin(), b.uv0.end());
  for (const std::uint32_t index : b.indices) result.indices.push_back(base + index);
  return result;
}

Primitive withoutUv(Primitive mesh) {
  mesh.uv0.clear();
  return mesh;
}

}  // namespace crosslight::scenegen

// Tessellations of the analytic shapes, their bounds, and the names of the lists' rows. Everything is computed in
// double and rounded once; texture coordinates are those of shaders/accel/shape_*.glsl, so that rays and raster agree.
#include "scene/shape_mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/check.h"

namespace crosslight {
namespace {

using glm::dvec2;
using glm::dvec3;

struct Sample {
  dvec3 position, normal;
};

// Point `i` of `count` on the unit circle, starting at angle -pi (texture coordinate 0). The angle is reduced to a
// quadrant before sine and cosine: points a quarter turn apart are exact rotations of each other, and first == last.
dvec2 onCircle(int i, int count) {
  const int turned = (4 * (i % count)) % count;
  const int quadrant = (4 * (i % count)) / count;
  const double angle = std::numbers::pi / 2 * turned / count;
  const double c = std::cos(angle), s = std::sin(angle);
  const dvec2 fromMinusX[4] = {{-c, -s}, {s, -c}, {c, s}, {-s, c}};
  return fromMinusX[quadrant];
}

// Point `i` of `count` on the half circle from the north pole (0, 1) to the south pole (0, -1): (sine, cosine).
dvec2 onMeridian(int i, int count) {
  if (2 * i > count) return onMeridian(count - i, count) * dvec2(1.0, -1.0);
  if (2 * i == count) return {1.0, 0.0};
  const double angle = std::numbers::pi * i / count;
  return {std::sin(angle), std::cos(angle)};
}

int stepsFor(double length, double step, int most) {
  return static_cast<int>(std::clamp(std::round(length / step), 1.0, static_cast<double>(most)));
}

std::uint32_t addVertex(Primitive& mesh, const Sample& s, const dvec2& uv) {
  mesh.positions.emplace_back(s.position + 0.0);  // + 0.0: no negative zeros, equal points have equal bits
  mesh.normals.emplace_back(s.normal + 0.0);
  mesh.uv0.emplace_back(uv);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

void addTriangle(Primitive& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

struct Grid {
  int columns = 1, rows = 1;
  bool collapsedFirst = false;  // all points of the first row are one: a pole
  bool collapsedLast = false;
  bool flipped = false;  // normal = dv x du instead of du x dv
};

// Columns x rows quads, each cut along its diagonal. A pole's vertex is repeated for each triangle that meets it, half
// a column further, because its longitude has no value there.
void addGrid(Primitive& mesh, const Grid& grid, const std::function<Sample(double column, int row)>& sample,
             const std::function<dvec2(double u, double v)>& uvAt) {
  std::vector<std::uint32_t> rowStart;
  for (int j = 0; j <= grid.rows; ++j) {
    const bool pole = (j == 0 && grid.collapsedFirst) || (j == grid.rows && grid.collapsedLast);
    rowStart.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    for (int i = 0; i < grid.columns + (pole ? 0 : 1); ++i) {
      const double column = pole ? i + 0.5 : i;
      addVertex(mesh, sample(column, j), uvAt(column / grid.columns, static_cast<double>(j) / grid.rows));
    }
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    grid.flipped ? addTriangle(mesh, a, c, b) : addTriangle(mesh, a, b, c);
  };
  for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(grid.rows); ++j) {
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(grid.columns); ++i) {
      const std::uint32_t a = rowStart[j] + i;
      const std::uint32_t d = rowStart[j + 1] + i;
      const bool atFirst = j == 0 && grid.collapsedFirst;
      const bool atLast = j + 1 == static_cast<std::uint32_t>(grid.rows) && grid.collapsedLast;
      if (!atFirst) add(a, a + 1, atLast ? d : d + 1);
      if (!atLast) add(a, d + 1, d);
    }
  }
}

// Columns may be halves at poles only, where the sine is 0 and the longitude matters for nothing but the normal.
dvec2 longitudeAt(double column, int segments) {
  const double doubled = 2.0 * column;
  return onCircle(static_cast<int>(doubled), 2 * segments);
}

dvec2 identityUv(double u, double v) { return {u, v}; }

Primitive sphereMesh(double radius, int segments) {
  Primitive mesh;
  const int rows = std::max(2, (segments + 1) / 2);
  const auto sample = [&](double column, int row) {
    const dvec2 around = longitudeAt(column, segments);
    const dvec2 down = onMeridian(row, rows);
    const dvec3 n(down.x * around.x, down.y, down.x * around.y);
    return Sample{radius * n, n};
  };
  addGrid(mesh, {.columns = segments, .rows = rows, .collapsedFirst = true, .collapsedLast = true}, sample, identityUv);
  return mesh;
}

// A disk at height y, facing up or down. The disk shape mirrors its v, the caps of cylinder and cone do not.
void addDisk(Primitive& mesh, double radius, double y, bool up, double vSign, int segments) {
  const int rows = stepsFor(segments / (2.0 * std::numbers::pi), 1.0, segments);
  const dvec3 n(0.0, up ? 1.0 : -1.0, 0.0);
  const auto pointAt = [&](double column, int row) {
    return longitudeAt(column, segments) * (static_cast<double>(row) / rows);
  };
  const auto sample = [&](double column, int row) {
    const dvec2 p = pointAt(column, row) * radius;
    return Sample{dvec3(p.x, y, p.y), n};
  };
  const auto uvAt = [&](double u, double v) {
    const dvec2 p = pointAt(u * segments, static_cast<int>(std::lround(v * rows)));
    return dvec2(0.5 + 0.5 * p.x, 0.5 + 0.5 * vSign * p.y);
  };
  addGrid(mesh, {.columns = segments, .rows = rows, .collapsedFirst = true, .flipped = !up}, sample, uvAt);
}

Primitive diskMesh(double radius, int segments) {
  Primitive mesh;
  addDisk(mesh, radius, 0.0, true, -1.0, segments);
  return mesh;
}

Primitive cylinderMesh(double radius, double height, int segments) {
  Primitive mesh;
  const int rows = stepsFor(height, 2.0 * std::numbers::pi * radius / segments, 4 * segments);
  const auto sample = [&](double column, int row) {
    const dvec2 around = longitudeAt(column, segments);
    const double y = height * (0.5 - static_cast<double>(row) / rows);
    return Sample{dvec3(radius * around.x, y, radius * around.y), dvec3(around.x, 0.0, around.y)};
  };
  addGrid(mesh, {.columns = segments, .rows = rows}, sample, identityUv);
  addDisk(mesh, radius, 0.5 * height, true, 1.0, segments);
  addDisk(mesh, radius, -0.5 * height, false, 1.0, segments);
  return mesh;
}

// The apex has a normal per triangle: that of the wall half way between its two other corners.
Primitive coneMesh(double radius, double height, int segments) {
  Primitive mesh;
  const double slant = std::hypot(radius, height);
  const int rows = stepsFor(slant, 2.0 * std::numbers::pi * radius / segments, 4 * segments);
  const auto sample = [&](double column, int row) {
    const dvec2 around = longitudeAt(column, segments);
    const double down = static_cast<double>(row) / rows;
    return Sample{dvec3(radius * down * around.x, height * (0.5 - down), radius * down * around.y),
                  dvec3(height * around.x, radius, height * around.y) / slant};
  };
  addGrid(mesh, {.columns = segments, .rows = rows, .collapsedFirst = true}, sample, identityUv);
  addDisk(mesh, radius, -0.5 * height, false, 1.0, segments);
  return mesh;
}

Primitive torusMesh(double ringRadius, double tubeRadius, int segments) {
  Primitive mesh;
  // Even, so that the outermost circle is one of the rows.
  const int rows = std::max(4, 2 * stepsFor(tubeRadius * segments, 2.0 * ringRadius, 2 * segments));
  const auto sample = [&](double column, int row) {
    const dvec2 around = longitudeAt(column, segments);
    const dvec2 across = onCircle(row, rows);
    const dvec3 n(across.x * around.x, across.y, across.x * around.y);
    return Sample{dvec3(ringRadius * around.x, 0.0, ringRadius * around.y) + tubeRadius * n, n};
  };
  addGrid(mesh, {.columns = segments, .rows = rows, .flipped = true}, sample, identityUv);
  return mesh;
}

// A rectangle spanned by two axes of the box. Coordinates along an edge come from the same expression on both faces
// that share it.
void addBoxFace(Primitive& mesh, const dvec3& size, const int steps[3], int axis, bool positive) {
  const int u = axis == 0 ? 2 : 0;
  const int v = axis == 1 ? 2 : 1;
  const dvec3 halfSize = 0.5 * size;
  dvec3 n(0.0);
  n[axis] = positive ? 1.0 : -1.0;
  const auto along = [&](int which, double i) {
    return halfSize[which] * ((2.0 * i - steps[which]) / static_cast<double>(steps[which]));
  };
  const auto sample = [&](double column, int row) {
    dvec3 p = n * halfSize;
    p[u] = along(u, column);
    p[v] = along(v, static_cast<double>(steps[v] - row));
    return Sample{p, n};
  };
  // du x dv with dv downwards: -(e_u x e_v), which is outward or not depending on axis and side.
  dvec3 du(0.0), dv(0.0);
  du[u] = 1.0;
  dv[v] = -1.0;
  const bool flipped = glm::dot(glm::cross(du, dv), n) < 0.0;
  addGrid(mesh, {.columns = steps[u], .rows = steps[v], .flipped = flipped}, sample, identityUv);
}

Primitive boxMesh(const dvec3& size, int segments) {
  Primitive mesh;
  const double step = 2.0 * (size.x + size.z) / segments;
  const int steps[3] = {stepsFor(size.x, step, segments), stepsFor(size.y, step, 4 * segments),
                        stepsFor(size.z, step, segments)};
  for (int axis = 0; axis < 3; ++axis) {
    addBoxFace(mesh, size, steps, axis, true);
    addBoxFace(mesh, size, steps, axis, false);
  }
  return mesh;
}

Primitive planeMesh(double halfSize, int segments) {
  Primitive mesh;
  const int steps = std::max(1, segments / 4);
  const auto along = [&](double i) { return halfSize * ((2.0 * i - steps) / steps); };
  const auto sample = [&](double column, int row) {
    return Sample{dvec3(along(column), 0.0, -along(row)), dvec3(0.0, 1.0, 0.0)};
  };
  const auto uvAt = [&](double u, double v) { return dvec2(halfSize * (2.0 * u - 1.0), halfSize * (2.0 * v - 1.0)); };
  addGrid(mesh, {.columns = steps, .rows = steps}, sample, uvAt);
  return mesh;
}

}  // namespace

Primitive tessellateShape(ShapeKind kind, const glm::vec4& params, int segments, double planeHalfSize) {
  CL_CHECK_LE(3, segments);
  switch (kind) {
    case ShapeKind::sphere:
      return sphereMesh(params.x, segments);
    case ShapeKind::plane:
      return planeMesh(planeHalfSize, segments);
    case ShapeKind::disk:
      return diskMesh(params.x, segments);
    case ShapeKind::box:
      return boxMesh(dvec3(params), segments);
    case ShapeKind::cylinder:
      return cylinderMesh(params.x, params.y, segments);
    case ShapeKind::cone:
      return coneMesh(params.x, params.y, segments);
    case ShapeKind::torus:
      return torusMesh(params.x, params.y, segments);
  }
  checkFailed("kind is a row of CL_SHAPE_KINDS", std::to_string(static_cast<std::uint32_t>(kind)), __FILE__, __LINE__);
}

std::optional<DBounds> shapeBounds(ShapeKind kind, const glm::vec4& params) {
  const double a = params.x, b = params.y;
  const auto symmetric = [](const dvec3& halfSize) { return DBounds{-halfSize, halfSize}; };
  switch (kind) {
    case ShapeKind::plane:
      return std::nullopt;
    case ShapeKind::sphere:
      return symmetric({a, a, a});
    case ShapeKind::disk:
      return symmetric({a, 0.0, a});
    case ShapeKind::box:
      return symmetric(0.5 * dvec3(params));
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      return symmetric({a, 0.5 * b, a});
    case ShapeKind::torus:
      return symmetric({a + b, b, a + b});
  }
  checkFailed("kind is a row of CL_SHAPE_KINDS", std::to_string(static_cast<std::uint32_t>(kind)), __FILE__, __LINE__);
}

#define CL_NAME_CASE(value, name, ...) \
  case Row::name:                      \
    return #name;
#define CL_NAME_OF(Enum, LIST)                                                                         \
  const char* nameOf(Enum row) {                                                                       \
    using Row = Enum;                                                                                  \
    switch (row) { LIST(CL_NAME_CASE) }                                                                \
    checkFailed("row of " #LIST, std::to_string(static_cast<std::uint32_t>(row)), __FILE__, __LINE__); \
  }
CL_NAME_OF(ShapeKind, CL_SHAPE_KINDS)
CL_NAME_OF(LightType, CL_LIGHT_TYPES)
CL_NAME_OF(IlluminationModel, CL_ILLUMINATION_MODELS)
CL_NAME_OF(ShadingMethod, CL_SHADING_METHODS)
#undef CL_NAME_OF
#undef CL_NAME_CASE

}  // namespace crosslight

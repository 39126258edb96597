// Unfolds the teapot's symmetries. A part is a grid of patches, columns around and rows along; the last column meets
// the first one again.
#include "scenegen/teapot.h"

#include "scenegen/teapot_data.h"

namespace crosslight::scenegen {
namespace {

using glm::dvec3;

struct Part {
  int columns, rows;                 // in patches
  std::vector<BezierPatch> patches;  // row by row
};

// Quarter turns are sign changes and swaps: exact. + 0.0 keeps negative zeros out.
dvec3 turned(const dvec3& p, int quarters) {
  const dvec3 images[4] = {p, {p.y, -p.x, p.z}, {-p.x, -p.y, p.z}, {-p.y, p.x, p.z}};
  return images[quarters] + 0.0;
}

Part turnedPart(const TurnedRow* profile, int rows) {
  Part part{4, rows, {}};
  for (int row = 0; row < rows; ++row) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      BezierPatch patch;
      for (std::size_t j = 0; j < 4; ++j) {
        const TurnedRow& p = profile[3 * static_cast<std::size_t>(row) + j];
        const dvec3 points[4] = {{p.r, 0.0, p.z}, {p.r, -p.q, p.z}, {p.q, -p.r, p.z}, {0.0, -p.r, p.z}};
        for (std::size_t i = 0; i < 4; ++i) patch.points[j][i] = turned(points[i], quarter);
      }
      part.patches.push_back(patch);
    }
  }
  return part;
}

Part mirroredPart(const dvec3 (*half)[4]) {
  Part part{2, 2, {}};
  for (std::size_t row = 0; row < 2; ++row) {
    BezierPatch near, far;
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 4; ++i) {
        const dvec3& p = half[3 * row + j][i];
        near.points[j][i] = p;
        far.points[j][3 - i] = dvec3(p.x, -p.y, p.z) + 0.0;
      }
    }
    part.patches.push_back(near);
    part.patches.push_back(far);
  }
  return part;
}

std::vector<Part> teapotParts() {
  return {turnedPart(kTeapotBody, 4), turnedPart(kTeapotLid, 2), mirroredPart(kTeapotHandle),
          mirroredPart(kTeapotSpout)};
}

bool collapsed(const BezierPatch& patch, std::size_t row) {
  const auto& p = patch.points[row];
  return p[0] == p[1] && p[1] == p[2] && p[2] == p[3];
}

// Vertex at (column, row) of a part cut into `steps` per patch; the column may be a half one at poles.
void addVertex(Primitive& mesh, const Part& part, int steps, double column, int row) {
  const int patchColumn = std::min(static_cast<int>(column) / steps, part.columns - 1);
  const int patchRow = std::min(row / steps, part.rows - 1);
  const BezierPatch& patch = part.patches[static_cast<std::size_t>(patchRow * part.columns + patchColumn)];
  const double u = (column - patchColumn * steps) / steps;
  const double v = static_cast<double>(row - patchRow * steps) / steps;
  const dvec3 p = pointAt(patch, u, v);
  const dvec3 n = normalAt(patch, u, v);
  mesh.positions.emplace_back(dvec3(p.x, p.z, -p.y) + 0.0);
  mesh.normals.emplace_back(dvec3(n.x, n.z, -n.y) + 0.0);
  mesh.uv0.emplace_back(column / (steps * part.columns), static_cast<double>(row) / (steps * part.rows));
}

void addPart(Primitive& mesh, const Part& part, int steps) {
  const int columns = part.columns * steps, rows = part.rows * steps;
  const bool poleFirst = collapsed(part.patches.front(), 0), poleLast = collapsed(part.patches.back(), 3);
  std::vector<std::uint32_t> rowStart;
  for (int row = 0; row <= rows; ++row) {
    const bool pole = (row == 0 && poleFirst) || (row == rows && poleLast);
    rowStart.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    for (int column = 0; column < columns + (pole ? 0 : 1); ++column) {
      addVertex(mesh, part, steps, column + (pole ? 0.5 : 0.0), row);
    }
  }
  for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
    for (std::uint32_t column = 0; column < static_cast<std::uint32_t>(columns); ++column) {
      const bool atFirst = row == 0 && poleFirst, atLast = row + 1 == static_cast<std::size_t>(rows) && poleLast;
      const std::uint32_t a = rowStart[row] + column, d = rowStart[row + 1] + column;
      if (!atFirst) mesh.indices.insert(mesh.indices.end(), {a, a + 1, atLast ? d : d + 1});
      if (!atLast) mesh.indices.insert(mesh.indices.end(), {a, d + 1, d});
    }
  }
}

}  // namespace

std::vector<BezierPatch> teapotPatches() {
  std::vector<BezierPatch> all;
  for (const Part& part : teapotParts()) all.insert(all.end(), part.patches.begin(), part.patches.end());
  return all;
}

Primitive tessellateTeapot(int steps) {
  Primitive mesh;
  for (const Part& part : teapotParts()) addPart(mesh, part, steps);
  return mesh;
}

}  // namespace crosslight::scenegen

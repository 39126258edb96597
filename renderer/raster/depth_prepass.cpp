#include "raster/depth_prepass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace crosslight {
namespace {

constexpr std::uint32_t kSampledTriangles = 1u << 14;  // a millisecond or two
constexpr std::uint32_t kCells = 64;                   // of the grid, along each side
// A cell with this much on it hides what is behind: triangles are spread over their boxes, which leaves it uneven.
constexpr double kCovered = 0.75;

// Nanoseconds of CPU on llvmpipe (Mesa 22.3.6, 2026-11-23; 512x512, PBR, eight layers of 2048 triangles). Only their
// ratios count. A prepass that gains little is left out: what is estimated is rough.
constexpr double kFragmentNs = 33, kLightNs = 27;     // of a lit fragment, and more for each light
constexpr double kShadowRayNs = 200;                  // of each light's ray, where raster casts shadows by rays
constexpr double kTriangleNs = 150, kRejectedNs = 5;  // of a triangle that is drawn, and of a fragment behind another
constexpr double kLeastGain = 1.5;

struct Corner {
  glm::vec2 cell;  // position on the grid
  float depth;     // reversed: nearer is greater
};

// Nothing at or behind the eye: such triangles are left out of the sample.
std::optional<Corner> project(const glm::mat4& clipFromRender, const glm::vec3& p) {
  const glm::vec4 clip = clipFromRender * glm::vec4(p, 1.0f);
  if (!(clip.w > 0)) return std::nullopt;
  const glm::vec2 ndc(clip.x / clip.w, clip.y / clip.w);
  return Corner{(ndc * 0.5f + 0.5f) * static_cast<float>(kCells), clip.z / clip.w};
}

// A picture of the sample: what was lit so far, and the nearest depth, per cell.
class Grid {
 public:
  // `weight`: triangles that this one stands for; `culls`: its back is not drawn, which is clockwise for `mirrored`
  // ones.
  void draw(const std::array<Corner, 3>& t, double weight, bool culls, bool mirrored) {
    const glm::vec2 a = t[1].cell - t[0].cell, b = t[2].cell - t[0].cell;
    const double twice = static_cast<double>(a.x) * b.y - static_cast<double>(a.y) * b.x;
    // y goes down on the grid as in clip space: counter-clockwise seen from the front is negative.
    if (culls && (twice > 0) != mirrored) return;
    const auto bound = [](float x) { return static_cast<int>(std::clamp(x, 0.0f, static_cast<float>(kCells - 1))); };
    const auto [left, right] = std::minmax({t[0].cell.x, t[1].cell.x, t[2].cell.x});
    const auto [top, bottom] = std::minmax({t[0].cell.y, t[1].cell.y, t[2].cell.y});
    const auto size = static_cast<float>(kCells);
    if (!(right >= 0 && left < size && bottom >= 0 && top < size)) return;
    const double boxArea = std::max(1e-9, static_cast<double>(right - left) * (bottom - top));
    const double share = std::abs(twice) / 2 * weight / boxArea;  // of its box that it covers
    const float depth = (t[0].depth + t[1].depth + t[2].depth) / 3.0f;
    for (int y = bound(top); y <= bound(bottom); ++y) {
      for (int x = bound(left); x <= bound(right); ++x) {
        const auto overlap = [](float low, float high, int cell) {
          return std::min(high, static_cast<float>(cell + 1)) - std::max(low, static_cast<float>(cell));
        };
        add(cells_[static_cast<std::size_t>(y) * kCells + static_cast<std::size_t>(x)],
            share * overlap(left, right, x) * overlap(top, bottom, y), depth);
      }
    }
  }

  // In parts of a cell, over all cells: drawn, lit in this order, and seen at last.
  double drawn() const { return drawn_; }
  double lit() const { return lit_; }
  double visible() const {
    double sum = 0;
    for (const Cell& cell : cells_) sum += std::min(1.0, cell.covered);
    return sum;
  }

 private:
  struct Cell {
    double covered = 0;  // by what was lit
    float nearest = 0;
  };
  void add(Cell& cell, double area, float depth) {
    drawn_ += area;
    if (depth <= cell.nearest && cell.covered >= kCovered) return;
    lit_ += area;
    cell.covered += area;
    cell.nearest = std::max(cell.nearest, depth);
  }

  std::vector<Cell> cells_ = std::vector<Cell>(std::size_t{kCells} * kCells);
  double drawn_ = 0, lit_ = 0;
};

}  // namespace

PrepassVerdict planPrepass(const FlatScene& flat, const DrawLists& lists, const shared::FrameRecord& frame,
                           const RenderSettings& settings, std::uint32_t lightCount) {
  if (settings.method != Method::phong || settings.depthPrepass == DepthPrepass::off) return {};
  std::uint64_t triangles = 0;
  for (const DrawCall& call : lists.opaque) triangles += call.triangleCount;
  const std::uint64_t stride = std::max<std::uint64_t>(1, triangles / kSampledTriangles);
  Grid grid;
  std::uint64_t next = stride / 2, before = 0;
  for (const DrawCall& call : lists.opaque) {
    for (; next < before + call.triangleCount; next += stride) {
      const std::uint64_t triangle = call.firstTriangle + (next - before);
      std::array<Corner, 3> corners{};
      bool inFront = true;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const auto corner = project(frame.clipFromRender, flat.positions[flat.indices[3 * triangle + k]]);
        inFront = inFront && corner.has_value();
        if (corner) corners[k] = *corner;
      }
      const bool mirrored = (call.flags & shared::kDrawFlipsWinding) != 0;
      if (inFront) grid.draw(corners, static_cast<double>(stride), call.cullsBackFaces, mirrored);
    }
    before += call.triangleCount;
  }
  const double perCell = static_cast<double>(settings.width) * settings.height / (double{kCells} * kCells);
  PrepassVerdict verdict{settings.depthPrepass == DepthPrepass::on, grid.lit() * perCell, grid.visible() * perCell};
  const double lightNs = kLightNs + (settings.rasterShadows == RasterShadows::rays ? kShadowRayNs : 0);
  const double saved = (verdict.lit - verdict.visible) * (kFragmentNs + lightNs * lightCount);
  const double cost = static_cast<double>(triangles) * kTriangleNs + grid.drawn() * perCell * kRejectedNs;
  verdict.pays = verdict.pays || saved > kLeastGain * cost;
  return verdict;
}

}  // namespace crosslight

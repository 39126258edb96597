#include "scene/displacement_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>

namespace crosslight {
namespace {

glm::vec3 unitOrFirst(const glm::vec3& sum, const glm::vec3& first) {
  const double length = glm::length(glm::dvec3(sum));
  return length > 0.0 ? glm::vec3(glm::dvec3(sum) / length) : first;
}

template <class T>
void addMean(std::vector<T>& values, std::uint32_t a, std::uint32_t b) {
  if (!values.empty()) values.push_back((values[a] + values[b]) * 0.5f);
}

class EdgeSplitter {
 public:
  EdgeSplitter(Primitive& primitive, const EdgeTest& splits) : p_(primitive), splits_(splits) {}

  bool run() {
    const std::vector<std::uint32_t> old = std::move(p_.indices);
    p_.indices.clear();
    for (std::size_t i = 0; i + 2 < old.size(); i += 3) triangle({old[i], old[i + 1], old[i + 2]});
    return !middles_.empty();
  }

 private:
  // Index of the middle, or of nothing.
  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    if (!splits_(p_.positions[a], p_.positions[b])) return kNone;
    const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
    const auto [found, isNew] = middles_.try_emplace(key, static_cast<std::uint32_t>(p_.positions.size()));
    if (isNew) addVertex(std::min(a, b), std::max(a, b));
    return found->second;
  }

  void addVertex(std::uint32_t a, std::uint32_t b) {
    // Sums of two are the same in either order: both sides of a seam get the same bits.
    if (!p_.normals.empty()) p_.normals.push_back(unitOrFirst(p_.normals[a] + p_.normals[b], p_.normals[a]));
    if (!p_.tangents.empty()) {
      const glm::vec3 t = glm::vec3(p_.tangents[a]) + glm::vec3(p_.tangents[b]);
      p_.tangents.emplace_back(unitOrFirst(t, glm::vec3(p_.tangents[a])), p_.tangents[a].w);
    }
    p_.positions.push_back((p_.positions[a] + p_.positions[b]) * 0.5f);
    addMean(p_.uv0, a, b);
    addMean(p_.uv1, a, b);
    addMean(p_.colors, a, b);
  }

  void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c) { p_.indices.insert(p_.indices.end(), {a, b, c}); }

  // Turned so that the first edge is the split one of one, or the last the unsplit one of two.
  void triangle(std::array<std::uint32_t, 3> v) {
    std::array<std::uint32_t, 3> m = {middle(v[0], v[1]), middle(v[1], v[2]), middle(v[2], v[0])};
    const auto count = 3 - std::count(m.begin(), m.end(), kNone);
    const auto turn = [&] {
      std::rotate(v.begin(), v.begin() + 1, v.end());
      std::rotate(m.begin(), m.begin() + 1, m.end());
    };
    if (count == 0) return emit(v[0], v[1], v[2]);
    while ((count == 1 && m[0] == kNone) || (count == 2 && m[2] != kNone)) turn();
    if (count == 1) {
      emit(v[0], m[0], v[2]);
      emit(m[0], v[1], v[2]);
    } else if (count == 2) {
      emit(m[0], v[1], m[1]);
      emit(v[0], m[0], m[1]);
      emit(v[0], m[1], v[2]);
    } else {
      emit(v[0], m[0], m[2]);
      emit(m[0], v[1], m[1]);
      emit(m[2], m[1], v[2]);
      emit(m[0], m[1], m[2]);
    }
  }

  static constexpr std::uint32_t kNone = 0xffffffffu;
  Primitive& p_;
  const EdgeTest& splits_;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;
};

std::size_t wrapped(double i, std::uint32_t size, Wrap mode) {
  const double n = size;
  double at = i;
  if (mode == Wrap::repeat) at = i - n * std::floor(i / n);
  if (mode == Wrap::mirroredRepeat) {
    const double period = i - 2 * n * std::floor(i / (2 * n));
    at = period < n ? period : 2 * n - 1 - period;
  }
  return static_cast<std::size_t>(std::clamp(at, 0.0, n - 1));
}

}  // namespace

bool splitEdges(Primitive& primitive, const EdgeTest& splits) { return EdgeSplitter(primitive, splits).run(); }

double sampleRed(const TextureImage& image, const TextureUse& use, const glm::dvec2& uv) {
  const double c = std::cos(static_cast<double>(use.rotation)), s = std::sin(static_cast<double>(use.rotation));
  const glm::dvec2 scale(use.scale);
  const glm::dvec2 moved =
      glm::dvec2(c * scale.x * uv.x + s * scale.y * uv.y, -s * scale.x * uv.x + c * scale.y * uv.y) +
      glm::dvec2(use.offset);
  const bool nearest = use.filter == Filter::nearest;
  const double x = moved.x * image.width - (nearest ? 0.0 : 0.5), y = moved.y * image.height - (nearest ? 0.0 : 0.5);
  const double fx = nearest ? 0.0 : x - std::floor(x), fy = nearest ? 0.0 : y - std::floor(y);
  const auto red = [&](double dx, double dy) {
    const std::size_t row = wrapped(std::floor(y) + dy, image.height, use.wrapV);
    const std::size_t column = wrapped(std::floor(x) + dx, image.width, use.wrapU);
    return static_cast<double>(image.rgba[4 * (row * image.width + column)]);
  };
  const double top = red(0, 0) * (1 - fx) + red(1, 0) * fx;
  const double bottom = red(0, 1) * (1 - fx) + red(1, 1) * fx;
  return top * (1 - fy) + bottom * fy;
}

}  // namespace crosslight

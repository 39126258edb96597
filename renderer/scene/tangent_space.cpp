// Tangents by the rules of MikkTSpace (Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited", and the convention
// that glTF 2.0 section 3.7.2.1 prescribes), so that normal maps baked elsewhere are seen as they were baked: corners
// equal in position, normal and texture coordinates are one vertex; the triangles around it that are joined by edges
// and of one orientation in texture space form a group; a group's tangent is the mean of its triangles' directions of
// increasing u, each laid into the vertex's plane and made unit, by the angle of the corner in that plane.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <span>
#include <unordered_map>

#include "base/hash.h"
#include "scene/mesh_repair.h"

namespace crosslight {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

glm::dvec3 unitOrZero(const glm::dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest > 0.0 && std::isfinite(largest) ? glm::normalize(v / largest) : glm::dvec3(0.0);
}

glm::dvec3 inPlane(const glm::dvec3& v, const glm::dvec3& n) { return unitOrZero(v - n * glm::dot(n, v)); }

struct Triangle {
  std::array<std::uint32_t, 3> vertices{};                      // welded
  std::array<std::uint32_t, 3> neighbors{kNone, kNone, kNone};  // across edge i to i + 1
  std::array<std::uint32_t, 3> groups{kNone, kNone, kNone};     // of the corners
  glm::dvec3 along{0.0};  // unit, increasing u; zero where texture coordinates have no area: joins any group
  bool mirrored = false;
  bool broken = false;  // two corners are one: belongs to no group
};

struct Group {
  bool oriented = false, mirrored = false;
  glm::dvec3 sum{0.0};
};

using Key = std::array<std::uint32_t, 8>;
struct KeyHash {
  std::size_t operator()(const Key& key) const {
    return static_cast<std::size_t>(hashBytes(std::as_bytes(std::span(key))));
  }
};

class TangentSpace {
 public:
  TangentSpace(const Primitive& primitive, const std::vector<glm::vec2>& uv) : p_(primitive), uv_(uv) {
    weld();
    join();
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for (std::uint32_t corner = 0; corner < 3; ++corner) startGroup(t, corner);
    }
    for (const Triangle& t : triangles_) addDirections(t);
  }

  std::uint32_t groupOf(std::size_t triangle, std::size_t corner) const { return triangles_[triangle].groups[corner]; }
  const Group& group(std::uint32_t index) const { return groups_[index]; }

 private:
  Key keyOf(std::uint32_t vertex) const {
    const glm::vec3 &p = p_.positions[vertex], &n = p_.normals[vertex];
    const float values[8] = {p.x, p.y, p.z, n.x, n.y, n.z, uv_[vertex].x, uv_[vertex].y};
    Key key;
    for (std::size_t i = 0; i < 8; ++i) key[i] = std::bit_cast<std::uint32_t>(values[i] + 0.0f);  // -0 is 0
    return key;
  }

  void weld() {
    std::unordered_map<Key, std::uint32_t, KeyHash> first;
    std::vector<std::uint32_t> welded(p_.positions.size());
    for (std::uint32_t i = 0; i < welded.size(); ++i) welded[i] = first.try_emplace(keyOf(i), i).first->second;
    triangles_.resize(p_.indices.size() / 3);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      Triangle& triangle = triangles_[t];
      for (std::size_t c = 0; c < 3; ++c) triangle.vertices[c] = welded[p_.indices[t * 3 + c]];
      const auto& [a, b, c] = triangle.vertices;
      triangle.broken = a == b || b == c || c == a;
      if (!triangle.broken) setDirection(triangle);
    }
  }

  void setDirection(Triangle& t) const {
    const auto position = [&](std::size_t c) { return glm::dvec3(p_.positions[t.vertices[c]]); };
    const auto place = [&](std::size_t c) { return glm::dvec2(uv_[t.vertices[c]]); };
    const glm::dvec3 e1 = position(1) - position(0), e2 = position(2) - position(0);
    const glm::dvec2 d1 = place(1) - place(0), d2 = place(2) - place(0);
    const double area = d1.x * d2.y - d1.y * d2.x;
    if (area == 0.0) return;
    t.along = unitOrZero((e1 * d2.y - e2 * d1.y) * (area < 0.0 ? -1.0 : 1.0));
    // A picture that reads right has v downwards (glTF 2.0, 3.6.2.2), so its area is negative; the normal map's green
    // points up, and the bitangent cross(n, t) * w with w = +1 is up as well.
    t.mirrored = area > 0.0;
  }

  // Neighbors share an edge and run along it in opposite directions; of several the first two that fit.
  void join() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::pair<std::uint32_t, std::uint32_t>>> open;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (triangles_[t].broken) continue;
      for (std::uint32_t e = 0; e < 3; ++e) {
        const std::uint32_t a = triangles_[t].vertices[e], b = triangles_[t].vertices[(e + 1) % 3];
        const auto waiting = open.find({b, a});
        if (waiting == open.end() || waiting->second.empty()) {
          open[{a, b}].emplace_back(t, e);
          continue;
        }
        const auto [other, edge] = waiting->second.front();
        waiting->second.erase(waiting->second.begin());
        triangles_[t].neighbors[e] = other;
        triangles_[other].neighbors[edge] = t;
      }
    }
  }

  void startGroup(std::uint32_t t, std::uint32_t corner) {
    // Triangles without a direction wait to be joined; what is left over of them has no group.
    if (triangles_[t].broken || triangles_[t].groups[corner] != kNone || triangles_[t].along == glm::dvec3(0.0)) return;
    const auto index = static_cast<std::uint32_t>(groups_.size());
    groups_.push_back({true, triangles_[t].mirrored});
    const std::uint32_t vertex = triangles_[t].vertices[corner];
    std::vector<std::uint32_t> open{t};
    while (!open.empty()) {
      Triangle& next = triangles_[open.back()];
      open.pop_back();
      const auto at = static_cast<std::size_t>(std::find(next.vertices.begin(), next.vertices.end(), vertex) -
                                               next.vertices.begin());
      const bool fits = next.along == glm::dvec3(0.0) || next.mirrored == groups_[index].mirrored;
      if (next.groups[at] != kNone || !fits) continue;
      next.groups[at] = index;
      for (const std::uint32_t neighbor : {next.neighbors[at], next.neighbors[(at + 2) % 3]}) {
        if (neighbor != kNone) open.push_back(neighbor);
      }
    }
  }

  void addDirections(const Triangle& t) {
    if (t.broken || t.along == glm::dvec3(0.0)) return;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const glm::dvec3 n(p_.normals[t.vertices[corner]]);
      const auto to = [&](std::size_t other) {
        return inPlane(glm::dvec3(p_.positions[t.vertices[other]]) - glm::dvec3(p_.positions[t.vertices[corner]]), n);
      };
      const glm::dvec3 a = to((corner + 1) % 3), b = to((corner + 2) % 3);
      const double angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));  // acos, but well-conditioned
      groups_[t.groups[corner]].sum += inPlane(t.along, n) * angle;
    }
  }

  const Primitive& p_;
  const std::vector<glm::vec2>& uv_;
  std::vector<Triangle> triangles_;
  std::vector<Group> groups_;
};

}  // namespace

void makeTangents(Primitive& primitive, const std::vector<glm::vec2>& uv) {
  const TangentSpace space(primitive, uv);
  primitive.tangents.clear();
  // The first group at a vertex keeps it, each further one has a copy.
  std::vector<std::uint32_t> groupAt(primitive.positions.size(), kNone);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> copies;
  for (std::size_t i = 0; i < primitive.indices.size(); ++i) {
    const std::uint32_t vertex = primitive.indices[i], group = space.groupOf(i / 3, i % 3);
    if (group == kNone || groupAt[vertex] == group) continue;
    if (groupAt[vertex] == kNone) {
      groupAt[vertex] = group;
      continue;
    }
    const auto [found, isNew] =
        copies.try_emplace({vertex, group}, static_cast<std::uint32_t>(primitive.positions.size()));
    if (isNew) {
      duplicateVertex(primitive, vertex);
      groupAt.push_back(group);
    }
    primitive.indices[i] = found->second;
  }
  primitive.tangents.resize(primitive.positions.size());
  for (std::size_t i = 0; i < primitive.tangents.size(); ++i) {
    const std::uint32_t group = groupAt[i];
    const glm::dvec3 n(primitive.normals[i]);
    const glm::dvec3 unit = group == kNone ? glm::dvec3(0.0) : unitOrZero(space.group(group).sum);
    primitive.tangents[i] = glm::vec4(glm::vec3(unit == glm::dvec3(0.0) ? anyAcross(n) : unit),
                                      group != kNone && space.group(group).mirrored ? -1.0f : 1.0f);
  }
}

}  // namespace crosslight

// What the mesh tests ask of triangles, by position: vertices that differ in normal or texture coordinate only are one.
#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <vector>

#include "scene/scene.h"

namespace crosslight::scenegen {

using Point = std::array<float, 3>;

inline Point keyOf(const glm::vec3& p) { return {p.x, p.y, p.z}; }

// Directed edges that no other triangle runs against.
inline std::multiset<std::pair<Point, Point>> boundaryOf(const Primitive& mesh) {
  std::multiset<std::pair<Point, Point>> open;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Point a = keyOf(mesh.positions[mesh.indices[i + k]]);
      const Point b = keyOf(mesh.positions[mesh.indices[i + (k + 1) % 3]]);
      const auto reverse = open.find({b, a});
      if (reverse == open.end()) {
        open.insert({a, b});
      } else {
        open.erase(reverse);
      }
    }
  }
  return open;
}

// The boundary as closed walks; empty if some vertex has not exactly one edge out and one in.
inline std::vector<std::vector<Point>> boundaryLoops(const Primitive& mesh) {
  std::map<Point, Point> next;
  for (const auto& [a, b] : boundaryOf(mesh)) {
    if (!next.emplace(a, b).second) return {};
  }
  std::vector<std::vector<Point>> loops;
  while (!next.empty()) {
    std::vector<Point> loop;
    Point at = next.begin()->first;
    for (auto edge = next.find(at); edge != next.end(); edge = next.find(at)) {
      loop.push_back(at);
      at = edge->second;
      next.erase(edge);
    }
    if (at != loop.front()) return {};
    loops.push_back(loop);
  }
  return loops;
}

struct Triangle {
  glm::dvec3 p[3], n[3];
  glm::dvec3 areaNormal() const { return glm::cross(p[1] - p[0], p[2] - p[0]); }
};

inline std::vector<Triangle> trianglesOf(const Primitive& mesh) {
  std::vector<Triangle> all;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    Triangle t{};
    for (std::size_t k = 0; k < 3; ++k) {
      t.p[k] = mesh.positions[mesh.indices[i + k]];
      if (!mesh.normals.empty()) t.n[k] = mesh.normals[mesh.indices[i + k]];
    }
    all.push_back(t);
  }
  return all;
}

inline double sixfoldVolume(const Primitive& mesh) {
  double sum = 0.0;
  for (const Triangle& t : trianglesOf(mesh)) sum += glm::dot(t.p[0], glm::cross(t.p[1], t.p[2]));
  return sum;
}

}  // namespace crosslight::scenegen

#include "effects/media.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "effects/material_traits.h"

namespace crosslight {
namespace {

struct Body {
  int material;
  double extent;  // largest edge of its bounds in the world
};

// Of the triangle as seen from the origin, positive where its front looks away from it: Van Oosterom, Strackee 1983,
// "The Solid Angle of a Plane Triangle", Eq. 8.
double solidAngle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double above = glm::dot(a, glm::cross(b, c));
  const double below = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return 2.0 * std::atan2(above, below);
}

DBounds boundsOf(const Primitive& p) {
  DBounds bounds;
  for (const glm::vec3& position : p.positions) bounds.add(glm::dvec3(position));
  return bounds;
}

bool contains(const DBounds& b, const glm::dvec3& p) {
  return glm::all(glm::greaterThanEqual(p, b.lower)) && glm::all(glm::lessThanEqual(p, b.upper));
}

double extentOf(const DBounds& bounds, const glm::dmat4& worldFromObject) {
  const glm::dvec3 size = bounds.upper - bounds.lower;
  double extent = 0.0;
  for (int i = 0; i < 3; ++i) extent = std::max(extent, glm::length(glm::dvec3(worldFromObject[i])) * size[i]);
  return extent;
}

// A point in a closed mesh sees its inside all around: 4 pi. In the object's own space mirrored nodes need no care.
void addMeshBodies(const Scene& scene, const MeshInstance& instance, const glm::dvec3& worldPoint,
                   std::vector<Body>& bodies) {
  const glm::dvec3 point(glm::inverse(instance.worldFromObject) * glm::dvec4(worldPoint, 1.0));
  std::vector<std::pair<Body, double>> around;
  for (const Primitive& p : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
    if (!isBody(scene.materials[static_cast<std::size_t>(p.material)])) continue;
    const DBounds bounds = boundsOf(p);
    if (bounds.empty() || !contains(bounds, point)) continue;
    double angle = 0.0;
    for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
      const auto corner = [&](std::size_t k) { return glm::dvec3(p.positions[p.indices[i + k]]) - point; };
      angle += solidAngle(corner(0), corner(1), corner(2));
    }
    const auto same = [&](const auto& other) { return other.first.material == p.material; };
    const auto found = std::find_if(around.begin(), around.end(), same);
    if (found == around.end()) {
      around.push_back({{p.material, extentOf(bounds, instance.worldFromObject)}, angle});
    } else {
      found->second += angle;
    }
  }
  constexpr double kHalf = 2.0 * 3.14159265358979323846;
  for (const auto& [body, angle] : around) {
    if (angle > kHalf) bodies.push_back(body);
  }
}

bool isInShape(const ShapeInstance& s, const glm::dvec3& p) {
  const glm::dvec4 q(s.params);
  switch (s.kind) {
    case ShapeKind::sphere:
      return glm::length(p) < q.x;
    case ShapeKind::plane:
      return p.y < 0.0;
    case ShapeKind::disk:
      return false;
    case ShapeKind::box:
      return 2.0 * std::abs(p.x) < q.x && 2.0 * std::abs(p.y) < q.y && 2.0 * std::abs(p.z) < q.z;
    case ShapeKind::cylinder:
      return 2.0 * std::abs(p.y) < q.y && std::hypot(p.x, p.z) < q.x;
    case ShapeKind::cone:
      return 2.0 * std::abs(p.y) < q.y && std::hypot(p.x, p.z) < q.x * (0.5 - p.y / q.y);
    case ShapeKind::torus:
      return std::hypot(std::hypot(p.x, p.z) - q.x, p.y) < q.y;
  }
  return false;
}

double extentOf(const ShapeInstance& s) {
  if (s.kind == ShapeKind::plane) return std::numeric_limits<double>::infinity();
  const bool torus = s.kind == ShapeKind::torus;
  const double size = std::max({s.params.x + (torus ? s.params.y : 0.0f), s.params.y, s.params.z});
  return size * glm::length(glm::dvec3(s.worldFromObject[0]));
}

}  // namespace

bool isBody(const Material& m) { return refracts(m) && (isClassic(m) || m.hasVolume); }

std::vector<int> bodiesAt(const Scene& scene, const glm::dvec3& worldPoint) {
  std::vector<Body> bodies;
  for (const MeshInstance& instance : scene.instances) {
    if (!instance.replacedByShape) addMeshBodies(scene, instance, worldPoint, bodies);
  }
  for (const ShapeInstance& shape : scene.shapes) {
    if (!isBody(scene.materials[static_cast<std::size_t>(shape.material)])) continue;
    const glm::dvec3 point(glm::inverse(shape.worldFromObject) * glm::dvec4(worldPoint, 1.0));
    if (isInShape(shape, point)) bodies.push_back({shape.material, extentOf(shape)});
  }
  std::stable_sort(bodies.begin(), bodies.end(), [](const Body& a, const Body& b) { return a.extent > b.extent; });
  std::vector<int> materials;
  for (const Body& body : bodies) materials.push_back(body.material);
  return materials;
}

std::vector<int> cameraMedia(const Scene& scene, const RenderSettings& settings) {
  if (settings.method != Method::whitted || !settings.refraction || settings.maxDepth == 0) return {};
  if (std::none_of(scene.materials.begin(), scene.materials.end(), isBody)) return {};
  const Camera& camera = scene.cameras[static_cast<std::size_t>(settings.camera)];
  return bodiesAt(scene, glm::dvec3(camera.worldFromCamera[3]));
}

std::string reasonForNestedMedia(const Scene& scene, const RenderSettings& settings) {
  if (settings.method != Method::whitted || !settings.refraction || settings.maxDepth == 0) return {};
  for (const Material& m : scene.materials) {
    if (isBody(m) && m.priority) return fmt::format("material '{}' has priority {}", m.name, *m.priority);
  }
  const std::vector<int> media = cameraMedia(scene, settings);
  if (media.empty()) return {};
  const std::string& name = scene.materials[static_cast<std::size_t>(media.back())].name;
  return fmt::format("the camera is inside of a body of material '{}'", name);
}

}  // namespace crosslight

#include "scene/emissive_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <set>

#include "base/log.h"

namespace crosslight {
namespace {

struct Candidate {
  Light light;
  double power = 0;  // lumen, of the mean channel
};

glm::vec3 emissionOf(const Material& m) {
  const bool glows = m.model != IlluminationModel::unlit;
  return glows ? m.emissiveFactor * m.emissiveStrength : glm::vec3(0.0f);
}

class Collector {
 public:
  explicit Collector(const Scene& scene) : scene_(scene) {}

  std::vector<Candidate> run() {
    for (const MeshInstance& instance : scene_.instances) {
      for (const Primitive& p : scene_.meshes[static_cast<std::size_t>(instance.mesh)].primitives) add(instance, p);
    }
    for (const std::string& name : textured_) {
      logWarning("material '" + name + "' glows by a texture: its triangles are seen to glow but light nothing");
    }
    return std::move(found_);
  }

 private:
  void add(const MeshInstance& instance, const Primitive& p) {
    const Material& m = scene_.materials[static_cast<std::size_t>(p.material)];
    const glm::vec3 emission = emissionOf(m);
    if (!(emission.x + emission.y + emission.z > 0.0f)) return;
    if (m.emissiveTexture.present()) {
      textured_.insert(m.name);
      return;
    }
    const bool mirrors = glm::determinant(glm::dmat3(instance.worldFromObject)) < 0.0;
    for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
      const auto corner = [&](std::size_t k) {
        return glm::dvec3(instance.worldFromObject * glm::dvec4(glm::dvec3(p.positions[p.indices[i + k]]), 1.0));
      };
      addTriangle(m, emission, corner(0), corner(mirrors ? 2 : 1), corner(mirrors ? 1 : 2));
    }
  }

  // Corners counter-clockwise as seen from the front.
  void addTriangle(const Material& m, const glm::vec3& emission, const glm::dvec3& a, const glm::dvec3& b,
                   const glm::dvec3& c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double area = 0.5 * glm::length(normal);
    if (!(area > 0.0)) return;
    Candidate candidate;
    Light& light = candidate.light;
    light.name = m.name;
    light.type = LightType::areaTriangle;
    light.color = emission;
    light.worldPosition = a;
    light.worldDirection = normal / (2.0 * area);
    light.worldU = c - a;
    light.worldV = b - a;
    light.twoSided = m.doubleSided;
    const double mean = (double{emission.x} + double{emission.y} + double{emission.z}) / 3.0;
    candidate.power = std::numbers::pi * area * mean * (m.doubleSided ? 2.0 : 1.0);
    found_.push_back(std::move(candidate));
  }

  const Scene& scene_;
  std::vector<Candidate> found_;
  std::set<std::string> textured_;
};

double powerOf(const std::vector<Candidate>& candidates) {
  double sum = 0;
  for (const Candidate& c : candidates) sum += c.power;
  return sum;
}

}  // namespace

std::size_t addEmissiveLights(Scene& scene, std::size_t most) {
  std::vector<Candidate> candidates = Collector(scene).run();
  if (candidates.size() > most) {
    const std::size_t all = candidates.size();
    const double power = powerOf(candidates);
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.power > b.power; });
    candidates.resize(most);
    logWarning(
        fmt::format("{} of {} glowing triangles light others, those of the largest power, together {:.1f} % of it",
                    most, all, 100.0 * powerOf(candidates) / power));
  }
  for (Candidate& c : candidates) scene.lights.push_back(std::move(c.light));
  return candidates.size();
}

}  // namespace crosslight

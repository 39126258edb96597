// Vertices in a pose: morph targets, then skin. Everything in double until the vertex is stored.
#include <tiny_gltf.h>

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "scene/gltf_build.h"

namespace crosslight::gltf {
namespace {

template <class Vector>
void addScaled(std::vector<Vector>& values, const std::vector<float>& deltas, std::size_t components, double weight) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t c = 0; c < components; ++c) {
      float& value = values[i][static_cast<int>(c)];
      value = static_cast<float>(double{value} + weight * double{deltas[i * components + c]});
    }
  }
}

struct Influences {
  std::vector<std::uint32_t> joints;
  std::vector<float> weights;
};

std::vector<Influences> readInfluences(const Source& source, const tinygltf::Primitive& primitive) {
  std::vector<Influences> all;
  for (int set = 0;; ++set) {
    const auto joints = primitive.attributes.find("JOINTS_" + std::to_string(set));
    const auto weights = primitive.attributes.find("WEIGHTS_" + std::to_string(set));
    if (joints == primitive.attributes.end() || weights == primitive.attributes.end()) return all;
    all.push_back({readIntegers(source, static_cast<std::size_t>(joints->second)),
                   readFinite(source, static_cast<std::size_t>(weights->second), 4)});
  }
}

// Weighted sum of the joints' matrices; weights are scaled to a sum of one (glTF allows them a rounding error).
// Vertices without any weight follow joint 0.
glm::dmat4 blended(const std::vector<Influences>& sets, std::size_t vertex, const Posing& posing, const JsonAt& at) {
  glm::dmat4 sum(0.0);
  double total = 0.0;
  for (const Influences& set : sets) {
    for (std::size_t i = vertex * 4; i < vertex * 4 + 4; ++i) {
      const double weight = set.weights[i];
      if (weight == 0.0) continue;
      if (weight < 0.0) at.fail(fmt::format("vertex {} has a negative joint weight", vertex));
      if (set.joints[i] >= posing.worldFromBind.size()) {
        at.fail(fmt::format("vertex {} follows joint {}, the skin has {}", vertex, set.joints[i],
                            posing.worldFromBind.size()));
      }
      sum += posing.worldFromBind[set.joints[i]] * weight;
      total += weight;
    }
  }
  return total > 0.0 ? sum / total : posing.worldFromBind[0];
}

glm::dvec3 unitOrZero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0.0 && std::isfinite(length) ? v / length : glm::dvec3(0.0);
}

// The inverse transpose up to a positive factor: exact for singular matrices too, as far as a direction is left.
glm::dmat3 normalMatrix(const glm::dmat3& m, double determinant) {
  const double sign = determinant < 0.0 ? -1.0 : 1.0;
  return glm::dmat3(glm::cross(m[1], m[2]) * sign, glm::cross(m[2], m[0]) * sign, glm::cross(m[0], m[1]) * sign);
}

}  // namespace

void applyMorphTargets(const Source& source, const tinygltf::Primitive& primitive, const std::vector<double>& weights,
                       Primitive& target) {
  for (std::size_t t = 0; t < primitive.targets.size() && t < weights.size(); ++t) {
    if (weights[t] == 0.0) continue;
    for (const auto& [name, accessor] : primitive.targets[t]) {
      const auto move = [&](auto& values, std::size_t components) {
        if (values.empty()) return;
        addScaled(values, readFinite(source, static_cast<std::size_t>(accessor), components), components, weights[t]);
      };
      if (name == "POSITION") move(target.positions, 3);
      if (name == "NORMAL") move(target.normals, 3);
      if (name == "TANGENT") move(target.tangents, 3);  // the handedness stays
      if (name == "TEXCOORD_0") move(target.uv0, 2);
      if (name == "TEXCOORD_1") move(target.uv1, 2);
      if (name == "COLOR_0") move(target.colors, 4);
    }
  }
  // glTF 2.0, 3.7.2.2: colors are clamped after morphing.
  for (glm::vec4& color : target.colors) color = glm::clamp(color, 0.0f, 1.0f);
}

std::vector<glm::dvec3> applySkin(const Source& source, const tinygltf::Primitive& primitive, const JsonAt& at,
                                  const Posing& posing, Primitive& target, std::vector<bool>& mirrored) {
  const std::vector<Influences> sets = readInfluences(source, primitive);
  std::vector<glm::dvec3> world(target.positions.size());
  mirrored.assign(world.size(), false);
  for (std::size_t i = 0; i < world.size(); ++i) {
    const glm::dmat4 matrix = blended(sets, i, posing, at);
    const glm::dmat3 linear(matrix);
    const double determinant = glm::determinant(linear);
    mirrored[i] = determinant < 0.0;
    world[i] = glm::dvec3(matrix * glm::dvec4(glm::dvec3(target.positions[i]), 1.0));
    if (!target.normals.empty()) {
      const glm::dmat3 normals = normalMatrix(linear, determinant);
      target.normals[i] = glm::vec3(unitOrZero(normals * glm::dvec3(target.normals[i])));
    }
    if (!target.tangents.empty()) {
      const glm::vec4 tangent = target.tangents[i];
      target.tangents[i] = glm::vec4(glm::vec3(unitOrZero(linear * glm::dvec3(tangent))), tangent.w);
    }
  }
  return world;
}

}  // namespace crosslight::gltf

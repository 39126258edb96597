// The parsed model as the builders of the scene see it: tinygltf's for the core, the validated JSON beside it for
// extensions (tinygltf's own values narrow integers and drop nulls). Internal to the scene room.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>

#include "scene/gltf_document.h"

namespace tinygltf {
class Model;
struct Primitive;
struct Mesh;
class Node;
}  // namespace tinygltf

namespace crosslight::gltf {

struct ModelDeleter {
  void operator()(tinygltf::Model* model) const;
};
using ModelPointer = std::unique_ptr<tinygltf::Model, ModelDeleter>;

// Moves the document's buffers into the model.
ModelPointer parseModel(Document& document);

// What every builder needs. Only the budget of the document changes.
struct Source {
  Document& document;
  const tinygltf::Model& model;
};

// gltf_accessor.cpp. Sparse values, strides, normalized integers and missing views are dealt with.
// `components` values per element; an accessor with fewer (COLOR_0 as VEC3) is filled up with `fill`.
std::vector<float> readFloats(const Source& source, std::size_t accessor, std::size_t components, float fill = 0.0f);
std::vector<std::uint32_t> readIntegers(const Source& source, std::size_t accessor);  // unsigned types, all components
// As readFloats, but NaN and infinity are refused.
std::vector<float> readFinite(const Source& source, std::size_t accessor, std::size_t components, float fill = 0.0f);

template <class Vector>
std::vector<Vector> asVectors(const std::vector<float>& flat) {
  constexpr auto kLength = static_cast<std::size_t>(Vector::length());
  std::vector<Vector> all(flat.size() / kLength);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t c = 0; c < kLength; ++c) all[i][static_cast<int>(c)] = flat[i * kLength + c];
  }
  return all;
}

}  // namespace crosslight::gltf

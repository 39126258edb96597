// One mesh in one pose: attributes, triangle lists from any mode, normals and tangents that are always usable.
#include <tiny_gltf.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/interrupt.h"
#include "scene/gltf_build.h"
#include "scene/material_textures.h"
#include "scene/mesh_repair.h"

namespace crosslight::gltf {
namespace {

class PrimitiveBuilder {
 public:
  PrimitiveBuilder(const Source& source, const tinygltf::Primitive& primitive, JsonAt at, const Posing& posing,
                   const std::vector<Material>& materials)
      : source_(source), primitive_(primitive), at_(std::move(at)), posing_(posing), materials_(materials) {}

  // Nothing when it draws no triangles. With a skin, `world` gets the positions.
  std::optional<Primitive> build(std::vector<glm::dvec3>& world) {
    if (primitive_.mode < TINYGLTF_MODE_TRIANGLES) {
      source_.document.notes.add(at_, "draws points or lines, which are left out");
      return std::nullopt;
    }
    if (!accessor("POSITION")) {
      source_.document.notes.add(at_, "has no POSITION and is left out");
      return std::nullopt;
    }
    readAttributes();
    out_.indices = triangles(vertexIndices());
    if (out_.indices.empty()) {
      source_.document.notes.add(at_, "draws no triangle");
      return std::nullopt;
    }
    if (posing_.skinned() && accessor("JOINTS_0")) {
      std::vector<bool> mirrored;
      world = applySkin(source_, primitive_, at_, posing_, out_, mirrored);
      unmirror(mirrored);
    }
    return std::move(out_);
  }

 private:
  std::optional<std::size_t> accessor(const char* attribute) const {
    const auto it = primitive_.attributes.find(attribute);
    if (it == primitive_.attributes.end()) return std::nullopt;
    return static_cast<std::size_t>(it->second);
  }

  void readAttributes() {
    out_.positions = asVectors<glm::vec3>(readFinite(source_, *accessor("POSITION"), 3));
    // Normals and tangents that are not finite are repaired later.
    if (const auto a = accessor("NORMAL")) out_.normals = asVectors<glm::vec3>(readFloats(source_, *a, 3));
    if (const auto a = accessor("TANGENT"); a && !out_.normals.empty()) {
      out_.tangents = asVectors<glm::vec4>(readFloats(source_, *a, 4));
    }
    if (const auto a = accessor("TEXCOORD_0")) out_.uv0 = asVectors<glm::vec2>(readFinite(source_, *a, 2));
    if (const auto a = accessor("TEXCOORD_1")) out_.uv1 = asVectors<glm::vec2>(readFinite(source_, *a, 2));
    if (const auto a = accessor("COLOR_0")) out_.colors = asVectors<glm::vec4>(readFinite(source_, *a, 4, 1.0f));
    out_.material =
        primitive_.material >= 0 ? primitive_.material : static_cast<int>(source_.document.count("materials"));
    if (!primitive_.targets.empty()) applyMorphTargets(source_, primitive_, posing_.weights, out_);
  }

  std::vector<std::uint32_t> vertexIndices() const {
    std::vector<std::uint32_t> indices;
    if (primitive_.indices < 0) {
      indices.resize(out_.positions.size());
      source_.document.budget.charge(indices.size() * sizeof(std::uint32_t), at_);
      std::iota(indices.begin(), indices.end(), 0u);
      return indices;
    }
    indices = readIntegers(source_, static_cast<std::size_t>(primitive_.indices));
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (indices[i] >= out_.positions.size()) {
        at_.at("indices").fail(
            fmt::format("index {} is vertex {}, there are {}", i, indices[i], out_.positions.size()));
      }
    }
    return indices;
  }

  // glTF 2.0, 3.7.2.1: the triangles of strips and fans, first vertex first.
  std::vector<std::uint32_t> triangles(std::vector<std::uint32_t> in) const {
    const bool isStrip = primitive_.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
    if (!isStrip && primitive_.mode != TINYGLTF_MODE_TRIANGLE_FAN) {
      if (in.size() % 3 != 0)
        source_.document.notes.add(at_, "its vertices do not fill the last triangle, which is left out");
      in.resize(in.size() / 3 * 3);
      return in;
    }
    source_.document.budget.charge(in.size() * 3 * sizeof(std::uint32_t), at_);
    std::vector<std::uint32_t> out;
    for (std::size_t i = 0; i + 2 < in.size(); ++i) {
      const std::uint32_t a = isStrip ? in[i] : in[i + 1];
      const std::uint32_t b = isStrip ? in[i + 1 + i % 2] : in[i + 2];
      const std::uint32_t c = isStrip ? in[i + 2 - i % 2] : in[0];
      // Repeated vertices stitch strips together; they draw nothing.
      if (a != b && b != c && a != c) out.insert(out.end(), {a, b, c});
    }
    return out;
  }

  // Where the pose mirrors, front faces would turn into back faces.
  void unmirror(const std::vector<bool>& mirrored) {
    for (std::size_t i = 0; i + 2 < out_.indices.size(); i += 3) {
      const int count = mirrored[out_.indices[i]] + mirrored[out_.indices[i + 1]] + mirrored[out_.indices[i + 2]];
      if (count >= 2) std::swap(out_.indices[i + 1], out_.indices[i + 2]);
    }
  }

  const Source& source_;
  const tinygltf::Primitive& primitive_;
  JsonAt at_;
  const Posing& posing_;
  const std::vector<Material>& materials_;
  Primitive out_;
};

// The set that a texture reads; empty when the primitive has none.
const std::vector<glm::vec2>& uvOf(const Primitive& primitive, const TextureUse& use) {
  return use.texCoord == 1 ? primitive.uv1 : primitive.uv0;
}

void warnOfMissingUv(const Primitive& primitive, const Material& material, const JsonAt& at, Notes& notes) {
  for (const TextureUse* use : texturesOf(material)) {
    if (use->present() && uvOf(primitive, *use).empty()) {
      notes.add(at,
                fmt::format("its material reads TEXCOORD_{}, which it does not have; (0, 0) is taken", use->texCoord));
    }
  }
}

void finish(Primitive& primitive, const Material& material, const JsonAt& at, Document& document) {
  warnOfMissingUv(primitive, material, at, document.notes);
  // Splitting makes every corner a vertex of at most 80 bytes; tangents add at most as much again.
  document.budget.charge(primitive.indices.size() * 80, at);
  if (primitive.normals.empty()) {
    makeFlatNormals(primitive);
  } else if (repairNormals(primitive) > 0) {
    document.notes.add(at, "has normals that are zero or not finite; they become the triangle's");
  }
  if (!primitive.tangents.empty()) {
    if (repairTangents(primitive) > 0) {
      document.notes.add(at, "has tangents that cannot be used; they become some direction across the normal");
    }
  } else if (const TextureUse* along = tangentTexture(material)) {
    if (!uvOf(primitive, *along).empty()) {
      makeTangents(primitive, uvOf(primitive, *along));
    } else if (material.layers.anisotropy > 0) {
      document.notes.add(
          at, "has neither tangents nor texture coordinates to make them of; it reflects alike in all directions");
    }
  }
}

// Skinned vertices are in world space. Floats hold them relative to the middle of the mesh.
void storeAroundOrigin(PosedMesh& posed, const std::vector<std::vector<glm::dvec3>>& world, const JsonAt& at) {
  DBounds bounds;
  for (const auto& positions : world) {
    for (const glm::dvec3& p : positions) {
      for (int axis = 0; axis < 3; ++axis) {
        if (!(std::abs(p[axis]) <= kLargestCoordinate))
          at.fail(fmt::format("its skin moves a vertex beyond {:g}", kLargestCoordinate));
      }
      bounds.add(p);
    }
  }
  if (bounds.empty()) return;
  posed.origin = (bounds.lower + bounds.upper) * 0.5;
  for (std::size_t p = 0; p < world.size(); ++p) {
    for (std::size_t i = 0; i < world[p].size(); ++i) {
      posed.mesh.primitives[p].positions[i] = glm::vec3(world[p][i] - posed.origin);
    }
  }
}

}  // namespace

std::size_t targetCount(const Source& source, std::size_t mesh) {
  const auto& primitives = source.model.meshes[mesh].primitives;
  return primitives.empty() ? 0 : primitives[0].targets.size();
}

PosedMesh buildMesh(const Source& source, std::size_t index, const Posing& posing,
                    const std::vector<Material>& materials) {
  const tinygltf::Mesh& mesh = source.model.meshes[index];
  const JsonAt at = source.document.entry("meshes", index);
  PosedMesh posed;
  source.document.budget.charge(mesh.name.size(), at);
  posed.mesh.name = mesh.name;
  std::vector<std::vector<glm::dvec3>> world;
  std::vector<JsonAt> places;
  for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
    throwIfInterrupted();
    const JsonAt place = at.at("primitives").item(p);
    std::vector<glm::dvec3> positions;
    std::optional<Primitive> primitive =
        PrimitiveBuilder(source, mesh.primitives[p], place, posing, materials).build(positions);
    if (!primitive) continue;
    posed.mesh.primitives.push_back(std::move(*primitive));
    world.push_back(std::move(positions));
    places.push_back(place);
  }
  if (posing.skinned()) storeAroundOrigin(posed, world, at);
  const Material defaultMaterial;
  for (std::size_t p = 0; p < posed.mesh.primitives.size(); ++p) {
    Primitive& primitive = posed.mesh.primitives[p];
    const auto material = static_cast<std::size_t>(primitive.material);
    finish(primitive, material < materials.size() ? materials[material] : defaultMaterial, places[p], source.document);
  }
  return posed;
}

}  // namespace crosslight::gltf

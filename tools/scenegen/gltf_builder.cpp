// The buffer is a list of views in the order of their making, each on a multiple of four bytes.
#include "scenegen/gltf_builder.h"

#include <cstring>
#include <set>

#include "base/check.h"
#include "base/file.h"

namespace crosslight::scenegen {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian");

constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;
constexpr std::size_t kLargestShortIndex = 65534;  // 65535 restarts primitives

void collectExtensions(const Json& json, std::set<std::string>& names) {
  if (!json.is_structured()) return;
  for (const auto& [key, value] : json.items()) {
    if (json.is_object() && key == "extensions") {
      for (const auto& [name, ignored] : value.items()) names.insert(name);
    }
    collectExtensions(value, names);
  }
}

int indexOf(std::size_t sizeAfterAdding) { return static_cast<int>(sizeAfterAdding) - 1; }

}  // namespace

GltfBuilder::GltfBuilder(const std::string& title) {
  root_["asset"] = {{"version", "2.0"}, {"generator", "crosslight scenegen"}};
  root_["extensionsUsed"] = Json::array();
  root_["scene"] = 0;
  root_["scenes"] = Json::array();
  for (const char* list : {"nodes", "cameras", "meshes", "materials", "textures", "images", "samplers"}) {
    root_[list] = Json::array();
  }
  root_["accessors"] = Json::array();
  root_["bufferViews"] = Json::array();
  beginScene(title);
}

void GltfBuilder::beginScene(const std::string& title) {
  root_["scenes"].push_back({{"name", title}, {"nodes", Json::array()}});
}

int GltfBuilder::append(const char* list, Json element) {
  root_[list].push_back(std::move(element));
  return indexOf(root_[list].size());
}

int GltfBuilder::addMaterial(Json material) { return append("materials", std::move(material)); }
int GltfBuilder::addNode(Json node) { return append("nodes", std::move(node)); }
int GltfBuilder::addCamera(Json camera) { return append("cameras", std::move(camera)); }

int GltfBuilder::addRoot(Json node) {
  const int index = addNode(std::move(node));
  root_["scenes"].back()["nodes"].push_back(index);
  return index;
}

int GltfBuilder::addLight(Json light, const char* extension) {
  Json& lights = root_["extensions"][extension]["lights"];
  lights.push_back(std::move(light));
  return indexOf(lights.size());
}

void GltfBuilder::setAtmosphere(Json atmosphere) {
  root_["scenes"].back()["extensions"]["CROSSLIGHT_scene_atmosphere"] = std::move(atmosphere);
}

int GltfBuilder::addTexture(const std::string& name, const std::vector<std::byte>& png, Json sampler) {
  const int view = addView(png.data(), png.size(), 0);
  const int image = append("images", {{"name", name}, {"bufferView", view}, {"mimeType", "image/png"}});
  const int samplerIndex = append("samplers", std::move(sampler));
  return append("textures", {{"sampler", samplerIndex}, {"source", image}});
}

int GltfBuilder::addView(const void* data, std::size_t sizeBytes, int target) {
  while (buffer_.size() % 4 != 0) buffer_.push_back(std::byte{0});
  Json view = {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", sizeBytes}};
  if (target != 0) view["target"] = target;
  const auto* first = static_cast<const std::byte*>(data);
  buffer_.insert(buffer_.end(), first, first + sizeBytes);
  return append("bufferViews", std::move(view));
}

template <class T>
int GltfBuilder::addAccessor(const std::vector<T>& values, const char* type, bool withBounds) {
  Json accessor = {{"bufferView", addView(values.data(), values.size() * sizeof(T), kArrayBuffer)},
                   {"componentType", kFloat},
                   {"count", values.size()},
                   {"type", type}};
  if (withBounds) {
    T low = values.front(), high = values.front();
    for (const T& v : values) {
      for (int i = 0; i < T::length(); ++i) {
        low[i] = std::min(low[i], v[i]);
        high[i] = std::max(high[i], v[i]);
      }
    }
    for (int i = 0; i < T::length(); ++i) {
      accessor["min"].push_back(static_cast<double>(low[i]));
      accessor["max"].push_back(static_cast<double>(high[i]));
    }
  }
  return append("accessors", std::move(accessor));
}

int GltfBuilder::addScalars(const std::vector<float>& values) {
  const auto bytes = values.size() * sizeof(float);
  return append("accessors", {{"bufferView", addView(values.data(), bytes, 0)},
                              {"componentType", kFloat},
                              {"count", values.size()},
                              {"type", "SCALAR"}});
}

int GltfBuilder::addIndices(const std::vector<std::uint32_t>& indices, std::size_t vertexCount) {
  const bool isShort = vertexCount - 1 <= kLargestShortIndex;
  const std::vector<std::uint16_t> shorts(isShort ? indices.begin() : indices.end(), indices.end());
  const int view = isShort ? addView(shorts.data(), shorts.size() * sizeof(std::uint16_t), kElementArrayBuffer)
                           : addView(indices.data(), indices.size() * sizeof(std::uint32_t), kElementArrayBuffer);
  const auto [low, high] = std::minmax_element(indices.begin(), indices.end());
  return append("accessors", {{"bufferView", view},
                              {"componentType", isShort ? kUnsignedShort : kUnsignedInt},
                              {"count", indices.size()},
                              {"type", "SCALAR"},
                              {"min", {*low}},
                              {"max", {*high}}});
}

Json GltfBuilder::addGeometry(const Primitive& mesh) {
  CL_CHECK(!mesh.positions.empty() && !mesh.indices.empty());
  Json attributes = {{"POSITION", addAccessor(mesh.positions, "VEC3", true)}};
  if (!mesh.flatNormals) attributes["NORMAL"] = addAccessor(mesh.normals, "VEC3", true);
  if (!mesh.tangents.empty()) attributes["TANGENT"] = addAccessor(mesh.tangents, "VEC4", true);
  if (!mesh.uv0.empty()) attributes["TEXCOORD_0"] = addAccessor(mesh.uv0, "VEC2", true);
  if (!mesh.uv1.empty()) attributes["TEXCOORD_1"] = addAccessor(mesh.uv1, "VEC2", true);
  if (!mesh.colors.empty()) attributes["COLOR_0"] = addAccessor(mesh.colors, "VEC4", true);
  const int indices = addIndices(mesh.indices, mesh.positions.size());
  return {{"attributes", attributes}, {"indices", indices}};
}

int GltfBuilder::addMesh(const std::string& name, const std::vector<std::pair<Json, int>>& geometryAndMaterial) {
  Json mesh = {{"name", name}, {"primitives", Json::array()}};
  for (const auto& [geometry, material] : geometryAndMaterial) {
    Json primitive = geometry;
    primitive["material"] = material;
    mesh["primitives"].push_back(std::move(primitive));
  }
  return append("meshes", std::move(mesh));
}

void GltfBuilder::addFile(const std::string& name, std::vector<std::byte> bytes) {
  files_.emplace_back(name, std::move(bytes));
}

void GltfBuilder::write(const std::filesystem::path& folder, const std::string& name) {
  std::set<std::string> names;
  collectExtensions(root_, names);
  root_["extensionsUsed"] = names;
  root_["buffers"] = Json::array({{{"uri", name + ".bin"}, {"byteLength", buffer_.size()}}});
  Json written = Json::object();
  for (const auto& [key, value] : root_.items()) {  // glTF forbids empty lists
    if (!value.is_structured() || !value.empty()) written[key] = value;
  }
  std::filesystem::create_directories(folder);
  writeFileAtomically(folder / (name + ".bin"), buffer_);
  writeFileAtomically(folder / (name + ".gltf"), toText(written));
  for (const auto& [file, bytes] : files_) writeFileAtomically(folder / file, bytes);
}

}  // namespace crosslight::scenegen

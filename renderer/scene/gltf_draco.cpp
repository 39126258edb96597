// KHR_draco_mesh_compression: compressed primitives get plain accessors in new buffers before anything reads them.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wconversion"
#include <draco/compression/decode.h>
#pragma GCC diagnostic pop
#include <fmt/format.h>

#include <cstring>
#include <map>

#include "scene/gltf_document.h"

namespace crosslight::gltf {
namespace {

constexpr const char* kExtension = "KHR_draco_mesh_compression";

std::unique_ptr<draco::Mesh> decodeView(const JsonAt& compressed, std::size_t viewIndex, Document& document) {
  const JsonAt view = document.entry("bufferViews", viewIndex);
  const Bytes& buffer = document.buffers[static_cast<std::size_t>(view.at("buffer").integer())];
  const auto offset = static_cast<std::size_t>(integerOr(view, "byteOffset", 0));
  const auto length = static_cast<std::size_t>(view.at("byteLength").integer());
  if (offset + length > buffer.size()) compressed.fail("its bufferView has no bytes behind it");
  draco::DecoderBuffer input;
  input.Init(reinterpret_cast<const char*>(buffer.data()) + offset, length);
  const auto type = draco::Decoder::GetEncodedGeometryType(&input);
  if (!type.ok() || type.value() != draco::TRIANGULAR_MESH) compressed.fail("holds no Draco triangle mesh");
  draco::Decoder decoder;
  auto mesh = decoder.DecodeMeshFromBuffer(&input);
  if (!mesh.ok()) compressed.fail("its Draco data are broken: " + mesh.status().error_msg_string());
  return std::move(mesh).value();
}

template <class T>
bool convert(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int components, Bytes& out) {
  std::vector<T> values(static_cast<std::size_t>(components));
  unsigned char* target = out.data();
  for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
    if (!attribute.ConvertValue<T>(attribute.mapped_index(point), static_cast<std::int8_t>(components),
                                   values.data())) {
      return false;
    }
    std::memcpy(target, values.data(), values.size() * sizeof(T));
    target += values.size() * sizeof(T);
  }
  return true;
}

bool convertTo(std::int64_t type, const draco::Mesh& mesh, const draco::PointAttribute& attribute, int components,
               Bytes& out) {
  switch (type) {
    case kByte:
      return convert<std::int8_t>(mesh, attribute, components, out);
    case kUnsignedByte:
      return convert<std::uint8_t>(mesh, attribute, components, out);
    case kShort:
      return convert<std::int16_t>(mesh, attribute, components, out);
    case kUnsignedShort:
      return convert<std::uint16_t>(mesh, attribute, components, out);
    case kUnsignedInt:
      return convert<std::uint32_t>(mesh, attribute, components, out);
    default:
      return convert<float>(mesh, attribute, components, out);
  }
}

std::size_t appendAccessor(Document& document, Json accessor, Bytes bytes) {
  accessor["bufferView"] = appendBufferView(document, std::move(bytes));
  accessor.erase("byteOffset");
  accessor.erase("sparse");
  document.json["accessors"].push_back(std::move(accessor));
  return document.json["accessors"].size() - 1;
}

class DracoReader {
 public:
  explicit DracoReader(Document& document) : document_(document) {}

  void primitive(const std::string& path, Json& target) {
    const JsonAt primitive(target, document_.fileName, path);
    const auto compressed = primitive.extension(kExtension);
    if (!compressed) return;
    if (primitive.find("mode") && primitive.at("mode").integer() != 4 && primitive.at("mode").integer() != 5) {
      compressed->fail("needs a primitive of mode 4 or 5");
    }
    const draco::Mesh& mesh = meshOf(*compressed);
    Json attributes = target.at("attributes");
    for (const auto& [name, ignored] : compressed->at("attributes").value().items()) {
      attributes[name] = attribute(mesh, compressed->at("attributes").at(name), primitive.at("attributes").at(name));
    }
    const std::size_t newIndices = indices(mesh, *compressed);
    target["attributes"] = std::move(attributes);
    target["indices"] = newIndices;
    target["mode"] = 4;  // the decoder hands out separate triangles, also for strips
    target["extensions"].erase(kExtension);
  }

 private:
  const draco::Mesh& meshOf(const JsonAt& compressed) {
    compressed.at("attributes").object();
    const std::size_t view = compressed.at("bufferView").reference(document_.count("bufferViews"), "bufferView");
    auto& mesh = meshes_[view];
    if (!mesh) mesh = decodeView(compressed, view, document_);
    return *mesh;
  }

  std::size_t attribute(const draco::Mesh& mesh, const JsonAt& id, const JsonAt& reference) {
    const std::size_t index = reference.reference(document_.count("accessors"), "accessor");
    const JsonAt accessor = document_.entry("accessors", index);
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(
        static_cast<std::uint32_t>(id.integer(0, std::numeric_limits<std::uint32_t>::max())));
    if (attribute == nullptr) id.fail("the Draco data have no attribute of this id");
    if (accessor.at("count").integer() != static_cast<std::int64_t>(mesh.num_points())) {
      reference.fail(fmt::format("its accessor has {} elements, the Draco data {} points",
                                 accessor.at("count").integer(), mesh.num_points()));
    }
    const std::string& type = accessor.at("type").string();
    const std::int64_t component = accessor.at("componentType").integer();
    Bytes bytes(elementBytes(type, component) * mesh.num_points());
    document_.budget.charge(bytes.size(), id);
    if (!convertTo(component, mesh, *attribute, static_cast<int>(componentCount(type)), bytes)) {
      id.fail("its values do not convert to the accessor's component type");
    }
    return appendAccessor(document_, accessor.value(), std::move(bytes));
  }

  std::size_t indices(const draco::Mesh& mesh, const JsonAt& compressed) {
    if (mesh.num_faces() == 0) compressed.fail("has no triangles");
    Bytes bytes(std::size_t{mesh.num_faces()} * 3 * sizeof(std::uint32_t));
    document_.budget.charge(bytes.size(), compressed);
    unsigned char* target = bytes.data();
    for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face) {
      for (const draco::PointIndex& corner : mesh.face(face)) {
        const std::uint32_t value = corner.value();
        std::memcpy(target, &value, sizeof(value));
        target += sizeof(value);
      }
    }
    const Json accessor = {
        {"type", "SCALAR"}, {"componentType", kUnsignedInt}, {"count", std::size_t{mesh.num_faces()} * 3}};
    return appendAccessor(document_, accessor, std::move(bytes));
  }

  Document& document_;
  std::map<std::size_t, std::unique_ptr<draco::Mesh>> meshes_;
};

}  // namespace

void decodeDraco(Document& document) {
  DracoReader reader(document);
  const auto meshes = document.json.find("meshes");
  if (meshes == document.json.end()) return;
  for (std::size_t m = 0; m < meshes->size(); ++m) {
    Json& primitives = (*meshes)[m]["primitives"];
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      reader.primitive(fmt::format("/meshes/{}/primitives/{}", m, p), primitives[p]);
    }
  }
}

}  // namespace crosslight::gltf

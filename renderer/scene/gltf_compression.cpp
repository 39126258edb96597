// EXT_meshopt_compression: compressed views become plain ones in new buffers before anything reads them.
#include <fmt/format.h>
#include <meshoptimizer.h>

#include "scene/gltf_document.h"

namespace crosslight::gltf {
namespace {

int decode(const std::string& mode, Bytes& out, std::size_t count, std::size_t stride, const unsigned char* data,
           std::size_t size) {
  if (mode == "ATTRIBUTES") return meshopt_decodeVertexBuffer(out.data(), count, stride, data, size);
  if (mode == "TRIANGLES") return meshopt_decodeIndexBuffer(out.data(), count, stride, data, size);
  return meshopt_decodeIndexSequence(out.data(), count, stride, data, size);
}

void applyFilter(const std::string& filter, Bytes& out, std::size_t count, std::size_t stride) {
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), count, stride);
  if (filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), count, stride);
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), count, stride);
}

Bytes decoded(const JsonAt& compressed, Document& document) {
  const auto size = [&](const char* key) { return static_cast<std::size_t>(integerOr(compressed, key, 0)); };
  const Bytes& buffer = document.buffers[size("buffer")];
  const std::size_t end = size("byteOffset") + size("byteLength");
  if (end > buffer.size()) compressed.fail("has no bytes behind it");
  const std::size_t count = size("count");
  const std::size_t stride = size("byteStride");
  document.budget.charge(count * stride, compressed);
  Bytes out(count * stride);
  const std::string mode = compressed.at("mode").string();
  if (decode(mode, out, count, stride, buffer.data() + size("byteOffset"), size("byteLength")) != 0) {
    compressed.fail("its compressed data are broken");
  }
  applyFilter(stringOr(compressed, "filter", "NONE"), out, count, stride);
  return out;
}

}  // namespace

std::size_t appendBufferView(Document& document, Bytes bytes, std::size_t byteStride) {
  Json view = {{"buffer", document.buffers.size()}, {"byteLength", bytes.size()}};
  if (byteStride != 0) view["byteStride"] = byteStride;
  document.json["buffers"].push_back({{"byteLength", bytes.size()}});
  document.json["bufferViews"].push_back(std::move(view));
  document.buffers.push_back(std::move(bytes));
  return document.json["bufferViews"].size() - 1;
}

void decodeMeshopt(Document& document) {
  const std::size_t count = document.count("bufferViews");
  for (std::size_t i = 0; i < count; ++i) {
    const auto compressed = document.entry("bufferViews", i).extension("EXT_meshopt_compression");
    if (!compressed) continue;
    Bytes bytes = decoded(*compressed, document);
    Json& view = document.json["bufferViews"][i];
    view["buffer"] = document.buffers.size();
    view["byteOffset"] = 0;
    view["byteLength"] = bytes.size();
    view.erase("extensions");
    document.json["buffers"].push_back({{"byteLength", bytes.size()}});
    document.buffers.push_back(std::move(bytes));
  }
}

}  // namespace crosslight::gltf

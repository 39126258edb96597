// tinygltf's implementation, and its use: it parses the core of the model from JSON that has been validated, and is
// given buffers from memory. It never opens a file and never sees extensions, extras or images.
#include <fstream>  // tinygltf's writer needs it where TINYGLTF_NO_FS leaves it out
#include <sstream>

#include "base/check.h"
#include "base/error.h"
// Before tinygltf, which includes nlohmann's header with symbols hidden.
#include "scene/gltf_model.h"

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>

namespace crosslight::gltf {
namespace {

// Names that the buffers get on their way through tinygltf.
std::string bufferName(std::size_t index) { return "buffer" + std::to_string(index); }

std::optional<std::size_t> bufferIndex(const std::string& name, std::size_t count) {
  // tinygltf asks for "folder/name".
  const std::size_t start = name.rfind("buffer");
  if (start == std::string::npos) return std::nullopt;
  const std::size_t index = std::stoul(name.substr(start + 6));
  return index < count ? std::optional(index) : std::nullopt;
}

bool hasBuffer(const std::string& name, void* user) {
  return bufferIndex(name, static_cast<Document*>(user)->buffers.size()).has_value();
}

std::string sameName(const std::string& name, void*) { return name; }

bool takeBuffer(std::vector<unsigned char>* out, std::string*, const std::string& name, void* user) {
  auto& buffers = static_cast<Document*>(user)->buffers;
  const std::optional<std::size_t> index = bufferIndex(name, buffers.size());
  if (!index) return false;
  *out = std::move(buffers[*index]);
  return true;
}

bool writeNothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }

void removeEverywhere(Json& value, const char* key) {
  if (value.is_object()) value.erase(key);
  if (!value.is_structured()) return;
  for (Json& child : value) removeEverywhere(child, key);
}

// tinygltf wants every accessor of indices to have a view; glTF lets it be missing and means zeros.
void giveIndicesViews(Document& document) {
  for (std::size_t mesh = 0; mesh < document.count("meshes"); ++mesh) {
    for (const JsonAt& primitive : document.entry("meshes", mesh).at("primitives").items()) {
      const int reference = referenceOr(primitive, "indices", document.count("accessors"), "accessor");
      if (reference < 0) continue;
      const auto index = static_cast<std::size_t>(reference);
      const JsonAt at = document.entry("accessors", index);
      if (at.find("bufferView")) continue;
      const std::size_t bytes = static_cast<std::size_t>(at.at("count").integer()) *
                                elementBytes(at.at("type").string(), at.at("componentType").integer());
      document.budget.charge(bytes, at);
      const std::size_t view = appendBufferView(document, Bytes(bytes, 0));
      document.json["accessors"][index]["bufferView"] = view;
      document.json["accessors"][index].erase("byteOffset");
    }
  }
}

Json coreOf(const Document& document) {
  Json core = document.json;
  core.erase("images");
  // Before the recursion: tinygltf drops what it parses under these names, and their depth is the file's choice.
  removeEverywhere(core, "extensions");
  removeEverywhere(core, "extras");
  for (std::size_t i = 0; i < document.buffers.size(); ++i) {
    core["buffers"][i] = {{"uri", bufferName(i)}, {"byteLength", document.buffers[i].size()}};
  }
  return core;
}

}  // namespace

void ModelDeleter::operator()(tinygltf::Model* model) const { delete model; }

ModelPointer parseModel(Document& document) {
  giveIndicesViews(document);
  // An empty buffer is the unread fallback of compressed views; tinygltf refuses to load nothing.
  for (Bytes& bytes : document.buffers) {
    if (bytes.empty()) bytes.push_back(0);
  }
  const std::string text = coreOf(document).dump();
  if (text.size() > std::numeric_limits<unsigned>::max())
    throw InputError(document.fileName, "has more than 4 GiB of JSON");
  ModelPointer model(new tinygltf::Model);
  tinygltf::TinyGLTF parser;
  parser.SetFsCallbacks({hasBuffer, sameName, takeBuffer, writeNothing, &document});
  std::string errors;
  std::string warnings;
  const bool parsed = parser.LoadASCIIFromString(model.get(), &errors, &warnings, text.data(),
                                                 static_cast<unsigned>(text.size()), "", tinygltf::NO_REQUIRE);
  if (!parsed) throw InputError(document.fileName, "tinygltf refuses it: " + errors);
  // The validated JSON and the model are read side by side: their indices must agree.
  CL_CHECK_EQ(model->accessors.size(), document.count("accessors"));
  CL_CHECK_EQ(model->bufferViews.size(), document.count("bufferViews"));
  CL_CHECK_EQ(model->meshes.size(), document.count("meshes"));
  CL_CHECK_EQ(model->nodes.size(), document.count("nodes"));
  CL_CHECK_EQ(model->materials.size(), document.count("materials"));
  CL_CHECK_EQ(model->animations.size(), document.count("animations"));
  for (std::size_t i = 0; i < model->meshes.size(); ++i) {
    CL_CHECK_EQ(model->meshes[i].primitives.size(), document.json["meshes"][i]["primitives"].size());
  }
  return model;
}

}  // namespace crosslight::gltf

// The file before anything is made of it: validated JSON, the bytes it refers to, and the budget that bounds what it
// may cost. Internal to the scene room.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/hash.h"
#include "scene/gltf_json.h"
#include "scene/load.h"

namespace crosslight::gltf {

using Bytes = std::vector<unsigned char>;

// Every byte that is read, decoded or built is charged once for each time that is done, and nothing is given back:
// so the budget bounds memory and work alike, whatever a small hostile file repeats.
class Budget {
 public:
  explicit Budget(std::uint64_t limitBytes) : limitBytes_(limitBytes) {}
  void charge(std::uint64_t bytes, const JsonAt& forWhat);
  std::uint64_t leftBytes() const { return limitBytes_ - usedBytes_; }

 private:
  std::uint64_t limitBytes_;
  std::uint64_t usedBytes_ = 0;
};

// Warnings that a file can give rise to many times over: each text is said once, with its first place and how many
// more.
class Notes {
 public:
  void add(const JsonAt& at, const std::string& what);
  void log() const;

 private:
  struct Entry {
    std::string place;
    std::size_t count = 0;
  };
  std::map<std::string, Entry> entries_;
};

struct Document {
  Document(const std::filesystem::path& file, const LoadOptions& options);
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  JsonAt root() const { return JsonAt(json, fileName, ""); }
  JsonAt entry(const char* array, std::size_t index) const { return root().at(array).item(index); }
  std::size_t count(const char* array) const;  // length of a top-level array, 0 when it is missing
  bool uses(const char* extension) const;      // listed in extensionsUsed

  std::filesystem::path folder;  // canonical; nothing outside it is read
  std::string fileName;          // as the user gave it, for messages
  Json json;
  bool isGlb = false;
  bool hasGlbChunk = false;
  Bytes glbChunk;              // moved into its buffer
  std::vector<Bytes> buffers;  // by buffer index, each as long as its byteLength; empty for meshopt's fallbacks
  std::vector<Bytes> images;   // still encoded
  std::uint64_t fileBytes = 0;
  bool hashContents = false;
  std::uint64_t contentHash = kHashSeed;  // of the file and of what it refers to, in the order of reading
  Budget budget;
  Notes notes;
};

// gltf_validate*.cpp: shape of the JSON, references, ranges, cycles. Knows nothing of the bytes behind it.
void validateDocument(const Document& document);
void validateExtensions(const Document& document);
void validateData(const Document& document);    // buffers, bufferViews, accessors
void validateMeshes(const Document& document);  // meshes and what they refer to
void validateMaterials(const Document& document);
void validateNodes(const Document& document);  // nodes, scenes, skins, cameras
void validateAnimations(const Document& document);

// gltf_resources.cpp: fills `buffers` and `images`.
void loadResources(Document& document);
// A file that a URI names: below the document's folder and there. InputError else.
std::filesystem::path fileInFolder(const JsonAt& uri, const Document& document);

// gltf_compression.cpp, gltf_draco.cpp: replace compressed views by plain ones (new buffers, rewritten JSON).
void decodeMeshopt(Document& document);
void decodeDraco(Document& document);
// A new buffer with one view over all of it; the view's index.
std::size_t appendBufferView(Document& document, Bytes bytes, std::size_t byteStride = 0);

// Numbers that the specification gives to names.
std::size_t componentCount(const std::string& accessorType);  // 0: no such type
std::size_t componentBytes(std::int64_t componentType);       // 0: no such type
// Bytes of one element; columns of small matrices start at multiples of four.
std::size_t elementBytes(const std::string& accessorType, std::int64_t componentType);

enum ComponentType : std::int64_t {
  kByte = 5120,
  kUnsignedByte = 5121,
  kShort = 5122,
  kUnsignedShort = 5123,
  kUnsignedInt = 5125,
  kFloat = 5126,
};

}  // namespace crosslight::gltf

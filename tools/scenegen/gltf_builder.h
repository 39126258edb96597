// Collects a glTF 2.0 asset: JSON and one binary buffer. Knows the file format; what is in the scenes it leaves to
// others.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.h"
#include "scenegen/json_text.h"

namespace crosslight::scenegen {

class GltfBuilder {
 public:
  // `title` is the first scene's name.
  explicit GltfBuilder(const std::string& title);

  // A further scene of the same file; what is added afterwards goes there.
  void beginScene(const std::string& title);

  int addMaterial(Json material);
  int addLight(Json light, const char* extension = "KHR_lights_punctual");
  int addTexture(const std::string& name, const std::vector<std::byte>& png, Json sampler);

  // Accessors for the mesh; the answer is a glTF primitive without a material. With `flatNormals` no NORMAL is written,
  // which by the specification means flat shading.
  Json addGeometry(const Primitive& mesh);
  int addMesh(const std::string& name, const std::vector<std::pair<Json, int>>& geometryAndMaterial);

  // Adds a node to the current scene's roots, or only to the file (for use as a child).
  int addRoot(Json node);
  int addNode(Json node);
  int addCamera(Json camera);

  int addScalars(const std::vector<float>& values);  // an accessor without a mesh

  void setAtmosphere(Json atmosphere);  // CROSSLIGHT_scene_atmosphere of the current scene

  void addFile(const std::string& name, std::vector<std::byte> bytes);  // beside the asset

  // NAME.gltf and NAME.bin in the folder, and what was added. Only the extensions that are used are listed.
  void write(const std::filesystem::path& folder, const std::string& name);

 private:
  int append(const char* list, Json element);
  int addView(const void* data, std::size_t sizeBytes, int target);
  template <class T>
  int addAccessor(const std::vector<T>& values, const char* type, bool withBounds);
  int addIndices(const std::vector<std::uint32_t>& indices, std::size_t vertexCount);

  Json root_;
  std::vector<std::byte> buffer_;
  std::vector<std::pair<std::string, std::vector<std::byte>>> files_;
};

}  // namespace crosslight::scenegen

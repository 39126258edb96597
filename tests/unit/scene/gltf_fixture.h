// Handmade glTF files for the tests of the scene room: accessors from values, a folder that goes away again.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/log.h"
#include "scene/load.h"

namespace crosslight::test {

using Json = nlohmann::json;

class TempFolder {
 public:
  TempFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "crosslight-scene-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = pattern;
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

template <class T>
constexpr int componentTypeOf() {
  if constexpr (std::is_same_v<T, std::int8_t>) return 5120;
  if constexpr (std::is_same_v<T, std::uint8_t>) return 5121;
  if constexpr (std::is_same_v<T, std::int16_t>) return 5122;
  if constexpr (std::is_same_v<T, std::uint16_t>) return 5123;
  if constexpr (std::is_same_v<T, std::uint32_t>) return 5125;
  return 5126;
}

inline std::size_t widthOf(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  return type == "MAT4" ? 16 : 4;
}

inline std::string percentEncoded(const std::string& bytes) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const char c : bytes) {
    text += {'%', kDigits[static_cast<unsigned char>(c) >> 4], kDigits[static_cast<unsigned char>(c) & 15]};
  }
  return text;
}

inline std::string base64Decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xffu);
  }
  return bytes;
}

class GltfFile {
 public:
  Json json = {{"asset", {{"version", "2.0"}}}};

  std::size_t view(const std::string& bytes) {
    bin_.resize((bin_.size() + 3) / 4 * 4, '\0');
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bin_.size()}, {"byteLength", bytes.size()}});
    bin_ += bytes;
    return json["bufferViews"].size() - 1;
  }

  template <class T>
  std::size_t view(const std::vector<T>& values) {
    return view(std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
  }

  template <class T>
  std::size_t accessor(const std::vector<T>& values, const std::string& type, bool normalized = false) {
    Json accessor = {{"bufferView", view(values)},
                     {"componentType", componentTypeOf<T>()},
                     {"count", values.size() / widthOf(type)},
                     {"type", type}};
    if (normalized) accessor["normalized"] = true;
    json["accessors"].push_back(accessor);
    return json["accessors"].size() - 1;
  }
  std::size_t floats(const std::vector<float>& values, const std::string& type) { return accessor(values, type); }

  // A mesh of one primitive; its index.
  std::size_t mesh(Json primitive) {
    json["meshes"].push_back({{"primitives", Json::array({std::move(primitive)})}});
    return json["meshes"].size() - 1;
  }
  std::size_t node(Json node) {
    json["nodes"].push_back(std::move(node));
    return json["nodes"].size() - 1;
  }
  void extension(const std::string& name) { json["extensionsUsed"].push_back(name); }

  std::filesystem::path save(const std::string& name = "scene.gltf") {
    Json out = json;
    if (!bin_.empty()) {
      out["buffers"][0] = {{"uri", "data.bin"}, {"byteLength", bin_.size()}};
      folder_.write("data.bin", bin_);
    }
    return folder_.write(name, out.dump());
  }
  // The file with its bytes inside, as text.
  std::string embedded() const {
    Json out = json;
    out["buffers"][0] = {{"uri", "data:," + percentEncoded(bin_)}, {"byteLength", bin_.size()}};
    return out.dump();
  }
  Scene load(const LoadOptions& options = {}) { return loadScene(save(), options); }
  const TempFolder& folder() const { return folder_; }
  const std::string& bin() const { return bin_; }

 private:
  std::string bin_;
  TempFolder folder_;
};

inline const std::vector<float> kTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};

// One node with one triangle in the plane z = 0, normal +Z; primitive and node can be changed afterwards.
inline void addTriangle(GltfFile& file) {
  const std::size_t positions = file.floats(kTriangle, "VEC3");
  file.node({{"mesh", file.mesh({{"attributes", {{"POSITION", positions}}}})}});
}

// What loading throws; empty when it does not.
inline std::string refusal(GltfFile& file, const LoadOptions& options = {}) {
  try {
    file.load(options);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

inline bool warned(const std::string& part) {
  for (const std::string& warning : loggedWarnings()) {
    if (warning.find(part) != std::string::npos) return true;
  }
  return false;
}

#define EXPECT_REFUSED(file, path)                                                                       \
  do {                                                                                                   \
    const std::string text = ::crosslight::test::refusal(file);                                          \
    EXPECT_NE(text.find(std::string("scene.gltf: ") + (path)), std::string::npos) << '"' << text << '"'; \
  } while (false)

}  // namespace crosslight::test

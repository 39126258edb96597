// Reads back what scenegen wrote, with nothing of the renderer's loader: nodes, bounds and cameras.
#pragma once

#include <filesystem>
#include <fstream>
#include <glm/ext/matrix_transform.hpp>
#include <glm/ext/quaternion_double.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace crosslight::scenegen {

struct PlacedMesh {
  std::string name;
  std::vector<glm::dvec3> corners;  // of its bounds, in world space
};

struct PlacedCamera {
  glm::dmat4 worldFromCamera;
  double yFov;
};

struct SceneFile {
  std::vector<PlacedMesh> meshes;
  std::vector<PlacedCamera> cameras;
};

inline std::string contentsOf(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline glm::dmat4 localTransform(const nlohmann::json& node) {
  glm::dmat4 m(1.0);
  if (node.contains("matrix")) {
    for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = node["matrix"][static_cast<std::size_t>(i)];
    return m;
  }
  const auto vectorOr = [&](const char* key, double fallback) {
    if (!node.contains(key)) return glm::dvec3(fallback);
    return glm::dvec3(node[key][0], node[key][1], node[key][2]);
  };
  m = glm::translate(m, vectorOr("translation", 0.0));
  if (node.contains("rotation")) {
    const auto& q = node["rotation"];
    m *= glm::mat4_cast(glm::dquat(q[3].get<double>(), q[0].get<double>(), q[1].get<double>(), q[2].get<double>()));
  }
  return glm::scale(m, vectorOr("scale", 1.0));
}

inline void placeNode(const nlohmann::json& root, std::size_t index, const glm::dmat4& parent, SceneFile& out) {
  const nlohmann::json& node = root["nodes"][index];
  const glm::dmat4 world = parent * localTransform(node);
  if (node.contains("camera")) {
    const auto& camera = root["cameras"][node["camera"].get<std::size_t>()];
    out.cameras.push_back({world, camera["perspective"]["yfov"]});
  }
  if (node.contains("mesh")) {
    for (const auto& primitive : root["meshes"][node["mesh"].get<std::size_t>()]["primitives"]) {
      const auto& box = root["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
      PlacedMesh mesh{node["name"], {}};
      for (int bits = 0; bits < 8; ++bits) {
        glm::dvec4 corner(0.0, 0.0, 0.0, 1.0);
        for (int i = 0; i < 3; ++i) corner[i] = box[bits >> i & 1 ? "max" : "min"][static_cast<std::size_t>(i)];
        mesh.corners.emplace_back(world * corner);
      }
      out.meshes.push_back(std::move(mesh));
    }
  }
  if (!node.contains("children")) return;
  for (const auto& child : node["children"]) placeNode(root, child.get<std::size_t>(), world, out);
}

// One entry per scene of the file.
inline std::vector<SceneFile> readScenes(const std::filesystem::path& path) {
  const nlohmann::json root = nlohmann::json::parse(contentsOf(path));
  std::vector<SceneFile> scenes;
  for (const auto& scene : root["scenes"]) {
    SceneFile file;
    for (const auto& node : scene["nodes"]) placeNode(root, node.get<std::size_t>(), glm::dmat4(1.0), file);
    scenes.push_back(std::move(file));
  }
  return scenes;
}

}  // namespace crosslight::scenegen

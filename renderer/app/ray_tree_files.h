// A pixel's ray tree beside its picture: OUT.tree.json for programs, OUT.tree.svg for people.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>

#include "app/record.h"
#include "scene/scene.h"
#include "trace/ray_tree.h"

namespace crosslight {

struct RayTreeFiles {
  std::filesystem::path json, svg;
};
RayTreeFiles rayTreeFilesOf(const std::filesystem::path& output);

// "X,Y" from the upper left pixel (0,0); UsageError outside of the picture.
glm::uvec2 rayTreePixelOf(const std::string& text, std::uint32_t width, std::uint32_t height);

Json rayTreeJson(const RayTree& tree, const Scene& scene);
// The tree as cards, and its rays in the plane in which they lie farthest apart.
std::string rayTreeSvg(const RayTree& tree, const Scene& scene);
void writeRayTree(const std::filesystem::path& output, const RayTree& tree, const Scene& scene);

// What both say of a node.
const char* nameOf(RayKind kind);
std::string objectNameOf(const Scene& scene, std::uint32_t instanceId);
std::string materialNameOf(const Scene& scene, std::uint32_t materialId);
std::string lightNameOf(const Scene& scene, std::size_t light);

}  // namespace crosslight

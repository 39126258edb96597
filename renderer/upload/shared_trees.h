// Trees that instances of a mesh share: whether that pays, and their building. Hits are those of one tree over all
// triangles, bit for bit (shaders/accel/instances.glsl): triangles are tested where the flattened scene has them.
#pragma once

#include <string>

#include "effects/effects.h"
#include "upload/flat_bvh.h"

namespace crosslight {

// Sharing pays from here on, by triangles that need no place in a tree: a triangle takes about a microsecond in a tree
// and on the way to the device, and a camera ray with its shadow about 0.1 more through shared trees than in packets.
// So ten samples of a picture of a million pixels.
inline constexpr std::uint64_t kFewestTrianglesSaved = 1u << 20;

struct Sharing {
  bool shares = false;
  std::string reason;                // in words, either way
  std::uint64_t trianglesSaved = 0;  // of those that the flattened scene has
  std::vector<bool> byMesh;          // per instance of the scene: it uses its mesh's tree, else one over all the rest
};

// Where shadows multiply what several transparent surfaces let pass, the order of the walk shows in the last bit, and
// with it which tree was walked.
bool showsItsTree(const Plan& plan);

// `origin` as for flattenScene(). Under InstanceMode::automatic trees are shared where that saves at least
// kFewestTrianglesSaved and half of all triangles. Never shared: where shadows multiply what several transparent
// surfaces let pass, in the order of the walk, which is the tree's; and instances whose transform has no inverse, or
// one so inexact that boxes would have to be widened by more than 1/256 of the mesh.
Sharing planSharing(const Scene& scene, const glm::dvec3& origin, const Plan& plan, const RenderSettings& settings);

struct SharedTreesReport {
  std::uint32_t instances = 0, trees = 0;
  std::uint64_t bytesSaved = 0;  // of a tree over all triangles with as many bytes per triangle as the shared ones
};

FlatBvh buildSharedTrees(const FlatScene& flat, const Scene& scene, const RenderSettings& settings,
                         const Sharing& sharing, SharedTreesReport& report, const TreeSources& sources = {});

}  // namespace crosslight

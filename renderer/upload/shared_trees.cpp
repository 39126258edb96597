#include "upload/shared_trees.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <map>
#include <optional>

#include "upload/instance_record.h"

namespace crosslight {
namespace {

std::uint64_t triangleCount(const Mesh& mesh) {
  std::uint64_t indices = 0;
  for (const Primitive& p : mesh.primitives) indices += p.indices.size();
  return indices / 3;
}

bool mayShare(const MeshInstance& instance, const Scene& scene) {
  const auto triangles = triangleCount(scene.meshes[static_cast<std::size_t>(instance.mesh)]);
  return triangles > 0 && triangles <= shared::kTriangleMask;
}

}  // namespace

bool showsItsTree(const Plan& plan) { return plan.has(Effect::transparency) && plan.has(Effect::shadows); }

Sharing planSharing(const Scene& scene, const glm::dvec3& origin, const Plan& plan, const RenderSettings& settings) {
  Sharing sharing;
  if (settings.instances == InstanceMode::flatten) return {false, "--instances flatten", 0, {}};
  if (settings.kernel == KernelFamily::rayQuery)
    return {false, "--kernel ray-query: the device searches all triangles by a structure of its own", 0, {}};
  if (!plan.has(Effect::triangles)) return {false, "no mesh is drawn", 0, {}};
  if (showsItsTree(plan)) return {false, "shadows pass through transparent surfaces", 0, {}};
  std::vector<std::vector<std::size_t>> instancesOf(scene.meshes.size());
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const MeshInstance& instance = scene.instances[i];
    if (instance.replacedByShape || !mayShare(instance, scene)) continue;
    instancesOf[static_cast<std::size_t>(instance.mesh)].push_back(i);
    all += triangleCount(scene.meshes[static_cast<std::size_t>(instance.mesh)]);
  }
  sharing.byMesh.assign(scene.instances.size(), false);
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    if (instancesOf[m].size() < 2) continue;
    const DBounds box = boundsOf(scene.meshes[m]);
    std::erase_if(instancesOf[m], [&](std::size_t i) {
      return !objectMap(scene.instances[i].worldFromObject, origin, box).has_value();
    });
    if (instancesOf[m].size() < 2) continue;
    for (const std::size_t i : instancesOf[m]) sharing.byMesh[i] = true;
    sharing.trianglesSaved += (instancesOf[m].size() - 1) * triangleCount(scene.meshes[m]);
  }
  const bool pays = sharing.trianglesSaved >= kFewestTrianglesSaved && 2 * sharing.trianglesSaved >= all;
  const bool forced = settings.instances == InstanceMode::share;
  sharing.shares = pays || (forced && all > 0);
  sharing.reason = fmt::format("{} of {} triangles would need no place in a tree{}", sharing.trianglesSaved, all,
                               forced && !pays ? "; --instances share" : "");
  return sharing;
}

namespace {

// A mesh's triangles as one list, as flattening has them: primitives without triangles are left out.
struct MeshTriangles {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> primitiveOf;  // per triangle
};

MeshTriangles trianglesOf(const Mesh& mesh) {
  MeshTriangles all;
  std::uint32_t primitive = 0;
  for (const Primitive& p : mesh.primitives) {
    if (p.indices.size() < 3) continue;
    const auto first = static_cast<std::uint32_t>(all.positions.size());
    all.positions.insert(all.positions.end(), p.positions.begin(), p.positions.end());
    for (const std::uint32_t i : p.indices) all.indices.push_back(first + i);
    all.primitiveOf.insert(all.primitiveOf.end(), p.indices.size() / 3, primitive++);
  }
  return all;
}

// All triangles of instances that share nothing, where the flattened scene has them.
MeshTriangles restOf(const FlatScene& flat, const std::vector<const FlatInstance*>& rest,
                     std::vector<std::uint32_t>& triangleOf) {
  MeshTriangles all;
  for (const FlatInstance* instance : rest) {
    std::uint32_t draw = instance->firstDraw;
    for (std::uint32_t i = 0; i < instance->triangleCount; ++i) {
      const std::uint32_t triangle = instance->firstTriangle + i;
      while (triangle >= flat.draws[draw].firstTriangle + flat.draws[draw].triangleCount) ++draw;
      for (std::uint32_t k = 0; k < 3; ++k) all.indices.push_back(flat.indices[3 * triangle + k]);
      all.primitiveOf.push_back(draw);
      triangleOf.push_back(triangle);
    }
  }
  return all;
}

class Builder {
 public:
  Builder(const FlatScene& flat, const Scene& scene, const RenderSettings& settings, const Sharing& sharing,
          const TreeSources& sources)
      : flat_(flat), scene_(scene), settings_(settings), sharing_(sharing), sources_(sources) {}

  FlatBvh run(SharedTreesReport& report) {
    std::vector<const FlatInstance*> rest;
    std::map<int, std::vector<const FlatInstance*>> byMesh;
    for (const FlatInstance& instance : flat_.instances) {
      const bool shares = sharing_.byMesh[instance.instance];
      (shares ? byMesh[scene_.instances[instance.instance].mesh] : rest).push_back(&instance);
    }
    for (const auto& [mesh, instances] : byMesh) addMesh(mesh, instances);
    if (!rest.empty()) addRest(rest);
    report.instances = static_cast<std::uint32_t>(records_.size());
    report.trees = trees_;
    const std::uint64_t nodeBytes = nodes_.size() * sizeof(shared::BvhNode);
    const std::uint64_t flatBytes = nodeBytes * flat_.triangleCount() / std::max<std::size_t>(1, triangles_.size()) +
                                    flat_.triangleCount() * sizeof(shared::BvhPrimitive);
    FlatBvh all = join();
    const std::uint64_t bytes = all.sizeBytes();
    report.bytesSaved = flatBytes > bytes ? flatBytes - bytes : 0;
    return all;
  }

 private:
  // Appends a tree; its root.
  std::uint32_t addTree(int key, const BvhTriangles& triangles, const std::vector<std::uint32_t>& primitiveOf,
                        const std::vector<std::uint32_t>* triangleOf, const auto& flagsOf) {
    const std::shared_ptr<const Bvh> source = sources_.over(key, triangles);
    const Bvh& tree = *source;
    const auto root = static_cast<std::uint32_t>(nodes_.size());
    appendNodes(tree.nodes, static_cast<std::uint32_t>(triangles_.size()), nodes_);
    for (const std::uint32_t t : tree.order) {
      shared::InstanceTriangle out{};
      out.i0 = triangles.indices[3 * t];
      out.i1 = triangles.indices[3 * t + 1];
      out.i2 = triangles.indices[3 * t + 2];
      out.triangle = flagsOf(primitiveOf[t]) << shared::kTriangleFlagShift | (triangleOf ? (*triangleOf)[t] : t);
      out.primitive = primitiveOf[t];
      triangles_.push_back(out);
    }
    ++trees_;
    return root;
  }

  void addMesh(int number, const std::vector<const FlatInstance*>& instances) {
    const Mesh& mesh = scene_.meshes[static_cast<std::size_t>(number)];
    const MeshTriangles own = trianglesOf(mesh);
    const auto flags = [&](std::uint32_t primitive) {
      return primitiveFlags(flat_, scene_, settings_, instances.front()->firstDraw + primitive) &
             ~shared::kPrimitiveFlipsWinding;  // that is the instance's
    };
    const std::uint32_t root = addTree(number, {own.positions, own.indices}, own.primitiveOf, nullptr, flags);
    const DBounds box = boundsOf(mesh);
    const glm::dvec3 origin = flat_.origin;
    for (const FlatInstance* instance : instances) {
      const MeshInstance& from = scene_.instances[instance->instance];
      shared::InstanceRecord record = *objectMap(from.worldFromObject, origin, box);
      record.root = root;
      record.firstVertex = instance->firstVertex;
      record.firstTriangle = instance->firstTriangle;
      record.firstDraw = instance->firstDraw;
      record.flags = primitiveFlags(flat_, scene_, settings_, instance->firstDraw) & shared::kPrimitiveFlipsWinding;
      Bounds bounds;
      for (std::uint32_t v = 0; v < instance->vertexCount; ++v) bounds.add(flat_.positions[instance->firstVertex + v]);
      add(record, bounds);
    }
  }

  void addRest(const std::vector<const FlatInstance*>& rest) {
    std::vector<std::uint32_t> triangleOf;
    const MeshTriangles all = restOf(flat_, rest, triangleOf);
    const auto flags = [&](std::uint32_t draw) { return primitiveFlags(flat_, scene_, settings_, draw); };
    Bounds bounds;
    for (const std::uint32_t i : all.indices) bounds.add(flat_.positions[i]);
    shared::InstanceRecord record = renderSpaceMap(bounds);
    record.root = addTree(kRenderSpaceTree, {flat_.positions, all.indices}, all.primitiveOf, &triangleOf, flags);
    add(record, bounds);
  }

  void add(const shared::InstanceRecord& record, const Bounds& bounds) {
    records_.push_back(record);
    boxes_.push_back(widened(bounds));
  }

  // The tree of instances first: walks begin at node 0.
  FlatBvh join() {
    FlatBvh all;
    const Bvh tree = buildBvh(boxes_, {.maxLeafSize = 1});
    appendNodes(tree.nodes, 0, all.nodes);
    const auto first = static_cast<std::uint32_t>(all.nodes.size());
    for (const std::uint32_t i : tree.order) {
      all.instances.push_back(records_[i]);
      all.instances.back().root += first;
    }
    appendNodes(nodes_, 0, all.nodes);
    all.instanceTriangles = std::move(triangles_);
    appendShapes(flat_, scene_, settings_, all);
    return all;
  }

  const FlatScene& flat_;
  const Scene& scene_;
  const RenderSettings& settings_;
  const Sharing& sharing_;
  const TreeSources& sources_;
  std::vector<shared::BvhNode> nodes_;
  std::vector<shared::InstanceTriangle> triangles_;
  std::vector<shared::InstanceRecord> records_;
  std::vector<Bounds> boxes_;
  std::uint32_t trees_ = 0;
};

}  // namespace

FlatBvh buildSharedTrees(const FlatScene& flat, const Scene& scene, const RenderSettings& settings,
                         const Sharing& sharing, SharedTreesReport& report, const TreeSources& sources) {
  return Builder(flat, scene, settings, sharing, sources).run(report);
}

}  // namespace crosslight

// The node hierarchy of one scene as world-space instances, shapes, lights and cameras.
#include <tiny_gltf.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "scene/gltf_build.h"

namespace crosslight::gltf {
namespace {

void checkFinite(const glm::dmat4& matrix, const JsonAt& at) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!(std::abs(matrix[column][row]) <= kLargestCoordinate)) {
        at.fail(fmt::format("its world transform has a number beyond {:g}", kLargestCoordinate));
      }
    }
  }
}

std::vector<std::size_t> depthFirstOrder(const tinygltf::Model& model, const std::vector<int>& parents) {
  std::vector<std::size_t> order;
  std::vector<std::size_t> stack;
  for (std::size_t i = parents.size(); i-- > 0;) {
    if (parents[i] < 0) stack.push_back(i);
  }
  while (!stack.empty()) {
    const std::size_t node = stack.back();
    stack.pop_back();
    order.push_back(node);
    const std::vector<int>& children = model.nodes[node].children;
    for (auto child = children.rbegin(); child != children.rend(); ++child)
      stack.push_back(static_cast<std::size_t>(*child));
  }
  return order;
}

class NodeBuilder {
 public:
  NodeBuilder(const Source& source, const std::vector<NodePose>& poses, Scene& scene)
      : source_(source), poses_(poses), hierarchy_(buildHierarchy(source, poses)), scene_(scene) {}

  void run(int sceneIndex) {
    const std::vector<bool> wanted = nodesOf(sceneIndex);
    for (const std::size_t node : hierarchy_.depthFirst) {
      if (wanted[node]) visit(node);
    }
    scene_.stats.nodes = static_cast<std::uint32_t>(std::count(wanted.begin(), wanted.end(), true));
  }

 private:
  std::vector<bool> nodesOf(int sceneIndex) const {
    std::vector<bool> wanted(hierarchy_.parents.size(), sceneIndex < 0);
    if (sceneIndex < 0) return wanted;
    for (const int root : source_.model.scenes[static_cast<std::size_t>(sceneIndex)].nodes) {
      wanted[static_cast<std::size_t>(root)] = true;
    }
    for (const std::size_t node : hierarchy_.depthFirst) {
      const int parent = hierarchy_.parents[node];
      if (parent >= 0 && wanted[static_cast<std::size_t>(parent)]) wanted[node] = true;
    }
    return wanted;
  }

  void visit(std::size_t index) {
    const tinygltf::Node& node = source_.model.nodes[index];
    const JsonAt at = source_.document.entry("nodes", index);
    const glm::dmat4& world = hierarchy_.worldFromNode[index];
    checkFinite(world, at);
    if (node.camera >= 0) {
      if (auto camera = readCamera(source_, static_cast<std::size_t>(node.camera), world, at)) {
        if (!node.name.empty()) camera->name = node.name;
        scene_.cameras.push_back(std::move(*camera));
      }
    }
    if (const auto punctual = at.extension("KHR_lights_punctual")) light(*punctual, node.name, world, at);
    if (const auto area = at.extension("EXT_lights_area"))
      addLight(readAreaLight(source_, *area, world, at), node.name);
    drawables(index, node, at, world);
  }

  void light(const JsonAt& punctual, const std::string& name, const glm::dmat4& world, const JsonAt& at) {
    const auto lights = source_.document.root().extension("KHR_lights_punctual");
    const std::size_t count = lights ? lights->at("lights").arraySize() : 0;
    addLight(readLight(source_, punctual.at("light").reference(count, "light"), world, at), name);
  }

  void addLight(std::optional<Light> light, const std::string& name) {
    if (!light) return;
    if (!name.empty()) light->name = name;
    scene_.lights.push_back(std::move(*light));
  }

  void drawables(std::size_t index, const tinygltf::Node& node, const JsonAt& at, const glm::dmat4& world) {
    std::optional<NodeShape> shape;
    if (const auto extension = at.extension("CROSSLIGHT_node_shape")) {
      shape = readNodeShape(*extension, source_.document.count("materials"));
    }
    int mesh = -1;
    glm::dmat4 worldFromObject = world;
    if (node.mesh >= 0) mesh = meshOf(index, node, at, worldFromObject);
    const bool draws = mesh >= 0 && !scene_.meshes[static_cast<std::size_t>(mesh)].primitives.empty();
    if (!draws && !shape) return;
    for (const glm::dmat4& objectFromInstance : instanceTransforms(at, node.name.size())) {
      const glm::dmat4 instance = worldFromObject * objectFromInstance;
      checkFinite(instance, at);
      const std::uint32_t id = scene_.instanceCount++;
      if (draws) scene_.instances.push_back({node.name, mesh, instance, id, shape.has_value()});
      if (shape) addShape(*shape, node.name, draws ? mesh : -1, world * objectFromInstance, id, at);
    }
  }

  void addShape(const NodeShape& shape, const std::string& name, int mesh, const glm::dmat4& world, std::uint32_t id,
                const JsonAt& at) {
    if (!(std::abs(glm::determinant(glm::dmat3(world))) > 0.0)) {
      at.fail("its world transform flattens an analytic shape, which has no inverse then");
    }
    int material = shape.material;
    if (material < 0 && mesh >= 0) material = scene_.meshes[static_cast<std::size_t>(mesh)].primitives[0].material;
    if (material < 0) material = static_cast<int>(source_.document.count("materials"));
    scene_.shapes.push_back({name, shape.kind, shape.params, material, world, id});
  }

  // Index into scene_.meshes; a mesh in the same pose is built once. Skins move `worldFromObject`.
  int meshOf(std::size_t index, const tinygltf::Node& node, const JsonAt& at, glm::dmat4& worldFromObject) {
    const auto mesh = static_cast<std::size_t>(node.mesh);
    Posing posing{poses_[index].weights, {}};
    if (node.skin >= 0 && skinApplies(mesh, at)) {
      posing.worldFromBind = jointMatrices(static_cast<std::size_t>(node.skin));
      if (posing.skinned()) {
        PosedMesh posed = buildMesh(source_, mesh, posing, scene_.materials);
        worldFromObject = glm::dmat4(1.0);
        worldFromObject[3] = glm::dvec4(posed.origin, 1.0);
        return add(std::move(posed.mesh));
      }
    }
    const auto [entry, isNew] = shared_.try_emplace({mesh, posing.weights}, -1);
    if (isNew) entry->second = add(buildMesh(source_, mesh, posing, scene_.materials).mesh);
    return entry->second;
  }

  int add(Mesh mesh) {
    scene_.meshes.push_back(std::move(mesh));
    return static_cast<int>(scene_.meshes.size()) - 1;
  }

  bool skinApplies(std::size_t mesh, const JsonAt& at) {
    const auto [entry, isNew] = hasJoints_.try_emplace(mesh, false);
    if (isNew) {
      const auto& primitives = source_.model.meshes[mesh].primitives;
      entry->second = std::all_of(primitives.begin(), primitives.end(),
                                  [](const auto& primitive) { return primitive.attributes.contains("JOINTS_0"); });
    }
    if (!entry->second) source_.document.notes.add(at, "its skin is left out: a primitive of its mesh has no joints");
    return entry->second;
  }

  std::vector<glm::dmat4> jointMatrices(std::size_t skinIndex) const {
    const tinygltf::Skin& skin = source_.model.skins[skinIndex];
    const JsonAt at = source_.document.entry("skins", skinIndex);
    std::vector<float> inverseBind;
    if (skin.inverseBindMatrices >= 0) {
      inverseBind = readFinite(source_, static_cast<std::size_t>(skin.inverseBindMatrices), 16);
    }
    source_.document.budget.charge(skin.joints.size() * sizeof(glm::dmat4), at);
    std::vector<glm::dmat4> matrices;
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
      glm::dmat4 jointFromBind(1.0);
      for (std::size_t i = 0; i < 16 && !inverseBind.empty(); ++i) {
        jointFromBind[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = inverseBind[j * 16 + i];
      }
      matrices.push_back(hierarchy_.worldFromNode[static_cast<std::size_t>(skin.joints[j])] * jointFromBind);
      checkFinite(matrices.back(), at);
    }
    return matrices;
  }

  // EXT_mesh_gpu_instancing: translation * rotation * scale each; one identity without it.
  std::vector<glm::dmat4> instanceTransforms(const JsonAt& at, std::size_t nameBytes) const {
    const auto instancing = at.extension("EXT_mesh_gpu_instancing");
    if (!instancing) return {glm::dmat4(1.0)};
    const JsonAt attributes = instancing->at("attributes");
    std::optional<std::size_t> count;
    const auto read = [&](const char* name, std::size_t components) {
      const auto reference = attributes.find(name);
      if (!reference) return std::vector<float>();
      const std::size_t accessor = reference->reference(source_.document.count("accessors"), "accessor");
      const std::string& type = source_.document.entry("accessors", accessor).at("type").string();
      if (componentCount(type) != components || type.starts_with("MAT")) reference->fail("its accessor is " + type);
      std::vector<float> values = readFinite(source_, accessor, components);
      if (count && *count != values.size() / components)
        reference->fail("has another length than the other attributes");
      count = values.size() / components;
      return values;
    };
    const auto translations = asVectors<glm::vec3>(read("TRANSLATION", 3));
    const auto rotations = asVectors<glm::vec4>(read("ROTATION", 4));
    const auto scales = asVectors<glm::vec3>(read("SCALE", 3));
    source_.document.budget.charge(count.value_or(1) * (sizeof(MeshInstance) + nameBytes) * 2, *instancing);
    std::vector<glm::dmat4> transforms;
    for (std::size_t i = 0; i < count.value_or(1); ++i) {
      NodePose pose;
      if (!translations.empty()) pose.translation = glm::dvec3(translations[i]);
      if (!scales.empty()) pose.scale = glm::dvec3(scales[i]);
      if (!rotations.empty()) {
        const glm::dvec4 q(rotations[i]);
        if (!(glm::length(q) > 0.0)) attributes.at("ROTATION").fail(fmt::format("quaternion {} has length 0", i));
        pose.rotation = glm::normalize(glm::dquat(q.w, q.x, q.y, q.z));
      }
      transforms.push_back(pose.parentFromNode());
    }
    return transforms;
  }

  const Source& source_;
  const std::vector<NodePose>& poses_;
  Hierarchy hierarchy_;
  Scene& scene_;
  std::map<std::pair<std::size_t, std::vector<double>>, int> shared_;
  std::map<std::size_t, bool> hasJoints_;  // by mesh: all primitives
};

}  // namespace

Hierarchy buildHierarchy(const Source& source, const std::vector<NodePose>& poses) {
  Hierarchy hierarchy;
  const auto& nodes = source.model.nodes;
  hierarchy.parents.assign(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const int child : nodes[i].children) hierarchy.parents[static_cast<std::size_t>(child)] = static_cast<int>(i);
  }
  hierarchy.depthFirst = depthFirstOrder(source.model, hierarchy.parents);
  hierarchy.worldFromNode.assign(nodes.size(), glm::dmat4(1.0));
  for (const std::size_t node : hierarchy.depthFirst) {
    const int parent = hierarchy.parents[node];
    const glm::dmat4 local = poses[node].parentFromNode();
    hierarchy.worldFromNode[node] =
        parent < 0 ? local : hierarchy.worldFromNode[static_cast<std::size_t>(parent)] * local;
  }
  return hierarchy;
}

void buildNodes(const Source& source, const std::vector<NodePose>& poses, int sceneIndex, Scene& scene) {
  NodeBuilder(source, poses, scene).run(sceneIndex);
}

}  // namespace crosslight::gltf

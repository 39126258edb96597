// The steps from a parsed model to the parts of a Scene. Internal to the scene room.
#pragma once

#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <memory>

#include "scene/gltf_model.h"
#include "scene/scene.h"

namespace crosslight::gltf {

// Beyond it squared distances leave the range of a float: 3 (2e18)^2 = 1.2e37 < 3.4e38, with room for scaling.
inline constexpr double kLargestCoordinate = 1e18;

// gltf_extensions.cpp: the CROSSLIGHT_* family. Each reader is the schema's twin in scenes/schema/.
void readClassicMaterial(const JsonAt& extension, Material& material);
void readDielectric(const JsonAt& extension, Material& material);
ClassicLight readClassicLight(const JsonAt& extension);
Atmosphere readAtmosphere(const Source& source, const JsonAt& extension, const Document& document);
struct NodeShape {
  ShapeKind kind = ShapeKind::sphere;
  glm::vec4 params{0.0f};
  int material = -1;  // -1: not said
};
NodeShape readNodeShape(const JsonAt& extension, std::size_t materialCount);

// gltf_material_layers.cpp: Khronos' extensions of metallic-roughness materials but for those that say how light
// passes. `texture` reads a texture info by its owner and key; none where the key is missing.
using TextureReader = std::function<TextureUse(const JsonAt& owner, const char* key)>;
void readDisplacement(const JsonAt& extension, const TextureReader& texture, Material& material);
void readMaterialLayers(const JsonAt& material, const TextureReader& texture, MaterialLayers& layers);

// gltf_smoke.cpp
Smoke readSmoke(const Source& source, const JsonAt& extension);

// gltf_specular_glossiness.cpp: the archived KHR_materials_pbrSpecularGlossiness as metallic-roughness, factors only.
void readSpecularGlossiness(const JsonAt& extension, Material& material);

// gltf_material.cpp: all materials, and those images that they use, decoded.
void buildMaterials(const Source& source, Scene& scene);

// gltf_light.cpp
std::optional<Light> readLight(const Source& source, std::size_t index, const glm::dmat4& worldFromNode,
                               const JsonAt& node);
std::optional<Camera> readCamera(const Source& source, std::size_t index, const glm::dmat4& worldFromNode,
                                 const JsonAt& node);
Light headlight(const Camera& camera);

// gltf_area_light.cpp: EXT_lights_area, and CROSSLIGHT_lights_area, which makes a sphere of a point light.
std::optional<Light> readAreaLight(const Source& source, const JsonAt& reference, const glm::dmat4& worldFromNode,
                                   const JsonAt& node);
void makeSphere(const JsonAt& extension, const glm::dmat4& worldFromNode, Light& light);

// gltf_animation.cpp: the state of every node at one time.
struct NodePose {
  bool isMatrix = false;
  glm::dmat4 matrix{1.0};
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 scale{1.0};
  std::vector<double> weights;  // of morph targets, as many as the mesh has

  glm::dmat4 parentFromNode() const;
};
std::vector<NodePose> restPose(const Source& source);
// `only`: index of an animation; -1: all.
void animate(const Source& source, int only, double timeSeconds, std::vector<NodePose>& poses);

// gltf_nodes.cpp
struct Hierarchy {
  std::vector<int> parents;             // -1: root
  std::vector<std::size_t> depthFirst;  // every node, parents before children, children in the file's order
  std::vector<glm::dmat4> worldFromNode;
};
Hierarchy buildHierarchy(const Source& source, const std::vector<NodePose>& poses);
// Fills instances, shapes, lights, cameras and meshes from the nodes of one scene; -1: all nodes.
void buildNodes(const Source& source, const std::vector<NodePose>& poses, int sceneIndex, Scene& scene);

// gltf_pose.cpp: vertex attributes of one primitive, flat arrays as in Primitive.
struct Posing {
  std::vector<double> weights;
  std::vector<glm::dmat4> worldFromBind;  // per joint; empty: not skinned
  bool skinned() const { return !worldFromBind.empty(); }
};
void applyMorphTargets(const Source& source, const tinygltf::Primitive& primitive, const std::vector<double>& weights,
                       Primitive& target);
// Moves the vertices to world space. Positions are returned, because a float of their own may not hold them.
// `mirrored` says per vertex whether its blended matrix mirrors.
std::vector<glm::dvec3> applySkin(const Source& source, const tinygltf::Primitive& primitive, const JsonAt& at,
                                  const Posing& posing, Primitive& target, std::vector<bool>& mirrored);

// gltf_mesh.cpp: one mesh in one pose. `origin` is where the mesh's object space lies in the world (skinned meshes).
struct PosedMesh {
  Mesh mesh;
  glm::dvec3 origin{0.0};
};
PosedMesh buildMesh(const Source& source, std::size_t index, const Posing& posing,
                    const std::vector<Material>& materials);
std::size_t targetCount(const Source& source, std::size_t mesh);

}  // namespace crosslight::gltf

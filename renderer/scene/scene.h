// The scene as a value: what a glTF file means, before anything is known of a device. A snapshot: animation, skins and
// morph targets are already applied. World transforms are double; vertex data is float as in the file.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lists.h"

namespace crosslight {

// Pixels as stored (not linearised), RGBA in [0,1], row 0 on top; 8- and 16-bit files alike.
struct TextureImage {
  std::string name;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<float> rgba;
};

enum class Wrap { repeat, mirroredRepeat, clampToEdge };
enum class Filter { linear, nearest };
enum class Mip { none, nearest, linear };  // which levels a minified texture reads

// A material's use of an image.
struct TextureUse {
  int image = -1;    // index into Scene::images; -1: none
  int texCoord = 0;  // 0 or 1
  Wrap wrapU = Wrap::repeat;
  Wrap wrapV = Wrap::repeat;
  Filter filter = Filter::linear;     // magnification
  Filter minFilter = Filter::linear;  // minification, within a level
  Mip mip = Mip::none;
  // KHR_texture_transform, as in its specification: uv' = translation * rotation * scale * uv.
  glm::vec2 offset{0.0f};
  float rotation = 0.0f;  // radians, counter-clockwise
  glm::vec2 scale{1.0f};

  bool present() const { return image >= 0; }
};

enum class AlphaMode { opaque, mask, blend };

// CROSSLIGHT_materials_classic: the lecture's material. No 1/pi anywhere.
struct ClassicMaterial {
  std::string preset;                // name in the classic table ("brass", ...), or empty
  glm::vec3 ambientFactor{0.2f};     // ka
  glm::vec3 diffuseFactor{0.8f};     // kd
  glm::vec3 specularFactor{0.0f};    // ks
  float shininess = 0.0f;            // n >= 0
  float transparency = 0.0f;         // kt: 1 is fully transparent, I = (1 - kt) Irefl + kt Itrans
  glm::vec3 reflectionFactor{0.0f};  // kr: weight of the mirror ray
  float roughness = 0.0f;            // orenNayar: sigma, radians; cookTorrance1982: m, root mean square slope
  bool angularSpecular = false;      // W(theta) instead of ks: ks at normal incidence, 1 at grazing angles
  bool hasIndex = false;             // cookTorrance1982: n + ik per channel; else from ks
  glm::vec3 refractiveIndex{1.5f};
  glm::vec3 extinction{0.0f};
};

// What glTF's extensions lay over or into a metallic-roughness surface; the defaults are those of a file without them.
// Texture channels as in MaterialRecord.
struct MaterialLayers {
  float diffuseRoughness = 0.0f;  // KHR_materials_diffuse_roughness
  TextureUse diffuseRoughnessTexture;

  bool hasSpecular = false;  // KHR_materials_specular
  float specularFactor = 1.0f;
  glm::vec3 specularColor{1.0f};
  TextureUse specularTexture;
  TextureUse specularColorTexture;  // sRGB

  float clearcoat = 0.0f;  // KHR_materials_clearcoat
  float clearcoatRoughness = 0.0f;
  float clearcoatNormalScale = 1.0f;
  TextureUse clearcoatTexture;
  TextureUse clearcoatRoughnessTexture;
  TextureUse clearcoatNormalTexture;

  glm::vec3 sheenColor{0.0f};  // KHR_materials_sheen
  float sheenRoughness = 0.0f;
  TextureUse sheenColorTexture;  // sRGB
  TextureUse sheenRoughnessTexture;

  float anisotropy = 0.0f;          // KHR_materials_anisotropy
  float anisotropyRotation = 0.0f;  // radians, counter-clockwise from the tangent
  TextureUse anisotropyTexture;

  float iridescence = 0.0f;  // KHR_materials_iridescence
  float filmIndex = 1.3f;
  float filmThinnest = 100.0f, filmThickest = 400.0f;  // nanometers
  TextureUse iridescenceTexture;
  TextureUse filmThicknessTexture;

  float diffuseTransmission = 0.0f;  // KHR_materials_diffuse_transmission
  glm::vec3 diffuseTransmissionColor{1.0f};
  TextureUse diffuseTransmissionTexture;
  TextureUse diffuseTransmissionColorTexture;  // sRGB
};

struct Material {
  std::string name;
  IlluminationModel model = IlluminationModel::cookTorrance;
  glm::vec4 baseColorFactor{1.0f};
  float metallicFactor = 1.0f;
  float perceptualRoughnessFactor = 1.0f;
  glm::vec3 emissiveFactor{0.0f};
  float emissiveStrength = 1.0f;
  AlphaMode alphaMode = AlphaMode::opaque;
  float alphaCutoff = 0.5f;
  bool doubleSided = false;
  TextureUse baseColorTexture;  // sRGB
  TextureUse metallicRoughnessTexture;
  TextureUse normalTexture;
  TextureUse occlusionTexture;
  TextureUse emissiveTexture;  // sRGB
  float normalScale = 1.0f;
  float occlusionStrength = 1.0f;
  float indexOfRefraction = 1.5f;   // KHR_materials_ior; 0 means infinite F0
  bool hasIor = false;              // the file states it
  float transmissionFactor = 0.0f;  // KHR_materials_transmission
  TextureUse transmissionTexture;
  float dispersion = 0.0f;  // KHR_materials_dispersion: 20 / Abbe number
  // CROSSLIGHT_materials_dielectric: where bodies overlap the highest priority counts, of equals the one entered last.
  std::optional<int> priority;
  bool hasVolume = false;  // KHR_materials_volume: the surface bounds a body; else it is thin
  glm::vec3 attenuationColor{1.0f};
  float attenuationDistance = std::numeric_limits<float>::infinity();
  glm::vec3 multiscatterColor{0.0f};  // KHR_materials_volume_scatter: what a thick body of it would reflect
  float scatterAnisotropy = 0.0f;     // g of Henyey and Greenstein 1941, -1..1
  TextureUse bumpTexture;             // EXT_materials_bump: height in the red channel
  float bumpFactor = 1.0f;            // scene units per texel value
  TextureUse displacementTexture;     // CROSSLIGHT_materials_displacement: height in the red channel
  float displacementScale = 1.0f, displacementBias = 0.0f;  // scene units
  ClassicMaterial classic;                                  // for all models but cookTorrance and unlit
  MaterialLayers layers;                                    // for cookTorrance
};

// Triangle list. Normals are never missing: where the file has none the vertices are split and the normals are the
// triangles' own (flatNormals). Other attributes are empty, or as long as positions.
struct Primitive {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec4> tangents;  // xyz, w = +1 or -1
  std::vector<glm::vec2> uv0;
  std::vector<glm::vec2> uv1;
  std::vector<glm::vec4> colors;       // linear RGBA
  std::vector<std::uint32_t> indices;  // 3 per triangle, each < positions.size()
  int material = 0;                    // index into Scene::materials (a default one is appended when needed)
  bool flatNormals = false;
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
};

// A node that draws a mesh. Skinned and morphed nodes have a posed mesh of their own. A node with
// EXT_mesh_gpu_instancing is one instance per element.
struct MeshInstance {
  std::string name;
  int mesh = 0;
  glm::dmat4 worldFromObject{1.0};
  std::uint32_t instanceId = 0;
  bool replacedByShape = false;  // the node also has an analytic shape: rays see that one, raster this mesh
};

// CROSSLIGHT_node_shape: an analytic shape, object space as in CL_SHAPE_KINDS. Params as in ShapeRecord.
struct ShapeInstance {
  std::string name;
  ShapeKind kind = ShapeKind::sphere;
  glm::vec4 params{1.0f, 0.0f, 0.0f, 0.0f};
  int material = 0;
  glm::dmat4 worldFromObject{1.0};
  std::uint32_t instanceId = 0;  // shared with the MeshInstance that it replaces
};

// CROSSLIGHT_lights_classic: OpenGL's fixed-function light.
struct ClassicLight {
  glm::vec3 ambient{0.0f};
  glm::vec3 diffuse{1.0f};
  glm::vec3 specular{1.0f};
  glm::vec3 attenuation{1.0f, 0.0f, 0.0f};  // kc, kl, kq; (0,0,0) means no attenuation
  float spotExponent = 0.0f;                // 0..128
  float spotCutoff = 180.0f;                // degrees: [0,90], or 180 for no cone
};

struct Light {
  std::string name;
  LightType type = LightType::point;
  glm::vec3 color{1.0f};        // linear
  float intensity = 1.0f;       // candela (point, spot), lux (directional) or nit, which is radiance (area)
  std::optional<float> range;   // scene units
  float innerConeAngle = 0.0f;  // radians, half angle
  float outerConeAngle = 0.7853982f;
  std::optional<ClassicLight> classic;  // replaces color, intensity, range and the cones
  glm::dvec3 worldPosition{0.0};
  glm::dvec3 worldDirection{0.0, 0.0, -1.0};  // unit, the way the light travels; area: the middle of it
  // Area lights. A position is the middle of a rectangle, disk or sphere and the first corner of a triangle.
  glm::dvec3 worldU{0.0}, worldV{0.0};  // half edges of a rectangle, edges of a triangle; U x V against the direction
  double radius = 0.0;                  // disk, sphere; scene units
  bool twoSided = false;
};

struct Camera {
  std::string name;
  bool orthographic = false;
  double yFov = 0.7853981633974483;   // radians, perspective
  std::optional<double> aspectRatio;  // width / height as the file has it; the output's resolution decides
  double xMag = 1.0, yMag = 1.0;      // half extents, orthographic
  double zNear = 0.1;
  std::optional<double> zFar;       // none: infinite (perspective only)
  glm::dmat4 worldFromCamera{1.0};  // rigid: looks along -Z, up +Y
  // Instead of a near plane, raster only: n and c, world space; what has n.p < c is not drawn. It is not before the
  // plane.
  std::optional<glm::dvec4> clipPlane;
};

enum class FogMode { none, linear, exp, exp2 };

// Radiance from all directions, linear RGB: rows from +Y down to -Y; the middle of a row looks along -Z, to the right
// of it lies +X, as a camera without a turn sees them.
struct EnvironmentMap {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<glm::vec3> radiance;
};

struct Environment {
  std::filesystem::path file;  // where the map comes from; empty: none
  double intensity = 1.0;      // multiplies it
  double rotation = 0.0;       // radians about +Y, counter-clockwise as seen from above
  std::shared_ptr<const EnvironmentMap> map;

  bool present() const { return map != nullptr; }
};

enum class SmokeShape { none, everywhere, box, sphere };

// A medium that absorbs and scatters light, along the world's axes.
struct Smoke {
  SmokeShape shape = SmokeShape::none;
  glm::dvec3 center{0.0};      // world
  glm::dvec3 size{1.0};        // edges of the box
  double radius = 1.0;         // of the sphere
  glm::vec3 absorption{0.0f};  // per scene unit, where the density is 1
  glm::vec3 scattering{0.0f};
  float anisotropy = 0.0f;  // g of Henyey and Greenstein 1941, in (-1, 1): positive scatters forwards
  std::array<std::uint32_t, 3> grid{0, 0, 0};
  std::vector<float> densities;  // x first, at the centers of the box's cells; none: 1 all over
};

inline bool hasSmoke(const Smoke& s) {
  return s.shape != SmokeShape::none && (s.absorption != glm::vec3(0.0f) || s.scattering != glm::vec3(0.0f));
}

// CROSSLIGHT_scene_atmosphere
struct Atmosphere {
  Environment environment;
  glm::vec3 ambient{0.0f};     // Ia
  glm::vec3 background{0.0f};  // linear
  FogMode fogMode = FogMode::none;
  glm::vec3 fogColor{0.5f};
  double fogStart = 0.0, fogEnd = 1.0;  // scene units, linear
  double fogDensity = 1.0;              // per scene unit, exp and exp2
  Smoke smoke;
};

// Fog without density hides nothing, at any distance.
inline bool hasFog(const Atmosphere& a) {
  return a.fogMode == FogMode::linear || (a.fogMode != FogMode::none && a.fogDensity > 0.0);
}

struct DBounds {
  glm::dvec3 lower{std::numeric_limits<double>::infinity()};
  glm::dvec3 upper{-std::numeric_limits<double>::infinity()};

  bool empty() const { return !(lower.x <= upper.x); }
  void add(const glm::dvec3& p) {
    for (int i = 0; i < 3; ++i) {
      if (p[i] < lower[i]) lower[i] = p[i];
      if (p[i] > upper[i]) upper[i] = p[i];
    }
  }
};

// What the file holds, for `info` and JSON records.
struct SceneStats {
  std::uint64_t fileBytes = 0;  // the file and everything it refers to
  std::uint64_t triangles = 0;  // instances counted each
  std::uint64_t vertices = 0;
  std::uint32_t nodes = 0;
  std::uint32_t animations = 0;
  std::uint64_t contentHash = 0;  // of the same bytes as fileBytes, when LoadOptions ask for it
  std::vector<std::string> extensionsUsed;
  std::vector<std::string> sceneNames;  // of all scenes in the file
};

struct Scene {
  std::filesystem::path source;
  std::string name;
  std::vector<TextureImage> images;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<MeshInstance> instances;
  std::vector<ShapeInstance> shapes;
  std::vector<Light> lights;
  std::vector<Camera> cameras;  // at least one after loading: the scene's bounds are framed when the file has none
  Atmosphere atmosphere;
  std::uint32_t instanceCount = 0;  // ids run from 0 to instanceCount - 1
  DBounds worldBounds;              // of everything bounded
  bool defaultLight = false;        // the file has no light: lights[0] is the headlight of the default camera
  bool defaultCamera = false;
  SceneStats stats;
};

}  // namespace crosslight

// Scenes made in memory: surfaces and shapes before a camera at the origin that looks along -Z, and access to pixels.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "image/image.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace crosslight::study {

struct Stage {
  Scene scene;

  Stage() {
    scene.source = "made in memory";
    Camera camera;
    camera.zNear = 0.01;
    scene.cameras.push_back(camera);
  }

  int add(const Material& material) {
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
  }

  void addMesh(const Primitive& primitive, const glm::dmat4& worldFromObject = glm::dmat4(1.0)) {
    scene.meshes.push_back({"mesh", {primitive}});
    MeshInstance instance;
    instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
    instance.worldFromObject = worldFromObject;
    instance.instanceId = scene.instanceCount++;
    scene.instances.push_back(instance);
  }

  // Square of side 8 in the plane z, facing the camera, or away from it.
  void addWall(double z, int material, bool facesCamera = true) {
    Primitive p;
    p.positions = {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}};
    p.normals.assign(4, {0, 0, facesCamera ? 1 : -1});
    p.indices =
        facesCamera ? std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3} : std::vector<std::uint32_t>{0, 2, 1, 0, 3, 2};
    p.material = material;
    glm::dmat4 at(1.0);
    at[3] = {0, 0, z, 1};
    addMesh(p, at);
  }

  void addShape(ShapeKind kind, const glm::vec4& params, const glm::dvec3& at, int material) {
    ShapeInstance shape;
    shape.kind = kind;
    shape.params = params;
    shape.material = material;
    shape.worldFromObject[3] = glm::dvec4(at, 1.0);
    shape.instanceId = scene.instanceCount++;
    scene.shapes.push_back(shape);
  }
};

inline Material emitter(float radiance) {
  Material m;
  m.model = IlluminationModel::lambert;
  m.classic.ambientFactor = m.classic.diffuseFactor = glm::vec3(0.0f);
  m.emissiveFactor = glm::vec3(radiance);
  return m;
}

inline Material lambert(float kd) {
  Material m;
  m.model = IlluminationModel::lambert;
  m.classic.ambientFactor = glm::vec3(0.0f);
  m.classic.diffuseFactor = glm::vec3(kd);
  return m;
}

inline Material glass(float ior) {
  Material m;
  m.metallicFactor = 0.0f;
  m.perceptualRoughnessFactor = 0.0f;
  m.transmissionFactor = 1.0f;
  m.indexOfRefraction = ior;
  m.hasIor = m.hasVolume = true;
  return m;
}

// Classic lights of intensity 1, without falloff.
inline Light lampAt(const glm::dvec3& position) {
  Light light;
  light.classic = ClassicLight{};
  light.worldPosition = position;
  return light;
}
inline Light sunAlong(const glm::dvec3& direction) {
  Light light;
  light.type = LightType::directional;
  light.classic = ClassicLight{};
  light.worldDirection = glm::normalize(direction);
  return light;
}

inline RenderSettings settingsFor(Method method, std::uint32_t width, std::uint32_t height) {
  RenderSettings s;
  s.method = method;
  s.width = width;
  s.height = height;
  return s;
}

inline std::array<float, 4> pixelAt(const Image& image, std::uint32_t x, std::uint32_t y) {
  const std::vector<float>& samples = image.picture().samples;
  const std::size_t at = 4 * (std::size_t{y} * image.width + x);
  return {samples[at], samples[at + 1], samples[at + 2], samples[at + 3]};
}

}  // namespace crosslight::study

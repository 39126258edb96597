// Scenes made in a test: surfaces that emit, walls and shapes before a camera at the origin. Without a light, values
// are sums of few products.
#pragma once

#include <glm/geometric.hpp>

#include "support/render_fixture.h"

namespace crosslight::testing {

// A scene that the camera at the origin sees along -Z.
struct Stage {
  Scene scene;

  Stage() {
    scene.source = "made in a test";
    Camera camera;
    camera.zNear = 0.01;
    scene.cameras.push_back(camera);
  }

  int add(const Material& material) {
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
  }

  // Square of side 8 in the plane z, facing the camera, or away from it.
  void addWall(double z, int material, bool facesCamera = true) {
    Primitive p;
    p.positions = {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}};
    p.normals.assign(4, {0, 0, facesCamera ? 1 : -1});
    p.indices =
        facesCamera ? std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3} : std::vector<std::uint32_t>{0, 2, 1, 0, 3, 2};
    p.material = material;
    scene.meshes.push_back({"wall", {p}});
    MeshInstance instance;
    instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
    instance.worldFromObject[3] = {0, 0, z, 1};
    instance.instanceId = scene.instanceCount++;
    scene.instances.push_back(instance);
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

  std::array<float, 4> center(Method method, std::uint32_t maxDepth) const {
    RenderSettings s = settingsFor(method, 9, 9);
    s.maxDepth = maxDepth;
    return pixelAt(render(device(), scene, s).image, 4, 4);
  }
};

inline Material emitter(float radiance) {
  Material m;
  m.model = IlluminationModel::lambert;
  m.classic.ambientFactor = m.classic.diffuseFactor = glm::vec3(0.0f);
  m.emissiveFactor = glm::vec3(radiance);
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

}  // namespace crosslight::testing

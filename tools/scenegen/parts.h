// The vocabulary that the scenes are written in: materials, lights, cameras and nodes as glTF JSON. Everything classic
// has core values beside it, so that other viewers show something alike.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "scene/scene.h"
#include "scenegen/gltf_builder.h"

namespace crosslight::scenegen {

struct ClassicSpec {
  std::string model = "blinnPhong";
  glm::dvec3 ka{0.1}, kd{0.5}, ks{0.0};
  double shininess = 1.0;
  double transparency = 0.0;
  glm::dvec3 kr{0.0};
  bool doubleSided = false;
};

Json classicMaterial(const std::string& name, const ClassicSpec& spec);
Json presetMaterial(const std::string& preset);  // a row of the classic material table; double-sided
Json pbrMaterial(const std::string& name, const glm::dvec3& baseColor, double metallic, double perceptualRoughness);
Json glassMaterial(const std::string& name, const glm::dvec3& tint, double indexOfRefraction);

// A matte paint with a highlight: ka = kd = color.
Json paint(const std::string& name, const glm::dvec3& color, double ks = 0.4, double shininess = 40.0);
Json matte(const std::string& name, const glm::dvec3& color);

struct ClassicLightSpec {
  glm::dvec3 color{1.0};  // diffuse and specular
  glm::dvec3 attenuation{1.0, 0.0, 0.0};
  std::optional<double> spotCutoff = {};  // degrees
  double spotExponent = 0.0;
};

// The lights are added to the current scene with their node. Core values give about the same light at `target`.
void addPointLight(GltfBuilder& gltf, const std::string& name, const glm::dvec3& position,
                   const ClassicLightSpec& spec);
void addSpotLight(GltfBuilder& gltf, const std::string& name, const glm::dvec3& position, const glm::dvec3& target,
                  const ClassicLightSpec& spec);
void addDirectionalLight(GltfBuilder& gltf, const std::string& name, const glm::dvec3& direction,
                         const ClassicLightSpec& spec);
Json khrLight(const std::string& name, const char* type, const glm::dvec3& color, double intensity);

// Columns right, up, back: looks from `eye` to `target` along -Z, as glTF's cameras and lights do.
glm::dmat4 lookAt(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up = {0.0, 1.0, 0.0});
Json matrixOf(const glm::dmat4& matrix);
Json listOf(const glm::dvec3& v);

struct CameraSpec {
  glm::dvec3 eye, target, up{0.0, 1.0, 0.0};
  double yFovDegrees = 40.0;
  double zNear = 0.1;
  std::optional<double> zFar = {};
};
int addCamera(GltfBuilder& gltf, const CameraSpec& spec, const std::string& name = "camera");

Json meshNode(const std::string& name, int mesh, const glm::dvec3& translation = glm::dvec3(0.0));

struct ShapeSpec {
  ShapeKind kind = ShapeKind::sphere;
  glm::dvec3 params{1.0, 0.0, 0.0};  // radius; radius, height; radius, tube radius; size
  int segments = 48;
};
// Node with an analytic shape and its tessellation.
Json shapeNode(GltfBuilder& gltf, const std::string& name, const ShapeSpec& spec, int material,
               const glm::dvec3& translation = glm::dvec3(0.0));
Json shapeExtension(const ShapeSpec& spec, int material);

// A checkered floor on y = 0: two materials on one mesh, so that each square has an edge of its own.
void addCheckerFloor(GltfBuilder& gltf, double halfSize, int steps, int lightMaterial, int darkMaterial);

void setAtmosphere(GltfBuilder& gltf, double ambient, const glm::dvec3& background);

}  // namespace crosslight::scenegen

// Lights and cameras with their place in the world. Scale moves them but does not stretch them.
#include <tiny_gltf.h>

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "scene/gltf_build.h"

namespace crosslight::gltf {
namespace {

constexpr double kHalfPi = 1.5707963267948966;

// Unit, or nothing when the transform has no such direction left.
std::optional<glm::dvec3> unit(const glm::dvec3& v) {
  const double length = glm::length(v);
  if (!(length > 0.0)) return std::nullopt;
  return v / length;
}

void readSpot(const JsonAt& at, Light& light) {
  const JsonAt spot = at.at("spot");
  light.outerConeAngle =
      static_cast<float>(numberOr(spot, "outerConeAngle", 0.7853981633974483, Range{0.0, kHalfPi, true}));
  light.innerConeAngle = static_cast<float>(numberOr(spot, "innerConeAngle", 0.0, Range::between(0.0, kHalfPi)));
  if (!(light.innerConeAngle < light.outerConeAngle)) {
    spot.fail(fmt::format("innerConeAngle {:g} must be smaller than outerConeAngle {:g}", light.innerConeAngle,
                          light.outerConeAngle));
  }
}

LightType typeOf(const std::string& name) {
  if (name == "directional") return LightType::directional;
  return name == "spot" ? LightType::spot : LightType::point;
}

}  // namespace

std::optional<Light> readLight(const Source& source, std::size_t index, const glm::dmat4& worldFromNode,
                               const JsonAt& node) {
  const auto punctual = source.document.root().extension("KHR_lights_punctual");
  const JsonAt at = punctual->at("lights").item(index);
  Light light;
  light.name = stringOr(at, "name", "");
  source.document.budget.charge(sizeof(Light) + light.name.size(), node);
  light.type = typeOf(at.at("type").oneOf({"directional", "point", "spot"}));
  light.color = vec3Or(at, "color", light.color, Range::between(0.0, 1.0));
  light.intensity = static_cast<float>(numberOr(at, "intensity", 1.0, Range::atLeast(0.0)));
  if (const auto range = at.find("range")) light.range = static_cast<float>(range->number(Range::above(0.0)));
  if (light.type == LightType::spot) readSpot(at, light);
  if (const auto classic = at.extension("CROSSLIGHT_lights_classic")) light.classic = readClassicLight(*classic);
  if (const auto area = at.extension("CROSSLIGHT_lights_area")) makeSphere(*area, worldFromNode, light);
  light.worldPosition = glm::dvec3(worldFromNode[3]);
  const auto direction = unit(-glm::dvec3(worldFromNode[2]));
  if (direction) {
    light.worldDirection = *direction;
  } else if (light.type != LightType::point && light.type != LightType::areaSphere) {
    node.warn("its scale leaves the light without a direction; the light is left out");
    return std::nullopt;
  }
  return light;
}

std::optional<Camera> readCamera(const Source& source, std::size_t index, const glm::dmat4& worldFromNode,
                                 const JsonAt& node) {
  const tinygltf::Camera& lens = source.model.cameras[index];
  Camera camera;
  camera.name = lens.name;
  source.document.budget.charge(sizeof(Camera) + camera.name.size(), node);
  camera.orthographic = lens.type == "orthographic";
  if (camera.orthographic) {
    camera.xMag = std::abs(lens.orthographic.xmag);
    camera.yMag = std::abs(lens.orthographic.ymag);
    camera.zNear = lens.orthographic.znear;
    camera.zFar = lens.orthographic.zfar;
  } else {
    camera.yFov = lens.perspective.yfov;
    camera.zNear = lens.perspective.znear;
    if (lens.perspective.zfar > 0.0) camera.zFar = lens.perspective.zfar;
    if (lens.perspective.aspectRatio > 0.0) camera.aspectRatio = lens.perspective.aspectRatio;
  }
  const auto back = unit(glm::dvec3(worldFromNode[2]));
  const auto right = back ? unit(glm::cross(glm::dvec3(worldFromNode[1]), *back)) : std::nullopt;
  if (!right) {
    node.warn("its transform leaves the camera without a direction; the camera is left out");
    return std::nullopt;
  }
  camera.worldFromCamera = glm::dmat4(glm::dvec4(*right, 0.0), glm::dvec4(glm::cross(*back, *right), 0.0),
                                      glm::dvec4(*back, 0.0), worldFromNode[3]);
  return camera;
}

Light headlight(const Camera& camera) {
  Light light;
  light.name = "headlight";
  light.type = LightType::directional;
  light.intensity = 3.14159265f;  // lux: a white Lambert surface that faces it has radiance 1
  light.worldPosition = glm::dvec3(camera.worldFromCamera[3]);
  light.worldDirection = -glm::dvec3(camera.worldFromCamera[2]);
  return light;
}

}  // namespace crosslight::gltf

// Lights with an area. EXT_lights_area (draft of 2025): type rect or disk, color, intensity in nit, size, rect.aspect;
// the node's largest scale stretches both sides; one side radiates, along -Z. CROSSLIGHT_lights_area on a punctual
// point light: a sphere of the same candela, seen from afar the same light.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/gltf_build.h"

namespace crosslight::gltf {
namespace {

constexpr double kDraftIntensity = 1000.0;  // nit, the draft's default
constexpr std::array<std::string_view, 8> kRead = {"name", "type", "color",      "intensity",
                                                   "size", "rect", "extensions", "extras"};

// A draft may grow: what is new in it is left out, and said.
void nameUnread(const JsonAt& light) {
  light.object();
  for (const auto& [key, ignored] : light.value().items()) {
    if (std::find(kRead.begin(), kRead.end(), key) == kRead.end())
      light.at(key).warn("is not read, EXT_lights_area is a draft");
  }
}

double largestScale(const glm::dmat4& worldFromNode) {
  return std::max({glm::length(glm::dvec3(worldFromNode[0])), glm::length(glm::dvec3(worldFromNode[1])),
                   glm::length(glm::dvec3(worldFromNode[2]))});
}

// Half edges along the node's X and Y, made perpendicular to its -Z.
void placeRectangle(const JsonAt& at, double height, const glm::dmat4& worldFromNode, Light& light) {
  double aspect = 1.0;
  if (const auto rect = at.find("rect")) {
    rect->onlyKnows({"aspect"});
    aspect = numberOr(*rect, "aspect", 1.0, Range::above(0.0));
  }
  const glm::dvec3 z = -light.worldDirection;
  const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(worldFromNode[1]), z));
  light.type = LightType::areaRectangle;
  light.worldU = 0.5 * height * aspect * x;
  light.worldV = 0.5 * height * glm::cross(z, x);
}

}  // namespace

std::optional<Light> readAreaLight(const Source& source, const JsonAt& reference, const glm::dmat4& worldFromNode,
                                   const JsonAt& node) {
  const auto lights = source.document.root().extension("EXT_lights_area");
  const std::size_t count = lights ? lights->at("lights").arraySize() : 0;
  const std::size_t index = reference.at("light").reference(count, "area light");
  const JsonAt at = lights->at("lights").item(index);
  nameUnread(at);
  Light light;
  light.name = stringOr(at, "name", "");
  source.document.budget.charge(sizeof(Light) + light.name.size(), node);
  const std::string type = at.at("type").oneOf({"rect", "disk"});
  light.color = vec3Or(at, "color", light.color, Range::between(0.0, 1.0));
  light.intensity = static_cast<float>(numberOr(at, "intensity", kDraftIntensity, Range::atLeast(0.0)));
  const double size = numberOr(at, "size", 1.0, Range::above(0.0)) * largestScale(worldFromNode);
  light.worldPosition = glm::dvec3(worldFromNode[3]);
  const glm::dvec3 y(worldFromNode[1]), z(worldFromNode[2]);
  if (!(glm::length(z) > 0.0) || !(glm::length(glm::cross(y, z)) > 0.0)) {
    node.warn("its scale leaves the light without a direction; the light is left out");
    return std::nullopt;
  }
  light.worldDirection = -glm::normalize(z);
  if (type == "rect") {
    placeRectangle(at, size, worldFromNode, light);
  } else {
    light.type = LightType::areaDisk;
    light.radius = 0.5 * size;
  }
  return light;
}

// Radiance L over a sphere: L pi r^2 candela in every direction.
void makeSphere(const JsonAt& extension, const glm::dmat4& worldFromNode, Light& light) {
  extension.onlyKnows({"radius"});
  const double radius = extension.at("radius").number(Range::above(0.0)) * largestScale(worldFromNode);
  if (light.type != LightType::point) extension.fail("makes a sphere of a light, which must be of type point");
  if (light.classic) {
    extension.warn("a sphere radiates as glTF's lights do; CROSSLIGHT_lights_classic is left out");
    light.classic.reset();
  }
  if (light.range) {
    extension.warn("a sphere has no range; it is left out");
    light.range.reset();
  }
  if (!(radius > 0.0)) extension.fail("its node's scale leaves the sphere no radius");
  light.type = LightType::areaSphere;
  light.radius = radius;
  light.intensity = static_cast<float>(light.intensity / (std::numbers::pi * radius * radius));
}

}  // namespace crosslight::gltf

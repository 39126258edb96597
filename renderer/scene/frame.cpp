// Which camera looks, and where from when the file has none.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "base/error.h"
#include "scene/load.h"

namespace crosslight {
namespace {

std::optional<std::size_t> wholeNumber(const std::string& text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

int findCamera(const Scene& scene, const std::string& nameOrIndex) {
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    if (scene.cameras[i].name == nameOrIndex) return static_cast<int>(i);
  }
  if (const auto index = wholeNumber(nameOrIndex); index && *index < scene.cameras.size())
    return static_cast<int>(*index);
  std::string known;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    known += fmt::format("{}{} '{}'", i == 0 ? "" : ", ", i, scene.cameras[i].name);
  }
  throw UsageError(fmt::format("there is no camera '{}'; {} has {}", nameOrIndex, scene.source.string(), known));
}

Camera frameBounds(const DBounds& bounds) {
  constexpr double kElevation = 0.35;  // radians above the horizon, about 20 degrees
  constexpr double kMargin = 1.05;     // the bounding sphere fills 1 / 1.05 of the picture's height
  const glm::dvec3 center = bounds.empty() ? glm::dvec3(0.0) : (bounds.lower + bounds.upper) * 0.5;
  double radius = bounds.empty() ? 1.0 : glm::length(bounds.upper - bounds.lower) * 0.5;
  if (!(radius > 0.0)) radius = 1.0;  // a single point has no size to frame
  Camera camera;
  camera.name = "default";
  const double distance = kMargin * radius / std::sin(camera.yFov * 0.5);
  const glm::dvec3 back(0.0, std::sin(kElevation), std::cos(kElevation));
  const glm::dvec3 right(1.0, 0.0, 0.0);
  camera.worldFromCamera = glm::dmat4(glm::dvec4(right, 0.0), glm::dvec4(glm::cross(back, right), 0.0),
                                      glm::dvec4(back, 0.0), glm::dvec4(center + back * distance, 1.0));
  // Half way to the nearest point of the sphere; without a far plane nothing behind it is cut.
  camera.zNear = (distance - radius) * 0.5;
  return camera;
}

void orbit(Scene& scene, int camera, double degrees) {
  if (degrees == 0.0) return;
  const glm::dvec3 center =
      scene.worldBounds.empty() ? glm::dvec3(0.0) : (scene.worldBounds.lower + scene.worldBounds.upper) * 0.5;
  const double c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
  const auto turned = [c, s](const glm::dvec3& v) { return glm::dvec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x); };
  glm::dmat4& worldFromCamera = scene.cameras.at(static_cast<std::size_t>(camera)).worldFromCamera;
  for (int axis = 0; axis < 3; ++axis) {
    worldFromCamera[axis] = glm::dvec4(turned(glm::dvec3(worldFromCamera[axis])), 0.0);
  }
  worldFromCamera[3] = glm::dvec4(center + turned(glm::dvec3(worldFromCamera[3]) - center), 1.0);
  if (!scene.defaultLight || camera != 0) return;
  Light& light = scene.lights.front();
  light.worldDirection = turned(light.worldDirection);
  light.worldPosition = center + turned(light.worldPosition - center);
}

}  // namespace crosslight

// A wall under one light with an area, and the same integrals by brute force in double precision.
#pragma once

#include <functional>
#include <numbers>

#include "scene/shape_mesh.h"
#include "support/stage.h"

namespace crosslight::testing {

constexpr double kTestPi = std::numbers::pi;

inline Light areaLight(LightType type, const glm::dvec3& position, const glm::dvec3& direction) {
  Light light;
  light.name = "lamp";
  light.type = type;
  light.worldPosition = position;
  light.worldDirection = glm::normalize(direction);
  return light;
}

// Edges a and b along u and across, or a disk or sphere of radius a.
inline Light rectangleLight(const glm::dvec3& middle, const glm::dvec3& direction, double a, double b) {
  Light light = areaLight(LightType::areaRectangle, middle, direction);
  const glm::dvec3 z = -light.worldDirection;
  const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0.3, 1.0, 0.2), z));
  light.worldU = 0.5 * a * x;
  light.worldV = 0.5 * b * glm::cross(z, x);
  return light;
}
inline Light triangleLight(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
  Light light = areaLight(LightType::areaTriangle, corner, -glm::cross(u, v));
  light.worldU = u;
  light.worldV = v;
  return light;
}
inline Light roundLight(LightType type, const glm::dvec3& middle, const glm::dvec3& direction, double radius) {
  Light light = areaLight(type, middle, direction);
  light.radius = radius;
  return light;
}

// Integral of f(wi) over the solid angle of what the point sees of the light, by the midpoint rule on n x n places.
inline double overLight(const Light& light, const glm::dvec3& p, int n,
                        const std::function<double(const glm::dvec3& wi, const glm::dvec3& place)>& f) {
  const glm::dvec3 to = light.worldPosition - p;
  const double d = glm::length(to);
  const glm::dvec3 axis = light.type == LightType::areaSphere ? -to / d : light.worldDirection;
  if (light.type == LightType::areaSphere && d <= light.radius) return 0.0;
  const glm::dvec3 x =
      glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  const glm::dvec3 y = glm::cross(axis, x);
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double a = (i + 0.5) / n, b = (j + 0.5) / n;
      glm::dvec3 wi, q;
      double solidAngle;
      if (light.type == LightType::areaSphere) {  // its cone, by 1 - cos and angle
        const double sine2 = light.radius * light.radius / (d * d);
        const double cone = sine2 / (1.0 + std::sqrt(1.0 - sine2));
        const double c = 1.0 - a * cone, s = std::sqrt(a * cone * (2.0 - a * cone)), psi = 2 * kTestPi * b;
        wi = -c * axis + s * (std::cos(psi) * x + std::sin(psi) * y);
        const double along = glm::dot(to, wi);
        const glm::dvec3 beside = to - along * wi;
        q = p + wi * (along - std::sqrt(std::max(0.0, light.radius * light.radius - glm::dot(beside, beside))));
        solidAngle = 2 * kTestPi * cone / n / n;
      } else {
        double area;
        if (light.type == LightType::areaDisk) {
          const double r = light.radius * std::sqrt(a), psi = 2 * kTestPi * b;
          q = light.worldPosition + r * (std::cos(psi) * x + std::sin(psi) * y);
          area = kTestPi * light.radius * light.radius;
        } else if (light.type == LightType::areaRectangle) {
          q = light.worldPosition + (2 * a - 1) * light.worldU + (2 * b - 1) * light.worldV;
          area = 4 * glm::length(glm::cross(light.worldU, light.worldV));
        } else {
          q = light.worldPosition + a * light.worldU + b * (1 - a) * light.worldV;
          area = glm::length(glm::cross(light.worldU, light.worldV)) * (1 - a);
        }
        const double distance = glm::length(q - p);
        wi = (q - p) / distance;
        const double facing = -glm::dot(axis, wi);
        solidAngle = (light.twoSided ? std::abs(facing) : std::max(facing, 0.0)) * area / (distance * distance) / n / n;
      }
      sum += solidAngle * f(wi, q);
    }
  }
  return sum;
}

// The wall z = -3 faces the camera.
struct LitWall : Stage {
  explicit LitWall(const Light& light, const Material& material = lambert(1.0f)) {
    addWall(-3.0, add(material));
    scene.lights = {light};
  }

  Image draw(Method method, std::uint32_t width, std::uint32_t height,
             const std::function<void(RenderSettings&)>& change = {}) const {
    RenderSettings s = settingsFor(method, width, height);
    s.aovs = {"position"};
    if (change) change(s);
    return render(device(), scene, s).image;
  }

  static glm::dvec3 placeOf(const Image& image, std::uint32_t x, std::uint32_t y) {
    const float* at = image.find("position")->samples.data() + 3 * (std::size_t{y} * image.width + x);
    return {at[0], at[1], at[2]};
  }
};

}  // namespace crosslight::testing

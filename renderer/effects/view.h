// What a camera may see: boxes against the frustum, in double. Never wrong about what it calls out of view.
#pragma once

#include <array>

#include "scene/scene.h"
#include "scene/settings.h"

namespace crosslight {

class View {
 public:
  View() = default;  // of everything
  View(const Camera& camera, const RenderSettings& settings);

  // `box` in the object's own space. An empty box is out of view.
  bool mayShow(const DBounds& box, const glm::dmat4& worldFromObject) const;

 private:
  struct Plane {  // camera space: what has dot(normal, p) > offset for all corners is out of view
    glm::dvec3 normal;
    double offset;
  };

  glm::dmat4 cameraFromWorld_{1.0};
  std::array<Plane, 5> planes_ = {};
  int planeCount_ = 0;
};

// The eight corners, in the world.
std::array<glm::dvec3, 8> cornersOf(const DBounds& box, const glm::dmat4& worldFromObject);

}  // namespace crosslight

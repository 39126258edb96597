// The study room's stage, drawn on the tests' device: without a light, values are sums of few products.
#pragma once

#include <glm/geometric.hpp>

#include "support/render_fixture.h"

namespace crosslight::testing {

using study::emitter;
using study::glass;
using study::lambert;

// A scene that the camera at the origin sees along -Z.
struct Stage : study::Stage {
  std::array<float, 4> center(Method method, std::uint32_t maxDepth) const {
    RenderSettings s = settingsFor(method, 9, 9);
    s.maxDepth = maxDepth;
    return pixelAt(render(device(), scene, s).image, 4, 4);
  }
};

}  // namespace crosslight::testing

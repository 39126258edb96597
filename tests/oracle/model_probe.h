// The study room's questions to the illumination models, asked on the tests' device.
#pragma once

#include "study/model_probe.h"
#include "support/render_fixture.h"

namespace crosslight::testing {

using Probe = study::ModelQuestion;
using study::carrierOf;
using study::directionAt;

inline Probe probeOf(const glm::vec3& wo, const glm::vec3& wi) { return study::questionOf(wo, wi); }

inline std::vector<glm::dvec3> probeModel(const Material& material, const std::vector<Probe>& probes,
                                          const RenderSettings& settings = settingsFor(Method::phong, 8, 8),
                                          std::vector<TextureImage> images = {}) {
  return study::askModel(device(), material, probes, settings, std::move(images));
}

}  // namespace crosslight::testing

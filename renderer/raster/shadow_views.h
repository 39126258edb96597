// Which views the lights' shadow maps are: plain data, all of it computed in double. No device.
#pragma once

#include <vector>

#include "raster_bindings.h"
#include "scene/settings.h"
#include "upload/flatten.h"

namespace crosslight {

struct ShadowViews {
  std::vector<shared::ShadowView> views;
  std::vector<shared::ShadowLight> lights;  // one per light
  std::uint64_t words = 0;                  // of all texels
};

// `layers`: 2 where something transparent casts a pale shadow. Texels begin at `firstTexel` of each view.
ShadowViews makeShadowViews(const Scene& scene, const FlatScene& flat, const RenderSettings& settings,
                            std::uint32_t layers);

// Half the parameter space that a spot's single map may take: beyond this angle a cube is used.
inline constexpr double kWidestSpot = 1.0471975511965976;  // 60 degrees

}  // namespace crosslight

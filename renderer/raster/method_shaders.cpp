#include "raster/method_shaders.h"

#include "base/check.h"

namespace crosslight {

MethodShaders shadersOf(const RenderSettings& settings) {
  switch (settings.method) {
    case Method::wireframe:
      return {"phong.vert", "wireframe.frag", "phong_aov.frag"};
    case Method::flat:
      if (settings.flatVertex == FlatVertex::centroid) return {"phong.vert", "centroid.frag", "centroid_aov.frag"};
      return {"flat.vert", "flat.frag", "flat_aov.frag"};
    case Method::gouraud:
      return {"gouraud.vert", "gouraud.frag", "gouraud_aov.frag"};
    case Method::phong:
      return {"phong.vert", "phong.frag", "phong_aov.frag"};
    case Method::whitted:
      break;
  }
  CL_CHECK(settings.method != Method::whitted);
  return {};
}

}  // namespace crosslight

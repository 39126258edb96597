#include "raster/method_shaders.h"

#include "base/check.h"
#include "raster_bindings.h"

namespace crosslight {

MethodShaders shadersOf(const RenderSettings& settings, bool codes) {
  switch (settings.method) {
    case Method::wireframe:
      return {"phong.vert", "wireframe.frag", "phong_aov.frag", {}};
    case Method::flat:
      if (settings.flatVertex == FlatVertex::centroid)
        return {"phong.vert", codes ? "centroid_codes.frag" : "centroid.frag", "centroid_aov.frag",
                "centroid_layers.frag"};
      if (codes) return {"flat_codes.vert", "flat_codes.frag", {}, {}};
      return {"flat.vert", "flat.frag", "flat_aov.frag", "flat_layers.frag"};
    case Method::gouraud:
      return {"gouraud.vert", codes ? "gouraud_codes.frag" : "gouraud.frag", "gouraud_aov.frag", "gouraud_layers.frag"};
    case Method::phong:
      return {"phong.vert", codes ? "phong_codes.frag" : "phong.frag", "phong_aov.frag", "phong_layers.frag"};
    case Method::whitted:
      break;
  }
  CL_CHECK(settings.method != Method::whitted);
  return {};
}

std::string_view backgroundShader(bool codes) { return codes ? "background_codes.frag" : "background.frag"; }

std::uint32_t depthVaryingsOf(const Plan& plan) {
  const bool textured = plan.has(Effect::baseColorTexture) && plan.has(Effect::alphaMask);
  const bool colored = plan.has(Effect::vertexColors) && plan.has(Effect::alphaMask);
  return (textured ? shared::kVaryingUvs : 0u) | (colored ? shared::kVaryingColor : 0u);
}

std::uint32_t varyingsOf(const RenderSettings& settings, const Plan& plan) {
  std::uint32_t bits = 0;
  for (const Effect e : {Effect::baseColorTexture, Effect::metallicRoughnessTexture, Effect::normalMap,
                         Effect::occlusionTexture, Effect::emissiveTexture, Effect::clearcoat, Effect::sheen,
                         Effect::anisotropy, Effect::iridescence, Effect::diffuseTransmission, Effect::specularLayer,
                         Effect::transmissionTexture, Effect::diffuseRoughness, Effect::bumpMap}) {
    if (plan.has(e)) bits |= shared::kVaryingUvs;
  }
  if (plan.has(Effect::vertexColors)) bits |= shared::kVaryingColor;
  if (plan.has(Effect::fog) || plan.has(Effect::smoke)) bits |= shared::kVaryingPosition;
  // A pixel's size on the surface hangs on its distance.
  if (plan.has(Effect::mipmaps)) bits |= shared::kVaryingPosition;
  // By methods that light vertices, fragments look at the surface once more for what it mirrors, and where layers dim
  // what is textured below them by the angle to the viewer. A centroid's fragments are lit, if elsewhere.
  const bool reflects = settings.rasterReflections != RasterReflections::off && plan.has(Effect::reflection);
  const bool dims = plan.has(Effect::clearcoat) || plan.has(Effect::sheen);
  const bool centroid = settings.method == Method::flat && settings.flatVertex == FlatVertex::centroid;
  if (settings.method != Method::phong && !centroid && !reflects && !dims) return bits;
  bits |= shared::kVaryingPosition | shared::kVaryingNormal;
  for (const Effect e : {Effect::normalMap, Effect::clearcoat, Effect::anisotropy}) {
    if (plan.has(e)) bits |= shared::kVaryingTangent;
  }
  return bits;
}

}  // namespace crosslight

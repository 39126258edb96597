#include "effects/details.h"

#include <fmt/format.h>

#include "effects/material_traits.h"

namespace crosslight {
namespace {

std::string colorOf(const glm::vec3& c) {
  return c.x == c.y && c.y == c.z ? fmt::format("{:g}", c.x) : fmt::format("{:g} {:g} {:g}", c.x, c.y, c.z);
}

std::string mirrorOf(const Material& m) {
  if (refracts(m)) return fmt::format("ior {:g}", m.indexOfRefraction);
  if (isClassic(m)) return "reflectionFactor " + colorOf(m.classic.reflectionFactor);
  if (coatMirrors(m))
    return fmt::format("clearcoat {:g} of roughness {:g}", m.layers.clearcoat, m.layers.clearcoatRoughness);
  return fmt::format("roughness {:g}", m.perceptualRoughnessFactor);
}

std::string throughOf(const Material& m) {
  if (transmissionOf(m) > 0.0f) return fmt::format("transmission {:g}", transmissionOf(m));
  return fmt::format("blended, alpha {:g}", m.baseColorFactor.a);
}

}  // namespace

std::string detailsOf(Effect effect, const Material& m) {
  switch (effect) {
    case Effect::alphaMask:
      return fmt::format("cutoff {:g}", m.alphaCutoff);
    case Effect::transparency:
      return throughOf(m);
    case Effect::reflection:
      return mirrorOf(m);
    case Effect::refraction:
      return fmt::format("transmission {:g}, ior {:g}", transmissionOf(m), m.indexOfRefraction);
    case Effect::absorption:
      return "color " + colorOf(m.attenuationColor) + fmt::format(" at distance {:g}", m.attenuationDistance);
    case Effect::dispersion:
      return fmt::format("dispersion {:g}", m.dispersion);
    case Effect::clearcoat:
      return fmt::format("clearcoat {:g}", m.layers.clearcoat);
    case Effect::sheen:
      return "color " + colorOf(m.layers.sheenColor);
    case Effect::anisotropy:
      return fmt::format("strength {:g}", m.layers.anisotropy);
    case Effect::iridescence:
      return fmt::format("iridescence {:g}", m.layers.iridescence);
    case Effect::diffuseTransmission:
      return fmt::format("factor {:g}", m.layers.diffuseTransmission);
    case Effect::diffuseRoughness:
      return fmt::format("roughness {:g}", m.layers.diffuseRoughness);
    default:
      return "";
  }
}

}  // namespace crosslight

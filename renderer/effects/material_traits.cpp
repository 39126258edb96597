#include "effects/material_traits.h"

#include <cmath>

namespace crosslight {

namespace {

// pbrt-v4's EffectivelySmooth: below this GGX alpha the lobe is treated as a mirror.
constexpr float kSmoothAlpha = 1e-3f;

bool anyPositive(const glm::vec3& v) { return v.x > 0 || v.y > 0 || v.z > 0; }

}  // namespace

bool isClassic(const Material& m) {
  return m.model != IlluminationModel::cookTorrance && m.model != IlluminationModel::unlit;
}

bool isMirror(const Material& m) {
  if (isClassic(m)) return anyPositive(m.classic.reflectionFactor) || refracts(m);
  const float alpha = m.perceptualRoughnessFactor * m.perceptualRoughnessFactor;
  return m.model == IlluminationModel::cookTorrance && (alpha < kSmoothAlpha || refracts(m));
}

float transmissionOf(const Material& m) {
  if (m.model == IlluminationModel::unlit) return 0.0f;
  return isClassic(m) ? m.classic.transparency : m.transmissionFactor;
}

bool refracts(const Material& m) {
  if (!(transmissionOf(m) > 0.0f)) return false;
  return isClassic(m) ? m.hasIor && m.indexOfRefraction != 1.0f : true;
}

bool isTransparent(const Material& m) { return m.alphaMode == AlphaMode::blend || transmissionOf(m) > 0.0f; }

bool absorbs(const Material& m) {
  return refracts(m) && m.hasVolume && std::isfinite(m.attenuationDistance) &&
         (m.attenuationColor.x < 1 || m.attenuationColor.y < 1 || m.attenuationColor.z < 1);
}

}  // namespace crosslight

#include "effects/material_traits.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "effects/effects.h"
#include "scene/material_textures.h"

namespace crosslight {

namespace {

// pbrt-v4's EffectivelySmooth: below this GGX alpha the lobe is treated as a mirror.
constexpr float kSmoothAlpha = 1e-3f;

bool anyPositive(const glm::vec3& v) { return v.x > 0 || v.y > 0 || v.z > 0; }

bool hasMipmaps(const Material& m) {
  const auto uses = texturesOf(m);
  return std::any_of(uses.begin(), uses.end(),
                     [](const TextureUse* use) { return use->present() && use->mip != Mip::none; });
}

// The layers of glTF's extensions count.
bool isLayered(const Material& m) { return m.model == IlluminationModel::cookTorrance; }

constexpr std::array kSurfaceRules{
    MaterialRule{Effect::baseColorTexture, "baseColorTexture", "has a base color texture",
                 [](const Material& m) { return m.baseColorTexture.present(); }},
    MaterialRule{Effect::metallicRoughnessTexture, "metallicRoughnessTexture", "has a metallic-roughness texture",
                 [](const Material& m) { return m.metallicRoughnessTexture.present(); }},
    MaterialRule{Effect::normalMap, "normalMap", "has a normal map",
                 [](const Material& m) { return m.normalTexture.present(); }},
    MaterialRule{Effect::occlusionTexture, "occlusionTexture", "has an occlusion texture",
                 [](const Material& m) { return m.occlusionTexture.present(); }},
    MaterialRule{Effect::emissiveTexture, "emissiveTexture", "has an emissive texture",
                 [](const Material& m) { return m.emissiveTexture.present(); }},
    MaterialRule{Effect::alphaMask, "alphaMask", "is cut by an alpha mask",
                 [](const Material& m) { return m.alphaMode == AlphaMode::mask; }},
    MaterialRule{Effect::transparency, "transparency", "lets something show through", isTransparent},
    MaterialRule{Effect::bumpMap, "bumpMap", "has a bump map",
                 [](const Material& m) { return m.bumpTexture.present(); }},
    MaterialRule{Effect::mipmaps, "mipmaps", "has a texture with levels", hasMipmaps},
    MaterialRule{Effect::clearcoat, "clearcoat", "has a clear coat",
                 [](const Material& m) { return isLayered(m) && m.layers.clearcoat > 0; }},
    MaterialRule{Effect::sheen, "sheen", "has a sheen",
                 [](const Material& m) { return isLayered(m) && anyPositive(m.layers.sheenColor); }},
    MaterialRule{Effect::anisotropy, "anisotropy", "reflects unlike along and across its tangents",
                 [](const Material& m) { return isLayered(m) && m.layers.anisotropy > 0; }},
    MaterialRule{Effect::iridescence, "iridescence", "has an iridescent film",
                 [](const Material& m) { return isLayered(m) && m.layers.iridescence > 0; }},
    MaterialRule{Effect::diffuseTransmission, "diffuseTransmission", "scatters light to its other side",
                 [](const Material& m) { return isLayered(m) && m.layers.diffuseTransmission > 0; }},
    MaterialRule{Effect::specularLayer, "specularLayer", "states the strength or color of its reflection",
                 [](const Material& m) { return isLayered(m) && m.layers.hasSpecular; }},
    MaterialRule{Effect::transmissionTexture, "transmissionTexture", "has a transmission texture",
                 [](const Material& m) { return isLayered(m) && m.transmissionTexture.present(); }},
    MaterialRule{Effect::diffuseRoughness, "diffuseRoughness", "is rough where it reflects diffusely",
                 [](const Material& m) { return isLayered(m) && m.layers.diffuseRoughness > 0; }},
    MaterialRule{Effect::angularSpecular, "angularSpecular", "has a highlight that grows with the angle",
                 hasAngularSpecular}};
constexpr std::array kRayRules{MaterialRule{Effect::volumeScatter, "volumeScatter", "scatters light within", scatters},
                               MaterialRule{Effect::reflection, "reflection", "reflects like a mirror", isMirror},
                               MaterialRule{Effect::refraction, "refraction", "refracts", refracts},
                               MaterialRule{Effect::absorption, "absorption", "absorbs light on its way", absorbs}};

}  // namespace

bool isClassic(const Material& m) {
  return m.model != IlluminationModel::cookTorrance && m.model != IlluminationModel::unlit;
}

bool isMirror(const Material& m) {
  if (isClassic(m)) return anyPositive(m.classic.reflectionFactor) || refracts(m);
  const float alpha = m.perceptualRoughnessFactor * m.perceptualRoughnessFactor;
  return m.model == IlluminationModel::cookTorrance && (alpha < kSmoothAlpha || refracts(m) || coatMirrors(m));
}

bool coatMirrors(const Material& m) {
  const float alpha = m.layers.clearcoatRoughness * m.layers.clearcoatRoughness;
  return isLayered(m) && m.layers.clearcoat > 0 && alpha < kSmoothAlpha;
}

bool hasAngularSpecular(const Material& m) {
  const bool highlights = m.model == IlluminationModel::phong || m.model == IlluminationModel::blinnPhong ||
                          m.model == IlluminationModel::modifiedPhong;
  return highlights && m.classic.angularSpecular;
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

bool scatters(const Material& m) { return absorbs(m) && anyPositive(m.multiscatterColor); }

bool anyScatters(const Scene& scene) { return std::any_of(scene.materials.begin(), scene.materials.end(), scatters); }

// Kulla, Conty 2017, "Revisiting Physically Based Shading at Imageworks", "Volumetrics": the albedo of a half space of
// isotropic scatterers turned round, and similarity for others.
glm::vec3 scatteringAlbedo(const Material& m) {
  glm::vec3 albedo(0.0f);
  if (!scatters(m)) return albedo;
  for (glm::length_t c = 0; c < 3; ++c) {
    const double seen = m.multiscatterColor[c], g = m.scatterAnisotropy;
    const double s = 4.09712 + 4.20863 * seen - std::sqrt(9.59217 + 41.6808 * seen + 17.7126 * seen * seen);
    albedo[c] = static_cast<float>(std::clamp((1.0 - s * s) / (1.0 - g * s * s), 0.0, 1.0));
  }
  return albedo;
}

bool isLit(const Material& m) {
  if (m.model == IlluminationModel::unlit) return false;
  return !isClassic(m) || anyPositive(m.classic.diffuseFactor) || anyPositive(m.classic.specularFactor);
}

std::span<const MaterialRule> surfaceRules() { return kSurfaceRules; }
std::span<const MaterialRule> rayRules() { return kRayRules; }

std::uint64_t effectsOf(const Material& m) {
  std::uint64_t bits = 0;
  for (const auto rules : {surfaceRules(), rayRules()}) {
    for (const MaterialRule& rule : rules) bits |= rule.test(m) ? bitOf(rule.effect) : 0u;
  }
  return bits;
}

}  // namespace crosslight

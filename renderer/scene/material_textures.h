// Every texture that a material may use, so that what holds for all of them is said once.
#pragma once

#include <array>

#include "scene/scene.h"

namespace crosslight {

inline auto texturesOf(const Material& m) {
  const MaterialLayers& l = m.layers;
  return std::array{&m.baseColorTexture,
                    &m.metallicRoughnessTexture,
                    &m.normalTexture,
                    &m.occlusionTexture,
                    &m.emissiveTexture,
                    &m.transmissionTexture,
                    &m.bumpTexture,
                    &l.diffuseRoughnessTexture,
                    &l.specularTexture,
                    &l.specularColorTexture,
                    &l.clearcoatTexture,
                    &l.clearcoatRoughnessTexture,
                    &l.clearcoatNormalTexture,
                    &l.sheenColorTexture,
                    &l.sheenRoughnessTexture,
                    &l.anisotropyTexture,
                    &l.iridescenceTexture,
                    &l.filmThicknessTexture,
                    &l.diffuseTransmissionTexture,
                    &l.diffuseTransmissionColorTexture};
}

// The texture whose coordinates tangents follow where a mesh has none of its own; nullptr: nobody needs tangents.
inline const TextureUse* tangentTexture(const Material& m) {
  static const TextureUse kFirstSet{};
  if (m.normalTexture.present()) return &m.normalTexture;
  if (m.layers.clearcoatNormalTexture.present()) return &m.layers.clearcoatNormalTexture;
  if (m.layers.anisotropy > 0) return m.layers.anisotropyTexture.present() ? &m.layers.anisotropyTexture : &kFirstSet;
  return nullptr;
}

}  // namespace crosslight

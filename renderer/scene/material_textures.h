// Every texture that a material may use, so that what holds for all of them is said once.
#pragma once

#include <array>

#include "scene/scene.h"

namespace crosslight {

inline auto texturesOf(const Material& m) {
  return std::array{&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture, &m.occlusionTexture,
                    &m.emissiveTexture};
}

// The texture whose coordinates tangents follow where a mesh has none of its own; nullptr: nobody needs tangents.
inline const TextureUse* tangentTexture(const Material& m) {
  return m.normalTexture.present() ? &m.normalTexture : nullptr;
}

}  // namespace crosslight

// Scenes that call for effects which no file of scenes/feature/ shows.
#pragma once

#include "support/render_fixture.h"

namespace crosslight::testing {

// One picture in the place of another one.
template <TextureUse Material::*use>
Scene textured() {
  Scene scene = sceneNamed("feature/texture");
  for (Material& m : scene.materials) {
    const TextureUse picture = m.baseColorTexture;
    m = Material();
    m.emissiveFactor = glm::vec3(0.5f);
    m.baseColorTexture = picture;
    m.*use = picture;
  }
  scene.atmosphere.ambient = glm::vec3(0.5f);
  return scene;
}

// A surface that lights others.
inline Scene glowing() {
  Scene scene = loadScene(scenesFolder() / "feature/emission.gltf");
  completeScene(scene, EmissiveLights::on);
  return scene;
}

}  // namespace crosslight::testing

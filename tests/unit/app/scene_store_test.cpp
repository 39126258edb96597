// A turned camera stays at its distance and looks at the same middle; a scene that several use is loaded once.
#include "app/scene_store.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "scene/load.h"

namespace crosslight {
namespace {

const std::string kScene = CROSSLIGHT_SOURCE_DIR "/scenes/showcase/teapot.gltf";

RenderOptions optionsFor(const std::string& file, double turnDegrees = 0) {
  RenderOptions o;
  o.scene = file;
  o.turnDegrees = turnDegrees;
  return o;
}

Scene cameraInFront() {
  Scene scene;
  scene.worldBounds.add({1, 0, 1});
  scene.worldBounds.add({3, 4, 3});
  scene.cameras.emplace_back();
  scene.cameras[0].worldFromCamera[3] = glm::dvec4(2, 5, 12, 1);  // ten in front of the middle (2, 2, 2)
  scene.lights.emplace_back();
  return scene;
}

TEST(Orbit, turnsCounterClockwiseAboutTheMiddle) {
  Scene scene = cameraInFront();
  orbit(scene, 0, 90);
  const glm::dmat4& m = scene.cameras[0].worldFromCamera;
  EXPECT_NEAR(glm::distance(glm::dvec3(m[3]), glm::dvec3(12, 5, 2)), 0,
              1e-12);  // to the right of who looked from the front
  EXPECT_NEAR(glm::distance(-glm::dvec3(m[2]), glm::dvec3(-1, 0, 0)), 0, 1e-15) << "it looks at the middle still";
  EXPECT_EQ(glm::dvec3(m[1]), glm::dvec3(0, 1, 0));
}

TEST(Orbit, ofNothingChangesNoBit) {
  Scene scene = cameraInFront();
  orbit(scene, 0, 0);
  EXPECT_EQ(scene.cameras[0].worldFromCamera, cameraInFront().cameras[0].worldFromCamera);
}

TEST(Orbit, takesTheHeadlightAlongAndNoOtherLight) {
  for (const bool headlight : {false, true}) {
    Scene scene = cameraInFront();
    scene.defaultLight = headlight;
    orbit(scene, 0, 180);
    EXPECT_NEAR(scene.lights[0].worldDirection.z, headlight ? 1 : -1, 1e-15);
  }
}

TEST(SceneStore, loadsOnceWhatSeveralUse) {
  SceneStore store;
  for (int i = 0; i < 2; ++i) store.expect(optionsFor(kScene));
  store.expect(optionsFor(kScene, 90));
  const auto first = store.take(optionsFor(kScene));
  EXPECT_FALSE(store.release(optionsFor(kScene))) << "there is another use";
  EXPECT_EQ(store.take(optionsFor(kScene)), first);
  EXPECT_NE(store.take(optionsFor(kScene, 90)), first) << "its camera is turned";
  EXPECT_TRUE(store.release(optionsFor(kScene)));
  EXPECT_EQ(store.loaded(optionsFor(kScene)), nullptr) << "it is kept after its last use";
}

TEST(SceneStore, tellsScenesApartByAllThatTheyDependOn) {
  SceneStore store;
  RenderOptions o = optionsFor(kScene);
  store.expect(o);
  const auto first = store.take(o);
  const auto differs = [&](const RenderOptions& other) {
    store.expect(other);
    return store.take(other) != first;
  };
  RenderOptions timed = o, named = o;
  timed.timeGiven = true;
  EXPECT_TRUE(differs(timed));
  named.sceneName = "0";
  EXPECT_TRUE(differs(named));
  RenderOptions sized = o;
  sized.resolution = "8x8";
  EXPECT_FALSE(differs(sized)) << "a picture's size is no matter of the scene";
}

TEST(SceneFile, posesWhatLoadSceneLoads) {
  LoadOptions options;
  options.hashContents = true;
  const SceneFile file(kScene, options);
  const Scene a = file.pose(0), b = file.pose(0), c = loadScene(kScene, options);
  for (const Scene* scene : {&b, &c}) {
    ASSERT_EQ(scene->meshes.size(), a.meshes.size());
    EXPECT_EQ(scene->meshes[0].primitives[0].positions, a.meshes[0].primitives[0].positions);
    EXPECT_EQ(scene->materials.size(), a.materials.size());
    EXPECT_EQ(scene->cameras.size(), a.cameras.size());
    EXPECT_EQ(scene->lights.size(), a.lights.size());
    EXPECT_EQ(scene->stats.contentHash, a.stats.contentHash);
  }
  EXPECT_NE(a.stats.contentHash, 0u);
  EXPECT_EQ(loadScene(kScene).stats.contentHash, 0u) << "hashed without being asked";
  EXPECT_NE(loadScene(CROSSLIGHT_SOURCE_DIR "/scenes/showcase/teapots.gltf", options).stats.contentHash,
            a.stats.contentHash);
}

}  // namespace
}  // namespace crosslight

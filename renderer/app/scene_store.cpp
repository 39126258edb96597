#include "app/scene_store.h"

#include <fmt/format.h>

#include "app/scene_extras.h"
#include "scene/load.h"

namespace crosslight {
namespace {

// Everything that a loaded and posed scene depends on. A turned camera belongs to the scene, so its name does too.
std::string keyOf(const RenderOptions& o) {
  const std::string turned = o.turnDegrees == 0 ? "" : fmt::format("{} {:a}", o.camera, o.turnDegrees);
  const std::string time = o.timeGiven ? fmt::format("{:a}", o.timeSeconds) : "";
  const DisplacementOptions d = displacementOf(o);
  const std::string split = d.edgePixels > 0 ? fmt::format("{:a} {} {} {}", d.edgePixels, d.camera, d.width, d.height)
                                             : std::to_string(d.level);
  // Length first: no two lists of words give one key.
  std::string key;
  for (const std::string& word : {o.scene, o.sceneName, o.animation, time, turned, split,
                                  std::string(o.part.empty() ? "" : "hashed"), o.environment}) {
    key += fmt::format("{}:{};", word.size(), word);
  }
  for (const std::string& pair : o.set) {  // glowing surfaces are lights of the scene
    if (pair.starts_with("emissive-lights")) key += pair + ";";
  }
  return key;
}

}  // namespace

int cameraOf(const Scene& scene, const RenderOptions& o) { return o.camera.empty() ? 0 : findCamera(scene, o.camera); }

std::shared_ptr<Scene> loadPosed(const RenderOptions& o) {
  auto scene = std::make_shared<Scene>(loadScene(o.scene, loadOptionsOf(o)));
  completeScene(*scene, o);
  orbit(*scene, cameraOf(*scene, o), o.turnDegrees);
  return scene;
}

void SceneStore::expect(const RenderOptions& options) { ++entries_[keyOf(options)].uses; }

std::shared_ptr<const Scene> SceneStore::take(const RenderOptions& options) {
  const auto found = entries_.find(keyOf(options));
  if (found == entries_.end()) return loadPosed(options);
  if (found->second.scene == nullptr) found->second.scene = loadPosed(options);
  return found->second.scene;
}

std::shared_ptr<const Scene> SceneStore::loaded(const RenderOptions& options) const {
  const auto found = entries_.find(keyOf(options));
  return found == entries_.end() ? nullptr : found->second.scene;
}

bool SceneStore::release(const RenderOptions& options) {
  const auto found = entries_.find(keyOf(options));
  if (found == entries_.end()) return true;
  if (--found->second.uses > 0) return false;
  entries_.erase(found);
  return true;
}

}  // namespace crosslight

// Scenes that several pictures of one process use: each is loaded once and kept until its last use.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "app/render_options.h"
#include "scene/scene.h"

namespace crosslight {

class SceneStore {
 public:
  // Announces a use. A scene that nobody announced is loaded for the asker alone.
  void expect(const RenderOptions& options);
  // The scene as the options pose it, camera turned. Throws what loading throws, each time.
  std::shared_ptr<const Scene> take(const RenderOptions& options);
  std::shared_ptr<const Scene> loaded(const RenderOptions& options) const;  // null: not (yet)
  // A use is over. True when it was the last one.
  bool release(const RenderOptions& options);

 private:
  struct Entry {
    std::size_t uses = 0;
    std::shared_ptr<const Scene> scene;
  };
  std::map<std::string, Entry> entries_;
};

// A file posed and with its camera turned, and that camera's index. UsageError when there is no such camera.
std::shared_ptr<Scene> loadPosed(const RenderOptions& options);
int cameraOf(const Scene& scene, const RenderOptions& options);

}  // namespace crosslight

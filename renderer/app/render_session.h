// Renders of one process, one after the other, on one device: what two of them share is made once. Each image has the
// same bits as if it were the only one.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "accel/bvh_cache.h"
#include "app/render_job.h"
#include "film/film.h"

namespace crosslight {

struct RenderRequest {
  std::shared_ptr<const Scene> scene;
  RenderSettings settings;
  std::vector<Band> rows = {};          // the image holds these rows only; empty: all
  std::uint64_t fileBytesPerPixel = 0;  // of the image's file while it is made, for the estimate of memory
  bool isFrame = false;                 // others like it follow: trees are kept, and moved where triangles move
  // The image is only shown, through this transform: then it may hold shownCodes instead of samples, the same codes.
  std::optional<DisplayTransform> shownBy = {};
  BvhCache bvhCache = {};                       // where trees of large scenes are kept on disk; no folder: nowhere
  std::optional<glm::uvec2> rayTreePixel = {};  // whitted: RenderResult::rayTree is wanted
  bool warnsOfForced = true;                    // that the image is not the scene's
};

class RenderSession {
 public:
  explicit RenderSession(gpu::Device& device);  // must outlive the session
  RenderSession(const RenderSession&) = delete;
  RenderSession& operator=(const RenderSession&) = delete;
  ~RenderSession();

  // As render() of render_job.h.
  RenderResult render(const RenderRequest& request, const ProgressFunction& progress = {});
  // Lets go of what was made for a scene.
  void forget(const Scene& scene);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace crosslight

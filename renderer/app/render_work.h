// One piece of work of `crosslight render`: a picture, a part of one, or the frames of an animation; from options to
// files and a record.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/frame_plan.h"
#include "app/lazy_device.h"
#include "app/part.h"
#include "app/render_options.h"
#include "app/scene_store.h"

namespace crosslight {

struct CommonOptions;

struct RenderWork {
  RenderOptions options;
  RenderSettings settings;  // the camera is still to be found
  DisplayTransform display;
  std::vector<Frame> frames;  // empty: one picture
  std::optional<Part> part;
  std::optional<glm::uvec2> rayTreePixel;
};

// Everything that can be said before a file is looked at; UsageError.
RenderWork checkedWork(const RenderOptions& options);
// Whether the files can be written and the tools are there.
void checkPlaces(const RenderWork& work);

struct RenderContext {
  LazyDevice& device;
  SceneStore& scenes;
  const CommonOptions& common;
  std::string task = {};  // before the method in the progress: "3/10 "
};

// Draws, writes, says so on stderr. The record of it.
Json runWork(const RenderWork& work, RenderContext& context);

// The steps, for those who loop over them themselves.
RenderResult drawWithProgress(const RenderWork& work, RenderContext& context, const RenderRequest& request);
std::uint64_t fileBytesPerPixel(const RenderWork& work);
std::optional<DisplayTransform> shownBy(const RenderWork& work);  // the pictures end as 8-bit codes
void append(Times&& more, Times& timesMs);
Json runFrames(const RenderWork& work, RenderContext& context);  // render_frames.cpp

}  // namespace crosslight

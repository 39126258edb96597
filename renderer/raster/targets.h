// What a raster picture is drawn into: one strip of it at a time.
#pragma once

#include "film/film.h"
#include "scene/settings.h"

namespace crosslight {

struct RasterTargets {
  RasterTargets(const gpu::Device& device, const RenderSettings& settings, std::uint32_t stripRows,
                const FilmBuffers& buffers);

  gpu::ImageFormat colorFormat;
  std::uint32_t pixelBytes;
  gpu::Image picture, multisampled, depth, aovDepth;
  bool areFilm = false;  // the picture is drawn into the film's buffer itself, without a copy
};

}  // namespace crosslight

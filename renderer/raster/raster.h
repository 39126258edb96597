// The graphics pipelines: wireframe, flat, Gouraud and Phong shading of the same triangles with the same illumination.
#pragma once

#include <memory>

#include "effects/effects.h"
#include "film/film.h"
#include "upload/gpu_scene.h"

namespace crosslight {

// Whether a picture can be drawn as a film's codes (FilmSettings::shownBy): one surface, or the background, is all that
// a pixel shows.
bool canDrawCodes(const Plan& plan, const RenderSettings& settings);

// `scene`, `buffers` and `settings` must outlive it. DeviceError when the device lacks the sample count.
std::unique_ptr<Technique> makeRaster(const gpu::Device& device, GpuScene& scene, const Plan& plan,
                                      const RenderSettings& settings, FilmBuffers& buffers);

}  // namespace crosslight

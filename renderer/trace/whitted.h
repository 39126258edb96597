// Whitted's ray tracer as compute kernels: one ray tree per pixel, level by level.
#pragma once

#include <memory>

#include "effects/effects.h"
#include "film/film.h"
#include "upload/gpu_scene.h"

namespace crosslight {

// `scene`, `buffers` and `settings` must outlive it.
std::unique_ptr<Technique> makeWhitted(const gpu::Device& device, GpuScene& scene, const Plan& plan,
                                       const RenderSettings& settings, FilmBuffers& buffers);

}  // namespace crosslight

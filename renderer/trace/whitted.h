// Whitted's ray tracer as compute kernels: one ray tree per pixel, level by level.
#pragma once

#include <cstdint>
#include <memory>

#include "effects/effects.h"
#include "film/film.h"
#include "trace/kernels.h"
#include "trace/ray_tree.h"
#include "upload/gpu_scene.h"

namespace crosslight {

// Camera rays of a picture, or of a band of it: tiles of 8 x 8 pixels, those that overhang its edge counted whole.
std::uint32_t cameraRayCount(std::uint32_t width, std::uint32_t height);

// `scene`, `buffers` and `settings` must outlive it.
std::unique_ptr<Technique> makeWhitted(const gpu::Device& device, GpuScene& scene, const Plan& plan,
                                       const RenderSettings& settings, FilmBuffers& buffers);
// With pipelines that were made earlier, for the same scene, plan and settings.
std::unique_ptr<Technique> makeWhittedWith(std::shared_ptr<KernelPipelines> kernels, const gpu::Device& device,
                                           GpuScene& scene, const Plan& plan, const RenderSettings& settings,
                                           FilmBuffers& buffers);

// The tree of the ray through a pixel's center, with the pipelines of the picture.
RayTree traceRayTree(std::shared_ptr<KernelPipelines> kernels, const gpu::Device& device, GpuScene& scene,
                     const Plan& plan, const RenderSettings& settings, const glm::uvec2& pixel);

}  // namespace crosslight

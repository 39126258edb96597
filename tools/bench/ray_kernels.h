// The Whitted tracer's traversal kernels one by one, on one picture: each run alone, in a submission of its own.
#pragma once

#include <vector>

#include "effects/effects.h"
#include "gpu/commands.h"
#include "trace/kernels.h"
#include "upload/gpu_scene.h"

namespace crosslight::bench {

class RayKernels {
 public:
  // All must outlive it. One light.
  RayKernels(const gpu::Device& device, GpuScene& scene, const Plan& plan, const RenderSettings& settings,
             KernelFamily family = KernelFamily::automatic);

  // Milliseconds on the device's clock (wall time, submit to idle, where it has none).
  double camera();  // closest hits of the camera's rays
  double shadow();  // from these hits to the light
  double bounce();  // closest hits of the rays given last

  // Reads back what the last runs left.
  std::vector<shared::HitRecord> hits() const { return hits_.readAll<shared::HitRecord>(); }
  std::vector<float> visibility() const { return visibility_.readAll<float>(); }
  std::vector<shared::HitRecord> bounceHits() const { return bounceHits_.readAll<shared::HitRecord>(); }

  void setBounceRays(const std::vector<shared::RayRecord>& rays);
  // Since the last call: shadow rays traced, and traversals that met their limit, and packets that gave up (their rays
  // are not done here).
  struct Counts {
    std::uint32_t shadowRays = 0, capped = 0, gaveUp = 0;
  };
  Counts takeCounts();
  const KernelChoice& choice() const { return kernels_.choice(); }

 private:
  double run(KernelPipelines& kernels, const std::string& kernel, const gpu::BindingSet& set, std::uint32_t rays);
  void bind(gpu::BindingSet& set, const gpu::Buffer& rays, const gpu::Buffer& hits);

  const gpu::Device& device_;
  GpuScene& scene_;
  std::uint32_t count_, rows_;
  KernelPipelines kernels_, secondary_;
  gpu::Buffer rays_, nodes_, hits_, visibility_, counters_, rest_, dummy_, bounceRays_, bounceHits_;
  std::uint32_t bounceCount_ = 0;
  gpu::BindingSet set_, bounceSet_;
  gpu::Commands commands_;
};

}  // namespace crosslight::bench

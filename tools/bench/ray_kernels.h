// The Whitted tracer's traversal kernels one by one, on one picture: each run alone, in a submission of its own.
#pragma once

#include <vector>

#include "effects/effects.h"
#include "gpu/commands.h"
#include "upload/gpu_scene.h"

namespace crosslight::bench {

class RayKernels {
 public:
  // All must outlive it. One light.
  RayKernels(const gpu::Device& device, GpuScene& scene, const Plan& plan, const RenderSettings& settings);

  // Milliseconds on the device's clock (wall time, submit to idle, where it has none).
  double generate();   // camera rays of all pixels
  double intersect();  // their closest hits
  double shadow();     // from their hits to the light
  double bounce();     // closest hits of the rays given last

  // Reads back what the last runs left.
  std::vector<shared::RayNode> nodes() const { return nodes_.readAll<shared::RayNode>(); }
  std::vector<shared::HitRecord> hits() const { return hits_.readAll<shared::HitRecord>(); }
  std::vector<float> visibility() const { return visibility_.readAll<float>(); }
  std::vector<shared::HitRecord> bounceHits() const { return bounceHits_.readAll<shared::HitRecord>(); }

  void setBounceRays(const std::vector<shared::RayNode>& rays);
  // Since the last call: shadow rays traced, and traversals that met their limit.
  struct Counts {
    std::uint32_t shadowRays = 0, capped = 0;
  };
  Counts takeCounts();

 private:
  double run(const gpu::ComputePipeline& pipeline, const gpu::BindingSet& set, std::uint32_t rays);
  void bind(gpu::BindingSet& set, const gpu::Buffer& nodes, const gpu::Buffer& hits);

  const gpu::Device& device_;
  GpuScene& scene_;
  std::uint32_t pixels_;
  gpu::Buffer nodes_, hits_, visibility_, counters_, bounceNodes_, bounceHits_;
  std::uint32_t bounceCount_ = 0;
  gpu::BindingLayout layout_;
  gpu::BindingSet set_, bounceSet_;
  gpu::ComputePipeline generate_, intersect_, shadow_;
  gpu::Commands commands_;
};

}  // namespace crosslight::bench

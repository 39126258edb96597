// Uniform blocks that go with each draw: its material, and the lights while they are few. The records are those that
// the ray kernels read from storage buffers.
#pragma once

#include "gpu/pipeline.h"
#include "raster_bindings.h"
#include "upload/gpu_scene.h"

namespace crosslight {

class DrawUniforms {
 public:
  DrawUniforms(const gpu::Device& device, const GpuScene& scene);

  static std::vector<gpu::Binding> bindings();
  void bind(gpu::BindingSet& set) const;
  // Where a material's window begins.
  std::uint32_t offsetOf(std::uint32_t materialId) const { return materialId * strideBytes_; }

 private:
  std::uint32_t strideBytes_;
  gpu::Buffer materials_, lights_;
};

}  // namespace crosslight

// Draws the scene as each light sees it, into texels that shading reads by arithmetic.
#pragma once

#include "effects/effects.h"
#include "gpu/commands.h"
#include "raster/shadow_views.h"
#include "upload/gpu_scene.h"

namespace crosslight {

class ShadowMaps {
 public:
  // DeviceError when the texels are more than the device reads as one list.
  ShadowMaps(const gpu::Device& device, const GpuScene& scene, const Plan& plan, const RenderSettings& settings);

  static std::vector<gpu::Binding> bindings();
  void bind(gpu::BindingSet& set) const;
  // `shared`: constants of all raster shaders.
  void makePipelines(const gpu::Device& device, const gpu::BindingLayout& layout, const gpu::Constants& shared);
  void record(gpu::Commands& commands, const gpu::BindingSet& set) const;
  std::size_t viewCount() const { return views_.views.size(); }

 private:
  struct Casters {
    std::uint32_t firstTriangle = 0, triangleCount = 0, materialId = 0, flags = 0;
  };
  void gatherCasters(const GpuScene& scene, const Plan& plan);
  void draw(gpu::Commands& commands, const std::vector<Casters>& casters, std::uint32_t view) const;
  void recordDistances(gpu::Commands& commands, const gpu::BindingSet& set, const std::vector<Casters>& casters,
                       std::uint32_t view, std::uint64_t layer) const;
  void recordPassed(gpu::Commands& commands, const gpu::BindingSet& set, std::uint32_t view) const;

  std::uint32_t size_, layers_;
  ShadowViews views_;
  std::vector<Casters> solid_, transparent_;
  gpu::Buffer texels_, viewRecords_, lightRecords_;
  gpu::Image distances_, depth_, passed_;
  gpu::GraphicsPipeline distancePipeline_, nothingPipeline_, passedPipeline_;
};

}  // namespace crosslight

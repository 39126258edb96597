// Shadows of the raster methods: what is made of the lights before the first sample, and how shaders get at it.
// Lighting per fragment asks the trees or the maps by itself; for vertices that is done here, once per vertex and
// light.
#pragma once

#include <optional>
#include <string>

#include "effects/effects.h"
#include "gpu/commands.h"
#include "raster/shadow_maps.h"
#include "raster_bindings.h"
#include "upload/gpu_scene.h"

namespace crosslight {

class ShadowPass {
 public:
  ShadowPass(const gpu::Device& device, const GpuScene& scene, const Plan& plan, const RenderSettings& settings);

  // Of the raster methods' layout: nothing where there are no shadows.
  std::vector<gpu::Binding> bindings() const;
  gpu::Constants constants() const;
  // `shared`: constants of all raster shaders.
  void make(const gpu::Device& device, const gpu::BindingLayout& layout, const gpu::Constants& shared);
  void bind(gpu::BindingSet& set) const;
  // Everything that shading reads; the first time only.
  void record(gpu::Commands& commands, const gpu::BindingSet& set);
  std::string promise() const;  // "without shadows"
  std::size_t mapCount() const { return maps_ ? maps_->viewCount() : 0; }
  bool walksTrees() const { return mode_ == shared::kShadowsByRays; }

 private:
  void recordVertices(gpu::Commands& commands, const gpu::BindingSet& set) const;

  const GpuScene& scene_;
  std::uint32_t mode_ = shared::kShadowsOff;
  bool lightsVertices_ = false;
  bool recorded_ = false;
  std::uint32_t filter_ = 0;
  std::optional<ShadowMaps> maps_;
  gpu::Buffer vertexVisibility_;
  gpu::ComputePipeline vertices_;
};

}  // namespace crosslight

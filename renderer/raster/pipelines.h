// The programs that the passes of a raster picture run: one for each pass that the method, the plan and the picture
// call for. What is drawn with them, and when, raster.cpp decides.
#pragma once

#include <cstdint>

#include "effects/effects.h"
#include "gpu/pipeline.h"
#include "scene/settings.h"

namespace crosslight {

struct PipelineInputs {
  const Plan& plan;
  const RenderSettings& settings;
  std::uint32_t lightCount;
  gpu::Constants shadows;      // of the shadow pass
  gpu::Constants reflections;  // of the mirrors
  gpu::ImageFormat colorFormat = gpu::ImageFormat::rgba32f;
  bool codes = false;    // colors are a display's
  bool layers = false;   // something is transparent
  bool prepass = false;  // depth alone goes first
  gpu::Constants layerConstants = {};
};

struct RasterPipelines {
  RasterPipelines() = default;
  RasterPipelines(const gpu::Device& device, const gpu::BindingLayout& layout, const PipelineInputs& inputs);

  // Those that nothing calls for are empty.
  gpu::GraphicsPipeline opaque, keepLayers, resolveLayers, background, depthFill, aovDepthPass, aovPass;
};

// Of every stage of a raster picture.
gpu::Constants rasterConstants(const PipelineInputs& inputs, std::uint32_t varyings, std::uint32_t variant = 0);

}  // namespace crosslight

#include "raster/draw_uniforms.h"

#include <algorithm>
#include <cstring>

namespace crosslight {

using namespace shared;

namespace {

gpu::Buffer windowsOf(const gpu::Device& device, const std::vector<MaterialRecord>& records, std::size_t strideBytes) {
  std::vector<std::byte> bytes(records.size() * strideBytes);
  for (std::size_t i = 0; i < records.size(); ++i) {
    std::memcpy(bytes.data() + i * strideBytes, &records[i], sizeof(MaterialRecord));
  }
  return {device, "draws' materials", bytes, gpu::useUniformWindows};
}

// The whole block, however few there are: shaders declare its full size.
gpu::Buffer fewLightsOf(const gpu::Device& device, std::vector<LightRecord> lights) {
  lights.resize(kFewLights);
  return gpu::Buffer::of(device, "few lights", lights, gpu::useUniform);
}

}  // namespace

DrawUniforms::DrawUniforms(const gpu::Device& device, const GpuScene& scene) {
  const std::uint32_t alignment = std::max(1u, device.info().uniformWindowAlignment);
  strideBytes_ = (std::uint32_t{sizeof(MaterialRecord)} + alignment - 1) / alignment * alignment;
  materials_ = windowsOf(device, scene.materials().readAll<MaterialRecord>(), strideBytes_);
  lights_ = fewLightsOf(device, scene.lights().readAll<LightRecord>());
}

std::vector<gpu::Binding> DrawUniforms::bindings() {
  return {{kBindDrawMaterial, gpu::BindingType::uniformWindow}, {kBindFewLights, gpu::BindingType::uniformBuffer}};
}

void DrawUniforms::bind(gpu::BindingSet& set) const {
  set.setWindow(kBindDrawMaterial, materials_, sizeof(MaterialRecord));
  set.set(kBindFewLights, lights_);
}

}  // namespace crosslight

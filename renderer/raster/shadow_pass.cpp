#include "raster/shadow_pass.h"

#include <algorithm>
#include <cmath>

#include "effects/effects.h"

namespace crosslight {

using namespace shared;

namespace {

constexpr std::uint32_t kVerticesPerGroup = 64;
constexpr std::uint32_t kMostGroups = 65535;  // of one dimension, on every device

std::uint32_t modeOf(const Plan& plan, const RenderSettings& settings) {
  if (!plan.has(Effect::shadows) || settings.method == Method::wireframe) return kShadowsOff;
  switch (settings.rasterShadows) {
    case RasterShadows::rays:
      return kShadowsByRays;
    case RasterShadows::maps:
      return kShadowsByMaps;
    case RasterShadows::off:
      break;
  }
  return kShadowsOff;
}

bool lightsVertices(const RenderSettings& settings) {
  return settings.method == Method::gouraud ||
         (settings.method == Method::flat && settings.flatVertex != FlatVertex::centroid);
}

// The largest coordinate of the scene.
float reachOf(const Bounds& bounds) {
  float reach = 0.0f;
  for (int i = 0; i < 3; ++i) reach = std::max({reach, std::abs(bounds.lower[i]), std::abs(bounds.upper[i])});
  return reach;
}

}  // namespace

ShadowPass::ShadowPass(const gpu::Device& device, const GpuScene& scene, const Plan& plan,
                       const RenderSettings& settings)
    : scene_(scene),
      mode_(modeOf(plan, settings)),
      lightsVertices_(mode_ != kShadowsOff && lightsVertices(settings)),
      filter_(settings.shadowMaps.soft ? 0 : settings.shadowMaps.filterSize) {
  if (mode_ == kShadowsByMaps) maps_.emplace(device, scene, plan, settings);
}

std::vector<gpu::Binding> ShadowPass::bindings() const {
  std::vector<gpu::Binding> all;
  if (lightsVertices_) all.push_back({kBindVertexVisibility, gpu::BindingType::storageBuffer});
  if (maps_) {
    for (const gpu::Binding& binding : ShadowMaps::bindings()) all.push_back(binding);
  }
  return all;
}

gpu::Constants ShadowPass::constants() const { return {{kSpecRasterShadows, mode_}, {kSpecShadowFilter, filter_}}; }

std::string ShadowPass::promise() const {
  if (mode_ == kShadowsOff) return "without shadows";
  const std::string where = lightsVertices_ ? " where light is evaluated, at vertices" : "";
  const auto& lights = scene_.scene().lights;
  const bool area = std::any_of(lights.begin(), lights.end(), isArea);
  const std::string from = area ? " from the middle of each light with an area" : "";
  return (mode_ == kShadowsByRays ? "with hard shadows" : "with shadows from depth maps") + from + where;
}

void ShadowPass::make(const gpu::Device& device, const gpu::BindingLayout& layout, const gpu::Constants& shared) {
  if (maps_) maps_->makePipelines(device, layout, shared);
  if (!lightsVertices_) return;
  const std::uint64_t values = std::uint64_t{scene_.flat().positions.size()} * std::max(1u, scene_.lightCount());
  vertexVisibility_ = gpu::Buffer(device, "visibility from vertices", values * sizeof(float), gpu::useStorage);
  vertices_ = gpu::ComputePipeline(device, layout, gpu::embeddedShader("vertex_shadow.comp"), shared);
}

void ShadowPass::bind(gpu::BindingSet& set) const {
  if (maps_) maps_->bind(set);
  if (lightsVertices_) set.set(kBindVertexVisibility, vertexVisibility_);
}

void ShadowPass::record(gpu::Commands& commands, const gpu::BindingSet& set) {
  if (mode_ == kShadowsOff || recorded_) return;
  recorded_ = true;
  if (maps_) maps_->record(commands, set);
  if (lightsVertices_) recordVertices(commands, set);
}

void ShadowPass::recordVertices(gpu::Commands& commands, const gpu::BindingSet& set) const {
  const auto vertices = static_cast<std::uint32_t>(scene_.flat().positions.size());
  const std::uint32_t groups = (vertices + kVerticesPerGroup - 1) / kVerticesPerGroup;
  if (groups == 0) return;
  commands.beginSpan("vertex shadows");
  commands.bind(vertices_, set);
  for (std::uint32_t light = 0; light < scene_.lightCount(); ++light) {
    commands.push(VertexShadowPush{vertices, light, scene_.lightCount(), reachOf(scene_.flat().bounds)});
    commands.dispatch(std::min(groups, kMostGroups), (groups + kMostGroups - 1) / kMostGroups);
  }
  commands.endSpan();
  commands.barrier();
}

}  // namespace crosslight

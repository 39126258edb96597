#include "raster/shadow_maps.h"

#include <fmt/format.h>

#include "base/error.h"
#include "effects/material_traits.h"

namespace crosslight {

using namespace shared;

namespace {

constexpr std::uint64_t kWord = sizeof(std::uint32_t);

gpu::Buffer texelsOf(const gpu::Device& device, std::uint64_t words, const RenderSettings& settings) {
  if (words > device.info().maxTexelBufferElements) {
    throw DeviceError(
        fmt::format("shadow maps of {} texels a side need {} words, '{}' reads lists of up to {}; lower "
                    "--set shadow-map-size or take --set raster-shadows=rays",
                    settings.shadowMaps.size, words, device.info().name, device.info().maxTexelBufferElements));
  }
  return {device, "shadow maps", words * kWord, gpu::useUniformTexel};
}

std::uint32_t layersOf(const GpuScene& scene, const Plan& plan) {
  if (!plan.has(Effect::transparency)) return 1;
  for (std::uint32_t d = 0; d < scene.flat().meshDrawCount; ++d) {
    if (isTransparent(scene.scene().materials[scene.flat().draws[d].materialId])) return 2;
  }
  return 1;
}

}  // namespace

ShadowMaps::ShadowMaps(const gpu::Device& device, const GpuScene& scene, const Plan& plan,
                       const RenderSettings& settings)
    : size_(settings.shadowMaps.size),
      layers_(layersOf(scene, plan)),
      views_(makeShadowViews(scene.scene(), scene.flat(), settings, layers_)),
      texels_(texelsOf(device, views_.words, settings)),
      viewRecords_(gpu::Buffer::of(device, "shadow views", views_.views, gpu::useStorage)),
      lightRecords_(gpu::Buffer::of(device, "shadows of lights", views_.lights, gpu::useStorage)),
      distances_(device, "shadow distances", gpu::ImageFormat::r32ui, size_, size_),
      depth_(device, "shadow depth", gpu::ImageFormat::depth32f, size_, size_) {
  if (layers_ > 1) passed_ = gpu::Image(device, "light passed", gpu::ImageFormat::rgba32f, size_, size_);
  gatherCasters(scene, plan);
}

// Everything casts a shadow, on both sides, lit or not; what is opaque needs no material and is drawn together.
void ShadowMaps::gatherCasters(const GpuScene& scene, const Plan& plan) {
  for (std::uint32_t d = 0; d < scene.flat().meshDrawCount; ++d) {
    const DrawRecord& record = scene.flat().draws[d];
    const Material& m = scene.scene().materials[record.materialId];
    const bool masked = plan.has(Effect::alphaMask) && m.alphaMode == AlphaMode::mask;
    const Casters next{record.firstTriangle, record.triangleCount, record.materialId, record.flags};
    if (layers_ > 1 && isTransparent(m)) {
      transparent_.push_back(next);
    } else if (!masked && !solid_.empty() &&
               solid_.back().firstTriangle + solid_.back().triangleCount == next.firstTriangle &&
               scene.scene().materials[solid_.back().materialId].alphaMode != AlphaMode::mask) {
      solid_.back().triangleCount += next.triangleCount;
    } else {
      solid_.push_back(next);
    }
  }
}

std::vector<gpu::Binding> ShadowMaps::bindings() {
  return {{kBindShadowTexels, gpu::BindingType::texelBufferUint1},
          {kBindShadowViews, gpu::BindingType::storageBuffer},
          {kBindShadowLights, gpu::BindingType::storageBuffer}};
}

void ShadowMaps::bind(gpu::BindingSet& set) const {
  set.set(kBindShadowTexels, texels_);
  set.set(kBindShadowViews, viewRecords_);
  set.set(kBindShadowLights, lightRecords_);
}

void ShadowMaps::makePipelines(const gpu::Device& device, const gpu::BindingLayout& layout,
                               const gpu::Constants& shared) {
  gpu::GraphicsState state;
  state.vertex = gpu::embeddedShader("shadow.vert");
  state.fragment = gpu::embeddedShader("shadow.frag");
  state.constants = shared;
  state.colorFormat = gpu::ImageFormat::r32ui;
  distancePipeline_ = gpu::GraphicsPipeline(device, layout, state);
  if (layers_ > 1) {
    gpu::GraphicsState passed = state;
    passed.fragment = gpu::embeddedShader("shadow_passed.frag");
    passed.colorFormat = gpu::ImageFormat::rgba32f;
    passed.depthTarget = false;
    passed.depthTest = gpu::DepthTest::off;
    passed.depthWrite = false;
    passed.blend = gpu::Blend::overPremultiplied;
    passedPipeline_ = gpu::GraphicsPipeline(device, layout, passed);
  }
  state.vertex = gpu::embeddedShader("background.vert");
  state.fragment = gpu::embeddedShader("shadow_nothing.frag");
  state.depthTest = gpu::DepthTest::equal;
  state.depthWrite = false;
  nothingPipeline_ = gpu::GraphicsPipeline(device, layout, state);
}

void ShadowMaps::draw(gpu::Commands& commands, const std::vector<Casters>& casters, std::uint32_t view) const {
  commands.cull(gpu::Commands::Cull::none, false);
  for (const Casters& c : casters) {
    commands.push(ShadowPush{view, c.firstTriangle, c.materialId, c.flags});
    commands.draw(3 * c.triangleCount);
  }
}

void ShadowMaps::recordDistances(gpu::Commands& commands, const gpu::BindingSet& set,
                                 const std::vector<Casters>& casters, std::uint32_t view, std::uint64_t layer) const {
  gpu::RenderTargets targets;
  targets.color = &distances_;
  targets.depth = &depth_;
  targets.colorBefore = gpu::ColorBefore::undefined;
  commands.beginRendering(targets);
  commands.bind(distancePipeline_, set);
  draw(commands, casters, view);
  commands.bind(nothingPipeline_, set);
  commands.cull(gpu::Commands::Cull::none, false);
  commands.draw(3);
  commands.endRendering();
  const std::uint64_t firstWord = views_.views[view].firstTexel + layer * size_ * size_;
  commands.copyToBuffer(distances_, 0, size_, texels_, firstWord * kWord);
}

void ShadowMaps::recordPassed(gpu::Commands& commands, const gpu::BindingSet& set, std::uint32_t view) const {
  gpu::RenderTargets targets;
  targets.color = &passed_;
  targets.clearValue = glm::vec4(1.0f);
  commands.beginRendering(targets);
  commands.bind(passedPipeline_, set);
  draw(commands, transparent_, view);
  commands.endRendering();
  const std::uint64_t firstWord = views_.views[view].firstTexel + std::uint64_t{2} * size_ * size_;
  commands.copyToBuffer(passed_, 0, size_, texels_, firstWord * kWord);
}

void ShadowMaps::record(gpu::Commands& commands, const gpu::BindingSet& set) const {
  commands.beginSpan("shadow maps");
  for (std::uint32_t view = 0; view < views_.views.size(); ++view) {
    recordDistances(commands, set, solid_, view, 0);
    if (layers_ == 1) continue;
    recordDistances(commands, set, transparent_, view, 1);
    recordPassed(commands, set, view);
  }
  commands.endSpan();
  commands.barrier();
}

}  // namespace crosslight

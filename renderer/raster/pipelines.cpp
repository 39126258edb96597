#include "raster/pipelines.h"

#include "raster/method_shaders.h"
#include "raster_bindings.h"
#include "structs.h"
#include "upload/gpu_scene.h"

namespace crosslight {

using namespace shared;

namespace {

// Filled triangles are pushed this far behind their own edges when hidden lines are removed: two units of the depth
// format's resolution and twice the polygon's slope cover a line's rasterisation, which runs up to one pixel outside.
constexpr float kWireBiasConstant = -2.0f;
constexpr float kWireBiasSlope = -2.0f;

// A prepass lies behind what it stands for: the pass that lights then finds the nearest surfaces by the same test, in
// the same order, as without it. Farther by 4 units of the depth format at a triangle's nearest point: rounding takes
// one.
constexpr float kPrepassBias = -4.0f;

class Maker {
 public:
  Maker(const gpu::Device& device, const gpu::BindingLayout& layout, const PipelineInputs& inputs, RasterPipelines& all)
      : device_(device), layout_(layout), in_(inputs), all_(all) {}

  void make() {
    const MethodShaders shaders = shadersOf(in_.settings, in_.codes);
    const std::uint32_t varyings = varyingsOf(in_.settings, in_.plan);
    gpu::GraphicsState color = baseState(shaders.vertex, shaders.fragment, varyings);
    color.constants = rasterConstants(in_, varyings, clampsColors() ? kVariantClampVertexColors : 0u);
    if (in_.settings.method == Method::wireframe) {
      color.polygonMode = gpu::PolygonMode::line;
      color.depthTest = gpu::DepthTest::greaterOrEqual;
      gpu::GraphicsState fill = depthState();
      fill.depthBiasConstant = kWireBiasConstant;
      fill.depthBiasSlope = kWireBiasSlope;
      all_.depthFill = gpu::GraphicsPipeline(device_, layout_, fill);
    } else {
      all_.background = gpu::GraphicsPipeline(device_, layout_, backgroundState());
      if (in_.prepass) {
        gpu::GraphicsState fill = depthState();
        fill.depthBiasConstant = kPrepassBias;
        all_.depthFill = gpu::GraphicsPipeline(device_, layout_, fill);
      }
    }
    all_.opaque = gpu::GraphicsPipeline(device_, layout_, color);
    if (in_.layers) makeLayerPipelines(color, shaders);
    if (!in_.settings.aovs.empty()) makeAovPipelines(shaders);
  }

 private:
  gpu::GraphicsState baseState(std::string_view vertex, std::string_view fragment, std::uint32_t varyings) const {
    using enum gpu::VertexFormat;
    gpu::GraphicsState s;
    s.vertex = gpu::embeddedShader(vertex);
    if (!fragment.empty()) s.fragment = gpu::embeddedShader(fragment);
    s.constants = rasterConstants(in_, varyings);
    s.buffers = {{sizeof(glm::vec3)}, {sizeof(VertexAttributes)}};
    s.attributes = {{0, 0, 0, float3},
                    {1, 1, offsetof(VertexAttributes, renderNormal), float3},
                    {2, 1, offsetof(VertexAttributes, renderTangent), float4},
                    {3, 1, offsetof(VertexAttributes, uv0), float2},
                    {4, 1, offsetof(VertexAttributes, uv1), float2},
                    {5, 1, offsetof(VertexAttributes, color), float4}};
    s.colorFormat = in_.colorFormat;
    s.samples = in_.settings.msaa;
    s.shadePerSample = in_.settings.shadesPerSample && in_.settings.msaa > 1;
    return s;
  }

  // Depth alone; fragments only where an alpha mask cuts.
  gpu::GraphicsState depthState() const {
    gpu::GraphicsState s =
        baseState("phong.vert", in_.plan.has(Effect::alphaMask) ? "mask.frag" : "", depthVaryingsOf(in_.plan));
    s.colorTarget = false;
    return s;
  }

  // Where no surface was drawn the depth is still 0. Drawing there costs less than clearing what surfaces cover anyway:
  // llvmpipe clears formats of 16 bytes pixel by pixel (README).
  gpu::GraphicsState backgroundState() const {
    gpu::GraphicsState s;
    s.vertex = gpu::embeddedShader("background.vert");
    s.fragment = gpu::embeddedShader(backgroundShader(in_.codes));
    s.constants = rasterConstants(in_, 0);
    s.colorFormat = in_.colorFormat;
    s.samples = in_.settings.msaa;
    s.depthTest = gpu::DepthTest::equal;
    s.depthWrite = false;
    return s;
  }

  // Of the picture only: the AOVs hold the parts before the clamp, which has none.
  bool clampsColors() const {
    return in_.settings.clampVertexColors &&
           (in_.settings.method == Method::flat || in_.settings.method == Method::gouraud);
  }

  void makeLayerPipelines(gpu::GraphicsState keep, const MethodShaders& shaders) {
    const gpu::Constants constants = in_.layerConstants;
    keep.fragment = gpu::embeddedShader(shaders.layersFragment);
    keep.colorTarget = keep.depthWrite = false;
    keep.constants.insert(keep.constants.end(), constants.begin(), constants.end());
    all_.keepLayers = gpu::GraphicsPipeline(device_, layout_, keep);
    gpu::GraphicsState resolve = backgroundState();
    resolve.fragment = gpu::embeddedShader("layers_resolve.frag");
    resolve.constants = constants;
    resolve.depthTest = gpu::DepthTest::off;
    resolve.blend = gpu::Blend::overPerChannel;
    all_.resolveLayers = gpu::GraphicsPipeline(device_, layout_, resolve);
  }

  void makeAovPipelines(const MethodShaders& shaders) {
    gpu::GraphicsState depth = depthState();
    depth.vertex = gpu::embeddedShader(shaders.vertex);  // the same program as the pass that tests for equality
    depth.constants = rasterConstants(in_, kVaryingAll, kVariantSeparateSums);
    depth.samples = 1;
    depth.shadePerSample = false;
    all_.aovDepthPass = gpu::GraphicsPipeline(device_, layout_, depth);
    gpu::GraphicsState aov = baseState(shaders.vertex, shaders.aovFragment, kVaryingAll);
    aov.constants = rasterConstants(in_, kVaryingAll, kVariantSeparateSums);
    aov.colorTarget = false;
    aov.samples = 1;
    aov.shadePerSample = false;
    aov.depthTest = gpu::DepthTest::equal;
    aov.depthWrite = false;
    all_.aovPass = gpu::GraphicsPipeline(device_, layout_, aov);
  }

  const gpu::Device& device_;
  const gpu::BindingLayout& layout_;
  const PipelineInputs& in_;
  RasterPipelines& all_;
};

}  // namespace

gpu::Constants rasterConstants(const PipelineInputs& inputs, std::uint32_t varyings, std::uint32_t variant) {
  gpu::Constants all = constantsOf(inputs.plan, variant);
  const bool few = inputs.lightCount <= kFewLights && !inputs.settings.allEffects;
  all.push_back({kSpecVaryings, inputs.settings.allEffects ? kVaryingAll : varyings});
  all.push_back({kSpecLightCount, few ? inputs.lightCount : kManyLights});
  all.insert(all.end(), inputs.shadows.begin(), inputs.shadows.end());
  all.insert(all.end(), inputs.reflections.begin(), inputs.reflections.end());
  return all;
}

RasterPipelines::RasterPipelines(const gpu::Device& device, const gpu::BindingLayout& layout,
                                 const PipelineInputs& inputs) {
  Maker(device, layout, inputs, *this).make();
}

}  // namespace crosslight

#include "gpu/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/check.h"
#include "base/error.h"
#include "base/time.h"
#include "gpu/impl.h"
#include "gpu/spirv_sample_inputs.h"
#include "gpu/spirv_specialize.h"

namespace crosslight::gpu {
namespace {

// Specialization constants in Vulkan's form; what `info` points to lives here.
struct Specialization {
  explicit Specialization(const Constants& constants) {
    for (const Constant& constant : constants) {
      for (const vk::SpecializationMapEntry& earlier : entries) CL_CHECK(earlier.constantID != constant.id);
      entries.emplace_back(constant.id, static_cast<std::uint32_t>(4 * bits.size()), 4);
      bits.push_back(constant.bits);
    }
    info.setMapEntries(entries).setData<std::uint32_t>(bits);
  }
  Specialization(const Specialization&) = delete;
  Specialization& operator=(const Specialization&) = delete;

  std::vector<vk::SpecializationMapEntry> entries;
  std::vector<std::uint32_t> bits;
  vk::SpecializationInfo info;
};

vk::raii::ShaderModule moduleOf(const DeviceImpl& device, ShaderCode code, const Constants& constants,
                                PipelineMaking& making, bool atSamples = false) {
  CL_CHECK(!code.words.empty());
  std::vector<std::uint32_t> words = specialized(code.words, constants);
  if (atSamples) words = withSampleInputs(words);
  making.bytes += 4 * words.size();
  making.wholeBytes += 4 * code.words.size();
  vk::raii::ShaderModule module(device.device, vk::ShaderModuleCreateInfo({}, 4 * words.size(), words.data()));
  nameObject(device, module, std::string(code.name));
  return module;
}

vk::PipelineShaderStageCreateInfo stageInfo(vk::ShaderStageFlagBits stage, const vk::raii::ShaderModule& module,
                                            const Specialization& specialization) {
  return vk::PipelineShaderStageCreateInfo({}, stage, *module, "main", &specialization.info);
}

vk::Format vertexFormat(VertexFormat format) {
  switch (format) {
    case VertexFormat::float1:
      return vk::Format::eR32Sfloat;
    case VertexFormat::float2:
      return vk::Format::eR32G32Sfloat;
    case VertexFormat::float3:
      return vk::Format::eR32G32B32Sfloat;
    case VertexFormat::float4:
      return vk::Format::eR32G32B32A32Sfloat;
    case VertexFormat::uint1:
      return vk::Format::eR32Uint;
  }
  throw InternalError("broken invariant: unknown vertex format");
}

vk::CompareOp compareOp(DepthTest test) {
  switch (test) {
    case DepthTest::greater:
      return vk::CompareOp::eGreater;
    case DepthTest::greaterOrEqual:
      return vk::CompareOp::eGreaterOrEqual;
    case DepthTest::equal:
      return vk::CompareOp::eEqual;
    case DepthTest::off:
      break;
  }
  return vk::CompareOp::eAlways;
}

constexpr std::array kDynamicStates{vk::DynamicState::eViewport, vk::DynamicState::eScissor,
                                    vk::DynamicState::eCullMode, vk::DynamicState::eFrontFace};

// All fixed-function state of one pipeline; the create infos point into this object, so it stays where it was made.
struct FixedState {
  explicit FixedState(const GraphicsState& state);
  FixedState(const FixedState&) = delete;
  FixedState& operator=(const FixedState&) = delete;

  std::vector<vk::VertexInputBindingDescription> buffers;
  std::vector<vk::VertexInputAttributeDescription> attributes;
  vk::PipelineVertexInputStateCreateInfo vertexInput;
  vk::PipelineInputAssemblyStateCreateInfo assembly{{}, vk::PrimitiveTopology::eTriangleList};
  vk::PipelineViewportStateCreateInfo viewport{{}, 1, nullptr, 1, nullptr};
  vk::PipelineRasterizationStateCreateInfo rasterization;
  vk::PipelineMultisampleStateCreateInfo multisample;
  vk::PipelineDepthStencilStateCreateInfo depth;
  vk::PipelineColorBlendAttachmentState target;
  vk::PipelineColorBlendStateCreateInfo blend;
  vk::PipelineDynamicStateCreateInfo dynamic{{}, kDynamicStates};
  vk::Format colorFormat = vk::Format::eUndefined;
  vk::PipelineRenderingCreateInfo rendering;

 private:
  void describeVertices(const GraphicsState& state);
  void describeTargets(const GraphicsState& state);
};

FixedState::FixedState(const GraphicsState& state) {
  describeVertices(state);
  rasterization.setPolygonMode(state.polygonMode == PolygonMode::line ? vk::PolygonMode::eLine : vk::PolygonMode::eFill)
      .setDepthBiasEnable(state.depthBiasConstant != 0.0f || state.depthBiasSlope != 0.0f)
      .setDepthBiasConstantFactor(state.depthBiasConstant)
      .setDepthBiasSlopeFactor(state.depthBiasSlope)
      .setLineWidth(1.0f);
  multisample.setRasterizationSamples(sampleFlag(state.samples))
      .setSampleShadingEnable(state.shadePerSample)
      .setMinSampleShading(1.0f);
  // Vulkan writes no depth where the test is off, so a write without a test is a test that always passes.
  depth.setDepthTestEnable(state.depthTarget && (state.depthTest != DepthTest::off || state.depthWrite))
      .setDepthWriteEnable(state.depthTarget && state.depthWrite)
      .setDepthCompareOp(compareOp(state.depthTest));
  describeTargets(state);
}

void FixedState::describeVertices(const GraphicsState& state) {
  for (const VertexBufferLayout& buffer : state.buffers) {
    buffers.emplace_back(static_cast<std::uint32_t>(buffers.size()), buffer.strideBytes);
  }
  for (const VertexAttribute& attribute : state.attributes) {
    CL_CHECK_LT(attribute.buffer, buffers.size());
    attributes.emplace_back(attribute.location, attribute.buffer, vertexFormat(attribute.format), attribute.offset);
  }
  vertexInput.setVertexBindingDescriptions(buffers).setVertexAttributeDescriptions(attributes);
}

void FixedState::describeTargets(const GraphicsState& state) {
  using Component = vk::ColorComponentFlagBits;
  target.setColorWriteMask(Component::eR | Component::eG | Component::eB | Component::eA);
  if (state.blend == Blend::overPremultiplied) {
    // Porter and Duff 1984, "Compositing Digital Images": "over", colors multiplied by their alpha beforehand.
    target.setBlendEnable(VK_TRUE)
        .setSrcColorBlendFactor(vk::BlendFactor::eOne)
        .setDstColorBlendFactor(vk::BlendFactor::eOneMinusSrcAlpha)
        .setSrcAlphaBlendFactor(vk::BlendFactor::eOne)
        .setDstAlphaBlendFactor(vk::BlendFactor::eOneMinusSrcAlpha);
  }
  if (state.blend == Blend::overPerChannel) {
    target.setBlendEnable(VK_TRUE)
        .setSrcColorBlendFactor(vk::BlendFactor::eOne)
        .setDstColorBlendFactor(vk::BlendFactor::eSrc1Color)
        .setSrcAlphaBlendFactor(vk::BlendFactor::eOne)
        .setDstAlphaBlendFactor(vk::BlendFactor::eSrc1Alpha);
  }
  if (state.colorTarget) {
    CL_CHECK(state.colorFormat == ImageFormat::rgba32f || state.blend == Blend::off);
    colorFormat = formatOf(state.colorFormat);
    blend.setAttachments(target);
    rendering.setColorAttachmentFormats(colorFormat);
  }
  if (state.depthTarget) rendering.setDepthAttachmentFormat(formatOf(ImageFormat::depth32f));
}

vk::raii::Pipeline makeGraphics(const PipelineImpl& impl, const GraphicsState& state, PipelineMaking& making) {
  const DeviceImpl& device = *impl.device;
  const Specialization specialization(state.constants);
  const vk::raii::ShaderModule vertex = moduleOf(device, state.vertex, state.constants, making);
  std::vector<vk::PipelineShaderStageCreateInfo> stages{
      stageInfo(vk::ShaderStageFlagBits::eVertex, vertex, specialization)};
  vk::raii::ShaderModule fragment{nullptr};
  if (!state.fragment.words.empty()) {
    fragment = moduleOf(device, state.fragment, state.constants, making, state.shadePerSample);
    stages.push_back(stageInfo(vk::ShaderStageFlagBits::eFragment, fragment, specialization));
  }
  const FixedState fixed(state);
  const auto info = vk::GraphicsPipelineCreateInfo()
                        .setPNext(&fixed.rendering)
                        .setStages(stages)
                        .setPVertexInputState(&fixed.vertexInput)
                        .setPInputAssemblyState(&fixed.assembly)
                        .setPViewportState(&fixed.viewport)
                        .setPRasterizationState(&fixed.rasterization)
                        .setPMultisampleState(&fixed.multisample)
                        .setPDepthStencilState(&fixed.depth)
                        .setPColorBlendState(&fixed.blend)
                        .setPDynamicState(&fixed.dynamic)
                        .setLayout(*impl.layout->pipeline);
  return {device.device, device.pipelineCache, info};
}

vk::raii::Pipeline makeCompute(const PipelineImpl& impl, ShaderCode code, const Constants& constants,
                               PipelineMaking& making) {
  const DeviceImpl& device = *impl.device;
  const Specialization specialization(constants);
  const vk::raii::ShaderModule module = moduleOf(device, code, constants, making);
  const vk::ComputePipelineCreateInfo info({}, stageInfo(vk::ShaderStageFlagBits::eCompute, module, specialization),
                                           *impl.layout->pipeline);
  return {device.device, device.pipelineCache, info};
}

// Adds what was made, and how long it took, to the device's list.
class Making {
 public:
  Making(DeviceImpl& device, std::string name) : device_(device) { record_.name = std::move(name); }
  Making(const Making&) = delete;
  Making& operator=(const Making&) = delete;
  ~Making() {
    record_.wallMs = watch_.elapsedMs();
    const std::scoped_lock lock(device_.makings.mutex);
    device_.makings.list.push_back(std::move(record_));
  }
  PipelineMaking& record() { return record_; }

 private:
  DeviceImpl& device_;
  const Stopwatch watch_;
  PipelineMaking record_;
};

// Everything that a pipeline is made of, in words: equal keys, equal pipelines. Names stand for code that is compiled
// in.
std::string keyOf(const BindingLayoutImpl& layout, const Constants& constants) {
  std::string key = fmt::format("push {}", layout.pushBytes);
  for (const Binding& b : layout.bindings) key += fmt::format(" b{}:{}", b.slot, static_cast<int>(b.type));
  for (const Constant& c : constants) key += fmt::format(" c{}={}", c.id, c.bits);
  return key;
}

std::string keyOf(const ShaderCode& code) {
  return fmt::format(" {}@{}", code.name, static_cast<const void*>(code.words.data()));
}

std::string keyOf(const BindingLayoutImpl& layout, const GraphicsState& s) {
  std::string key = keyOf(layout, s.constants) + keyOf(s.vertex) + keyOf(s.fragment);
  for (const VertexBufferLayout& buffer : s.buffers) key += fmt::format(" v{}", buffer.strideBytes);
  for (const VertexAttribute& a : s.attributes) {
    key += fmt::format(" a{}:{}:{}:{}", a.location, a.buffer, a.offset, static_cast<int>(a.format));
  }
  return key + fmt::format(" {:d}:{}{:d} {}{:d} {} {:d} {} {} {:a} {:a}", s.colorTarget,
                           static_cast<int>(s.colorFormat), s.depthTarget, s.samples, s.shadePerSample,
                           static_cast<int>(s.depthTest), s.depthWrite, static_cast<int>(s.blend),
                           static_cast<int>(s.polygonMode), s.depthBiasConstant, s.depthBiasSlope);
}

}  // namespace

ComputePipeline::ComputePipeline(const Device& device, const BindingLayout& layout, ShaderCode code,
                                 const Constants& constants)
    : impl_(new PipelineImpl{&device.impl(), layout.shared(), vk::PipelineBindPoint::eCompute}) {
  impl_->key = keyOf(*impl_->layout, constants) + keyOf(code);
  impl_->pipeline = impl_->device->pipelines.take(impl_->key);
  if (*impl_->pipeline) return;
  guarded(fmt::format("making the pipeline of {}", code.name), [&] {
    Making making(*impl_->device, std::string(code.name));
    impl_->pipeline = makeCompute(*impl_, code, constants, making.record());
    nameObject(*impl_->device, impl_->pipeline, std::string(code.name));
  });
  throwOnMessages(*impl_->device);
}

GraphicsPipeline::GraphicsPipeline(const Device& device, const BindingLayout& layout, const GraphicsState& state)
    : impl_(new PipelineImpl{&device.impl(), layout.shared(), vk::PipelineBindPoint::eGraphics}) {
  impl_->drawsColor = state.colorTarget;
  impl_->colorFormat = state.colorFormat;
  impl_->drawsDepth = state.depthTarget;
  impl_->samples = state.samples;
  const std::string name = fmt::format("{} {}", state.vertex.name, state.fragment.name);
  checkSamples(*impl_->device, "the pipeline of " + name, state.samples);
  impl_->key = keyOf(*impl_->layout, state);
  impl_->pipeline = impl_->device->pipelines.take(impl_->key);
  if (*impl_->pipeline) return;
  guarded("making the pipeline of " + name, [&] {
    Making making(*impl_->device, name);
    impl_->pipeline = makeGraphics(*impl_, state, making.record());
    nameObject(*impl_->device, impl_->pipeline, name);
  });
  throwOnMessages(*impl_->device);
}

template struct Release<PipelineImpl>;

}  // namespace crosslight::gpu

// Shader programs with their specialization constants, and the bindings that they read.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/box_search.h"
#include "gpu/memory.h"

namespace crosslight::gpu {

// SPIR-V that was compiled into the program at build time, by file name ("phong.frag"). InternalError when unknown.
struct ShaderCode {
  std::string_view name;
  std::span<const std::uint32_t> words;
};
ShaderCode embeddedShader(std::string_view fileName);
std::span<const ShaderCode> embeddedShaders();

// 32-bit specialization constants: (constant id, bits). Ids that a shader does not have are ignored by Vulkan.
struct Constant {
  std::uint32_t id;
  std::uint32_t bits;
};
using Constants = std::vector<Constant>;

// A uniformWindow shows the shaders one record of a buffer of many; which, is said when the set is bound.
enum class BindingType {
  storageBuffer,
  uniformBuffer,
  texelBufferFloat4,
  texelBufferUint4,
  texelBufferUint1,
  uniformWindow,
  boxSearch
};
struct Binding {
  std::uint32_t slot;
  BindingType type;
};

struct BindingLayoutImpl;
// Descriptor set 0 of a family of shaders, visible to all stages, and the size of its push constants (<= 128 bytes).
class BindingLayout {
 public:
  BindingLayout() = default;
  BindingLayout(const Device& device, std::vector<Binding> bindings, std::uint32_t pushConstantBytes);
  BindingLayoutImpl& impl() const { return *impl_; }
  const std::shared_ptr<BindingLayoutImpl>& shared() const { return impl_; }

 private:
  std::shared_ptr<BindingLayoutImpl> impl_;  // sets and pipelines keep it alive
};

struct BindingSetImpl;
// Buffers bound to the slots of a layout. Every slot must be set before use (checked at bind); the buffers must
// outlive the set. Buffers are bound whole; texels are R32G32B32A32_SFLOAT, R32G32B32A32_UINT or R32_UINT.
class BindingSet {
 public:
  BindingSet() = default;
  BindingSet(const Device& device, const BindingLayout& layout);
  void set(std::uint32_t slot, const Buffer& buffer);
  void setWindow(std::uint32_t slot, const Buffer& buffer, std::uint64_t windowBytes);  // a uniformWindow
  void set(std::uint32_t slot, const BoxSearch& search);
  BindingSetImpl& impl() const { return *impl_; }

 private:
  void setPart(std::uint32_t slot, const Buffer& buffer, std::uint64_t bytes, bool isWindow);
  Owned<BindingSetImpl> impl_;
};

struct PipelineImpl;
class ComputePipeline {
 public:
  ComputePipeline() = default;
  ComputePipeline(const Device& device, const BindingLayout& layout, ShaderCode code, const Constants& constants);
  explicit operator bool() const { return impl_ != nullptr; }
  PipelineImpl& impl() const { return *impl_; }

 private:
  Owned<PipelineImpl> impl_;
};

enum class VertexFormat { float1, float2, float3, float4, uint1 };
struct VertexAttribute {
  std::uint32_t location, buffer, offset;
  VertexFormat format;
};
struct VertexBufferLayout {
  std::uint32_t strideBytes;
};

enum class DepthTest { off, greater, greaterOrEqual, equal };  // reversed Z: nearer is greater
// src + (1 - src.a) * dst; src + src1 * dst, src1 being the shader's second output (DeviceInfo::canBlendPerChannel)
enum class Blend { off, overPremultiplied, overPerChannel };
enum class PolygonMode { fill, line };

struct GraphicsState {
  ShaderCode vertex;
  ShaderCode fragment;  // no words: depth only
  Constants constants;  // both stages
  std::vector<VertexBufferLayout> buffers;
  std::vector<VertexAttribute> attributes;
  bool colorTarget = true;                         // one, or none
  ImageFormat colorFormat = ImageFormat::rgba32f;  // r32ui cannot blend
  bool depthTarget = true;                         // D32F
  std::uint32_t samples = 1;
  bool shadePerSample = false;  // fragments run once per sample, where it lies, instead of once per pixel
  DepthTest depthTest = DepthTest::greater;
  bool depthWrite = true;
  Blend blend = Blend::off;
  PolygonMode polygonMode = PolygonMode::fill;
  float depthBiasConstant = 0.0f;
  float depthBiasSlope = 0.0f;
};

// Triangle lists; culling and front face are dynamic state (Commands::cull).
class GraphicsPipeline {
 public:
  GraphicsPipeline() = default;
  GraphicsPipeline(const Device& device, const BindingLayout& layout, const GraphicsState& state);
  explicit operator bool() const { return impl_ != nullptr; }
  PipelineImpl& impl() const { return *impl_; }

 private:
  Owned<PipelineImpl> impl_;
};

}  // namespace crosslight::gpu

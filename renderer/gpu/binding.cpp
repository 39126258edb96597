// Descriptor set layouts and sets.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/check.h"
#include "base/error.h"
#include "gpu/impl.h"

namespace crosslight::gpu {
namespace {

constexpr std::uint32_t kMaxPushBytes = 128;  // what every Vulkan device offers

vk::DescriptorType descriptorType(BindingType type) {
  switch (type) {
    case BindingType::storageBuffer:
      return vk::DescriptorType::eStorageBuffer;
    case BindingType::uniformBuffer:
      return vk::DescriptorType::eUniformBuffer;
    case BindingType::uniformWindow:
      return vk::DescriptorType::eUniformBufferDynamic;
    case BindingType::boxSearch:
      return vk::DescriptorType::eAccelerationStructureKHR;
    default:
      return vk::DescriptorType::eUniformTexelBuffer;
  }
}

bool isTexelBuffer(BindingType type) { return descriptorType(type) == vk::DescriptorType::eUniformTexelBuffer; }

std::uint32_t useOf(BindingType type) {
  if (type == BindingType::boxSearch) return 0;  // no buffer
  if (type == BindingType::storageBuffer) return useStorage;
  if (type == BindingType::uniformWindow) return useUniformWindows;
  return type == BindingType::uniformBuffer ? useUniform : useUniformTexel;
}

// Every binding is visible to every stage, so each counts against the limits per stage.
void checkLimits(const DeviceImpl& device, const std::vector<Binding>& bindings) {
  const auto check = [&](vk::DescriptorType type, std::uint32_t most, const char* rule) {
    const auto count = std::count_if(bindings.begin(), bindings.end(),
                                     [&](const Binding& binding) { return descriptorType(binding.type) == type; });
    if (count <= std::int64_t{most}) return;
    throw DeviceError(fmt::format("the shaders read {} buffers of one kind, the limit of {} is {} ({})", count,
                                  device.info.name, most, rule));
  };
  const vk::PhysicalDeviceLimits& limits = device.limits;
  check(vk::DescriptorType::eStorageBuffer, limits.maxPerStageDescriptorStorageBuffers,
        "maxPerStageDescriptorStorageBuffers");
  check(vk::DescriptorType::eUniformBuffer, limits.maxPerStageDescriptorUniformBuffers,
        "maxPerStageDescriptorUniformBuffers");
  check(vk::DescriptorType::eUniformTexelBuffer, limits.maxPerStageDescriptorSampledImages,
        "maxPerStageDescriptorSampledImages");
}

void fillLayout(BindingLayoutImpl& layout) {
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  for (const Binding& binding : layout.bindings) {
    bindings.emplace_back(binding.slot, descriptorType(binding.type), 1, kAllStages);
  }
  const vk::raii::Device& device = layout.device->device;
  layout.set = vk::raii::DescriptorSetLayout(device, vk::DescriptorSetLayoutCreateInfo({}, bindings));
  const vk::PushConstantRange push(kAllStages, 0, layout.pushBytes);
  auto info = vk::PipelineLayoutCreateInfo().setSetLayouts(*layout.set);
  if (layout.pushBytes > 0) info.setPushConstantRanges(push);
  layout.pipeline = vk::raii::PipelineLayout(device, info);
}

void fillSet(BindingSetImpl& set) {
  std::vector<vk::DescriptorPoolSize> sizes;
  for (const Binding& binding : set.layout->bindings) sizes.emplace_back(descriptorType(binding.type), 1);
  if (sizes.empty()) sizes.emplace_back(vk::DescriptorType::eStorageBuffer, 1);  // a pool may not be of nothing
  const vk::raii::Device& device = set.device->device;
  set.pool = vk::raii::DescriptorPool(device, vk::DescriptorPoolCreateInfo({}, 1, sizes));
  const vk::DescriptorSetAllocateInfo info(*set.pool, *set.layout->set);
  set.set = (*device).allocateDescriptorSets(info, *device.getDispatcher()).front();
  for (std::size_t i = 0; i < set.layout->bindings.size(); ++i) set.views.emplace_back(nullptr);
  set.isSet.assign(set.layout->bindings.size(), false);
}

vk::Format texelFormat(BindingType type) {
  if (type == BindingType::texelBufferUint1) return vk::Format::eR32Uint;
  return type == BindingType::texelBufferFloat4 ? vk::Format::eR32G32B32A32Sfloat : vk::Format::eR32G32B32A32Uint;
}

// Buffers of 16-byte texels were checked against maxTexelBufferElements when they were made.
vk::raii::BufferView texelView(const BufferImpl& buffer, BindingType type) {
  const vk::Format format = texelFormat(type);
  if (type == BindingType::texelBufferUint1)
    CL_CHECK_LE(buffer.capacityBytes / 4, std::uint64_t{buffer.device->info.maxTexelBufferElements});
  return {buffer.device->device, vk::BufferViewCreateInfo({}, *buffer.buffer, format, 0, buffer.capacityBytes)};
}

std::size_t positionOf(const BindingLayoutImpl& layout, std::uint32_t slot) {
  for (std::size_t i = 0; i < layout.bindings.size(); ++i) {
    if (layout.bindings[i].slot == slot) return i;
  }
  throw InternalError(fmt::format("broken invariant: binding slot {} is not in the layout", slot));
}

}  // namespace

BindingLayout::BindingLayout(const Device& device, std::vector<Binding> bindings, std::uint32_t pushConstantBytes)
    : impl_(new BindingLayoutImpl{&device.impl(), std::move(bindings), pushConstantBytes},
            Release<BindingLayoutImpl>{}) {
  CL_CHECK_LE(pushConstantBytes, kMaxPushBytes);
  CL_CHECK_EQ(pushConstantBytes % 4, 0u);
  checkLimits(*impl_->device, impl_->bindings);
  guarded("making a binding layout", [&] { fillLayout(*impl_); });
}

BindingSet::BindingSet(const Device& device, const BindingLayout& layout)
    : impl_(new BindingSetImpl{&device.impl(), layout.shared()}) {
  guarded("making a binding set", [&] { fillSet(*impl_); });
}

void BindingSet::set(std::uint32_t slot, const Buffer& buffer) { setPart(slot, buffer, buffer.sizeBytes(), false); }

void BindingSet::setWindow(std::uint32_t slot, const Buffer& buffer, std::uint64_t windowBytes) {
  CL_CHECK_LE(windowBytes, std::uint64_t{impl_->device->limits.maxUniformBufferRange});
  CL_CHECK_LE(windowBytes, buffer.sizeBytes());
  setPart(slot, buffer, windowBytes, true);
}

void BindingSet::set(std::uint32_t slot, const BoxSearch& search) {
  const std::size_t position = positionOf(*impl_->layout, slot);
  CL_CHECK(impl_->layout->bindings[position].type == BindingType::boxSearch);
  const vk::WriteDescriptorSetAccelerationStructureKHR structure(*search.impl().top.structure);
  const auto write = vk::WriteDescriptorSet()
                         .setDstSet(impl_->set)
                         .setDstBinding(slot)
                         .setDescriptorCount(1)
                         .setDescriptorType(vk::DescriptorType::eAccelerationStructureKHR)
                         .setPNext(&structure);
  impl_->device->device.updateDescriptorSets(write, {});
  impl_->isSet[position] = true;
}

void BindingSet::setPart(std::uint32_t slot, const Buffer& buffer, std::uint64_t bytes, bool isWindow) {
  const std::size_t position = positionOf(*impl_->layout, slot);
  const BindingType type = impl_->layout->bindings[position].type;
  CL_CHECK_EQ(type == BindingType::uniformWindow, isWindow);
  const BufferImpl& bound = buffer.impl();
  if ((bound.use & useOf(type)) == 0) {
    throw InternalError(fmt::format("broken invariant: buffer '{}' was not made for the use that binding slot {} has",
                                    bound.name, slot));
  }
  guarded("binding buffer '" + bound.name + "'", [&] {
    // The padding at a buffer's end stays hidden from .length() in shaders.
    const vk::DescriptorBufferInfo range(*bound.buffer, 0, bytes > 0 ? bytes : VK_WHOLE_SIZE);
    auto write =
        vk::WriteDescriptorSet().setDstSet(impl_->set).setDstBinding(slot).setDescriptorType(descriptorType(type));
    vk::BufferView view;
    if (isTexelBuffer(type)) {
      impl_->views[position] = texelView(bound, type);
      view = *impl_->views[position];
      write.setTexelBufferView(view);
    } else {
      write.setBufferInfo(range);
    }
    impl_->device->device.updateDescriptorSets(write, {});
  });
  impl_->isSet[position] = true;
}

template struct Release<BindingLayoutImpl>;
template struct Release<BindingSetImpl>;

}  // namespace crosslight::gpu

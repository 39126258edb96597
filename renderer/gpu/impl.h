// Private to this room: the Vulkan objects behind the public handles, and the helpers that the .cpp files share.
#pragma once

// The loader is linked, not opened by hand: the tool of vulkan.hpp would ask for libvulkan.so of the -dev package
// first. The room's own build has it from CMake, for its precompiled header.
#ifndef VULKAN_HPP_ENABLE_DYNAMIC_LOADER_TOOL
#define VULKAN_HPP_ENABLE_DYNAMIC_LOADER_TOOL 0
#endif
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "gpu/commands.h"

namespace crosslight::gpu {

struct ValidationLog {
  std::mutex mutex;  // the layer may call from any thread of the driver
  std::vector<std::string> messages;
  std::size_t thrown = 0;  // how many of them an exception has carried already
};

struct BindingLayoutImpl;

// Pipelines that nobody holds any more, kept for whoever wants the same again: a driver takes tens of milliseconds to
// make one, and lavapipe as long again at its first use.
class PipelinePool {
 public:
  // The pipeline with this key, or a null one. Keys name everything that a pipeline is made of.
  vk::raii::Pipeline take(const std::string& key);
  // `layout`: of its making. A later user has one of its own, identically defined (Vulkan 1.3, "Pipeline Layout
  // Compatibility").
  void park(std::string key, std::shared_ptr<BindingLayoutImpl> layout, vk::raii::Pipeline pipeline);

 private:
  struct Parked {
    std::string key;
    std::shared_ptr<BindingLayoutImpl> layout;
    vk::raii::Pipeline pipeline;
  };
  std::mutex mutex_;
  std::list<Parked> parked_;  // the latest first
};

struct PipelineMakings {
  std::mutex mutex;
  std::vector<PipelineMaking> list;
};

struct DeviceImpl {
  DeviceInfo info;
  OpenTimes openTimes;
  bool validation = false;
  bool neverMap = false;
  bool abandoned = false;  // a wait timed out: nothing may be destroyed any more
  std::uint64_t allocatedBytes = 0;
  std::uint64_t peakAllocatedBytes = 0;
  std::filesystem::path cacheFile;  // empty: no pipeline cache on disk
  std::uint64_t cacheHash = 0;      // of the driver's blob as it lies on the disk

  std::shared_ptr<ValidationLog> log = std::make_shared<ValidationLog>();
  vk::raii::Context context{vkGetInstanceProcAddr};
  vk::raii::Instance instance{nullptr};
  vk::raii::DebugUtilsMessengerEXT messenger{nullptr};
  vk::raii::PhysicalDevice physical{nullptr};
  vk::PhysicalDeviceLimits limits;
  vk::PhysicalDeviceMemoryProperties memory;
  std::uint64_t maxAllocationBytes = 0;
  std::uint64_t timestampMask = 0;  // valid bits of a timestamp
  std::uint32_t queueFamily = 0;
  vk::raii::Device device{nullptr};
  vk::raii::Queue queue{nullptr};
  std::mutex queueMutex = {};  // kernels are warmed up from threads of their own
  vk::raii::CommandPool transferPool{nullptr};
  vk::raii::PipelineCache pipelineCache{nullptr};
  PipelineMakings makings = {};
  PipelinePool pipelines = {};  // dies before the device
};

// Memory of one resource; counted while it lives.
class Allocation {
 public:
  Allocation() = default;
  Allocation(DeviceImpl& device, vk::raii::DeviceMemory memory, std::uint64_t sizeBytes, std::uint32_t type, bool map);
  Allocation(Allocation&& other) noexcept;
  Allocation& operator=(Allocation&& other) = delete;
  ~Allocation();

  vk::DeviceMemory handle() const { return *memory_; }
  std::uint64_t sizeBytes() const { return sizeBytes_; }
  std::uint32_t type() const { return type_; }
  std::byte* mapped() const { return mapped_; }  // null: only the device reaches it
  bool cached() const { return bool(flags_ & vk::MemoryPropertyFlagBits::eHostCached); }
  void flush() const;       // host writes become visible to the device
  void invalidate() const;  // device writes become visible to the host

 private:
  bool coherent() const { return bool(flags_ & vk::MemoryPropertyFlagBits::eHostCoherent); }
  DeviceImpl* device_ = nullptr;
  vk::raii::DeviceMemory memory_{nullptr};
  std::uint64_t sizeBytes_ = 0;
  std::uint32_t type_ = 0;  // index of the memory type
  vk::MemoryPropertyFlags flags_;
  std::byte* mapped_ = nullptr;
};

// Kinds of memory to try, best first. `largeHeapOnly` keeps big data out of a small window into device memory.
struct MemoryWish {
  vk::MemoryPropertyFlags flags;
  bool largeHeapOnly = false;
};
// `hasAddress`: shaders may ask for the address of what lies in it.
Allocation allocate(DeviceImpl& device, const std::string& what, const vk::MemoryRequirements& needs,
                    std::span<const MemoryWish> wishes, bool hasAddress = false);

struct BufferImpl {
  DeviceImpl* device;
  std::string name;
  std::uint64_t sizeBytes;      // as asked for
  std::uint64_t capacityBytes;  // at least 16 and a multiple of 16, so that float4 texel views hold all of it
  std::uint32_t use;
  Allocation memory;
  vk::raii::Buffer buffer{nullptr};
};

// Boxes by the device's own structure, and what instances it: there is one instance, unmoved.
struct BoxSearchImpl {
  struct Level {
    Buffer memory;
    vk::raii::AccelerationStructureKHR structure{nullptr};
  };
  DeviceImpl* device;
  Level boxes, top;
};

struct ImageImpl {
  DeviceImpl* device;
  std::string name;
  ImageFormat format;
  vk::Extent2D extent;
  std::uint32_t samples;
  bool overBuffer = false;                               // stays in the general layout, in which both agree
  vk::ImageLayout layout = vk::ImageLayout::eUndefined;  // after all work submitted so far
  std::unique_ptr<Allocation> memory = nullptr;
  vk::raii::Image image{nullptr};
  vk::raii::ImageView view{nullptr};
};

struct BindingLayoutImpl {
  DeviceImpl* device;
  std::vector<Binding> bindings;
  std::uint32_t pushBytes;
  vk::raii::DescriptorSetLayout set{nullptr};
  vk::raii::PipelineLayout pipeline{nullptr};
};
// Sets and pipelines share their layout's objects, so they may outlive the BindingLayout.
using SharedLayout = std::shared_ptr<BindingLayoutImpl>;

struct BindingSetImpl {
  DeviceImpl* device;
  SharedLayout layout;
  vk::raii::DescriptorPool pool{nullptr};
  vk::DescriptorSet set = {};                    // freed with the pool
  std::vector<vk::raii::BufferView> views = {};  // one per binding, null unless it is a texel buffer
  std::vector<bool> isSet = {};                  // one per binding
};

struct PipelineImpl {
  DeviceImpl* device;
  SharedLayout layout;
  vk::PipelineBindPoint point;
  bool drawsColor = false, drawsDepth = false;
  ImageFormat colorFormat = ImageFormat::rgba32f;
  std::uint32_t samples = 1;
  std::string key = {};  // what it is made of, in words
  vk::raii::Pipeline pipeline{nullptr};

  ~PipelineImpl() {
    if (*pipeline) device->pipelines.park(std::move(key), std::move(layout), std::move(pipeline));
  }
};

inline constexpr vk::ShaderStageFlags kAllStages =
    vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment | vk::ShaderStageFlagBits::eCompute;

vk::Format formatOf(ImageFormat format);
std::uint32_t pixelBytesOf(ImageFormat format);
vk::SampleCountFlagBits sampleFlag(std::uint32_t samples);
void checkSamples(const DeviceImpl& device, const std::string& what, std::uint32_t samples);  // DeviceError

// Broken invariants of the caller, as InternalError.
void checkRange(const BufferImpl& buffer, std::uint64_t offset, std::uint64_t bytes);
void checkUse(const BufferImpl& buffer, std::uint32_t use);

// Names an object in validation messages; nothing without validation.
void nameObject(const DeviceImpl& device, vk::ObjectType type, std::uint64_t handle, const std::string& name);
template <class Handle>
void nameObject(const DeviceImpl& device, const Handle& handle, const std::string& name) {
  nameObject(device, Handle::objectType, reinterpret_cast<std::uint64_t>(static_cast<typename Handle::CType>(*handle)),
             name);
}

// Everything before is finished and visible, to the host too, for everything after.
void fullBarrier(const vk::raii::CommandBuffer& commands);
void submit(DeviceImpl& device, vk::CommandBuffer commands, vk::Fence fence);
// Submits and waits; see Commands::submitAndWait.
void submitAndWait(DeviceImpl& device, vk::CommandBuffer commands, vk::Fence fence, double timeoutSeconds,
                   std::string_view what);
// Records a few commands, runs them and waits.
void runOnce(DeviceImpl& device, std::string_view what,
             const std::function<void(const vk::raii::CommandBuffer&)>& record);
void throwOnMessages(const DeviceImpl& device);

// Reads the file, if it is whole, into the device's pipeline cache, and has savePipelineCache write there.
void attachPipelineCache(DeviceImpl& device, const std::filesystem::path& file);

// Turns the exception of Vulkan-Hpp that is in flight into one of the project's.
[[noreturn]] void rethrowVulkanError(std::string_view what);
template <class Work>
decltype(auto) guarded(std::string_view what, Work&& work) {
  try {
    return work();
  } catch (const vk::SystemError&) {
    rethrowVulkanError(what);
  }
}

void abandon(void* impl) noexcept;  // keeps it reachable for the rest of the process
template <class Impl>
void Release<Impl>::operator()(Impl* impl) const noexcept {
  if (impl->device->abandoned) {
    abandon(impl);
  } else {
    delete impl;
  }
}
}  // namespace crosslight::gpu

// What the files of this room share: translation of errors, submission, names, and the graveyard.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "base/check.h"
#include "base/error.h"
#include "gpu/impl.h"

namespace crosslight::gpu {

void rethrowVulkanError(std::string_view what) {
  try {
    throw;
  } catch (const vk::DeviceLostError&) {
    throw InternalError(fmt::format("the device was lost while {}; its driver may have reset it", what));
  } catch (const vk::OutOfDeviceMemoryError&) {
    throw DeviceError(fmt::format("the device ran out of memory while {}", what));
  } catch (const vk::OutOfHostMemoryError&) {
    throw DeviceError(fmt::format("the host ran out of memory while {}", what));
  } catch (const vk::SystemError& error) {
    throw InternalError(fmt::format("{} failed: {}", what, error.what()));
  }
}

void checkRange(const BufferImpl& buffer, std::uint64_t offset, std::uint64_t bytes) {
  CL_CHECK_LE(offset, buffer.sizeBytes);
  CL_CHECK_LE(bytes, buffer.sizeBytes - offset);
}

void checkUse(const BufferImpl& buffer, std::uint32_t use) {
  if ((buffer.use & use) != 0) return;
  throw InternalError(fmt::format("broken invariant: buffer '{}' was not made for this use", buffer.name));
}

void abandon(void* impl) noexcept {
  // Never freed, and reachable, so that it does not count as a leak.
  static auto* graveyard = new std::vector<void*>;
  graveyard->push_back(impl);
}

void nameObject(const DeviceImpl& device, vk::ObjectType type, std::uint64_t handle, const std::string& name) {
  if (!device.validation) return;
  device.device.setDebugUtilsObjectNameEXT(
      vk::DebugUtilsObjectNameInfoEXT().setObjectType(type).setObjectHandle(handle).setPObjectName(name.c_str()));
}

void throwOnMessages(const DeviceImpl& device) {
  ValidationLog& log = *device.log;
  const std::scoped_lock lock(log.mutex);
  if (log.messages.empty()) return;
  log.thrown = log.messages.size();
  std::string text = fmt::format("{} validation message(s)", log.messages.size());
  for (const std::string& message : log.messages) text += "\n  " + message;
  throw InternalError(text);
}

void fullBarrier(const vk::raii::CommandBuffer& commands) {
  using Stage = vk::PipelineStageFlagBits2;
  using Access = vk::AccessFlagBits2;
  const vk::MemoryBarrier2 barrier(Stage::eAllCommands, Access::eMemoryRead | Access::eMemoryWrite,
                                   Stage::eAllCommands | Stage::eHost, Access::eMemoryRead | Access::eMemoryWrite);
  commands.pipelineBarrier2(vk::DependencyInfo().setMemoryBarriers(barrier));
}

void submit(DeviceImpl& device, vk::CommandBuffer commands, vk::Fence fence) {
  const std::scoped_lock lock(device.queueMutex);
  const vk::CommandBufferSubmitInfo buffer(commands);
  device.queue.submit2(vk::SubmitInfo2().setCommandBufferInfos(buffer), fence);
}

void submitAndWait(DeviceImpl& device, vk::CommandBuffer commands, vk::Fence fence, double timeoutSeconds,
                   std::string_view what) {
  if (device.abandoned) throw InternalError("the device " + device.info.name + " hangs since an earlier wait");
  device.device.resetFences(fence);
  submit(device, commands, fence);
  // Beyond 2^62 ns (146 years) there is no difference, and the conversion stays defined.
  const double timeoutNs = std::clamp(timeoutSeconds * 1e9, 0.0, 0x1p62);
  if (device.device.waitForFences(fence, VK_TRUE, static_cast<std::uint64_t>(timeoutNs)) == vk::Result::eTimeout) {
    device.abandoned = true;
    throw InternalError(fmt::format("{}: the device {} did not finish within {} s; it may hang", what, device.info.name,
                                    timeoutSeconds));
  }
}

void runOnce(DeviceImpl& device, std::string_view what,
             const std::function<void(const vk::raii::CommandBuffer&)>& record) {
  // Data moves at 1 GB/s or more, and pieces are at most 64 MiB: a minute means that the device hangs.
  constexpr double kTimeoutSeconds = 60.0;
  struct Job {
    DeviceImpl* device;
    vk::raii::CommandBuffer commands{nullptr};
    vk::raii::Fence fence{nullptr};
  };
  guarded(what, [&] {
    std::unique_ptr<Job, Release<Job>> job(new Job{&device});
    const vk::CommandBufferAllocateInfo info(*device.transferPool, vk::CommandBufferLevel::ePrimary, 1);
    job->commands = std::move(device.device.allocateCommandBuffers(info).front());
    job->fence = vk::raii::Fence(device.device, vk::FenceCreateInfo());
    job->commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    fullBarrier(job->commands);
    record(job->commands);
    fullBarrier(job->commands);
    job->commands.end();
    submitAndWait(device, *job->commands, *job->fence, kTimeoutSeconds, what);
  });
  throwOnMessages(device);
}

}  // namespace crosslight::gpu

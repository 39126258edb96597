#include <fmt/format.h>

#include <malloc.h>
#include <utility>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <string_view>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/time.h"
#include "gpu/cache_file.h"
#include "gpu/instance.h"
#include "gpu/physical_device.h"
#include "gpu/selection.h"

namespace crosslight::gpu {
namespace {

std::atomic<std::uint64_t> lateMessages{0};

bool environmentWantsValidation() {
  const char* value = std::getenv("CROSSLIGHT_VALIDATION");
  return value != nullptr && std::string_view(value) == "1";
}

std::vector<DeviceReport> reportsOf(const std::vector<Candidate>& candidates) {
  std::vector<DeviceReport> reports;
  for (const Candidate& candidate : candidates) reports.push_back(candidate.report);
  return reports;
}

void createDevice(DeviceImpl& device) {
  const float priority = 1.0f;
  const auto queue = vk::DeviceQueueCreateInfo().setQueueFamilyIndex(device.queueFamily).setQueuePriorities(priority);
  FeatureChain features = wantedFeatures(device.info);
  const std::vector<const char*> extensions = wantedExtensions(device.info);
  const auto info = vk::DeviceCreateInfo()
                        .setQueueCreateInfos(queue)
                        .setPEnabledExtensionNames(extensions)
                        .setPNext(&features.get<vk::PhysicalDeviceFeatures2>());
  device.device = vk::raii::Device(device.physical, info);
  device.queue = vk::raii::Queue(device.device, device.queueFamily, 0);
  device.transferPool = vk::raii::CommandPool(
      device.device, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient, device.queueFamily));
}

void readLimits(DeviceImpl& device) {
  const auto chain =
      device.physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceMaintenance3Properties>();
  device.limits = chain.get<vk::PhysicalDeviceProperties2>().properties.limits;
  device.maxAllocationBytes = chain.get<vk::PhysicalDeviceMaintenance3Properties>().maxMemoryAllocationSize;
  device.memory = device.physical.getMemoryProperties();
}

std::filesystem::path cacheFileOf(const DeviceImpl& device) {
  const std::filesystem::path folder = cacheFolder();
  if (folder.empty()) return {};
  const auto properties = device.physical.getProperties();
  std::string uuid;
  for (const std::uint8_t byte : properties.pipelineCacheUUID) uuid += fmt::format("{:02x}", byte);
  return folder / fmt::format("pipelines-{:x}-{:x}-{:x}-{}.bin", properties.vendorID, properties.deviceID,
                              properties.driverVersion, uuid);
}

void savePipelineCacheOf(DeviceImpl& device) noexcept {
  if (device.cacheFile.empty()) return;
  try {
    const std::vector<std::uint8_t> data = device.pipelineCache.getData();
    const auto blob = std::as_bytes(std::span(data));
    const std::uint64_t hash = hashBytes(blob);
    if (hash != device.cacheHash && saveCache(device.cacheFile, blob)) device.cacheHash = hash;
  } catch (const std::exception& trouble) {
    logVerbose(std::string("the pipeline cache is not written: ") + trouble.what());
  }
}

// llvmpipe takes the memory of a frame's vertices and triangles from malloc and frees it with the frame. glibc would
// give it back to the system each time, and the next frame would pay a page fault per page (a quarter of the time of
// 100,000 triangles). The process keeps up to 256 MiB for it.
void keepFreedMemory() {
#ifdef __GLIBC__
  constexpr int kMapAtBytes = 32 << 20, kKeepBytes = 256 << 20;
  mallopt(M_MMAP_THRESHOLD, kMapAtBytes);
  mallopt(M_TRIM_THRESHOLD, kKeepBytes);
#endif
}

void openDevice(DeviceImpl& device, const DeviceOptions& options) {
  Stopwatch watch;
  std::vector<Candidate> candidates;
  if (createInstance(device)) candidates = candidatesOf(device.instance);
  device.openTimes.instanceMs = watch.lapMs();
  const std::size_t chosen = chooseDevice(reportsOf(candidates), options.selector);
  Candidate& candidate = candidates[chosen];
  device.info = candidate.report.info;
  device.physical = std::move(candidate.physical);
  device.queueFamily = candidate.queueFamily;
  device.timestampMask =
      candidate.timestampBits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << candidate.timestampBits) - 1;
  if (device.info.isSoftware) keepFreedMemory();
  readLimits(device);
  createDevice(device);
  // lavapipe's pipeline cache is a stub that stores nothing, and Mesa keeps a shader cache of its own: no file for it.
  const bool onDisk = options.usePipelineCache && !device.info.isSoftware;
  attachPipelineCache(device, onDisk ? cacheFileOf(device) : std::filesystem::path());
  device.openTimes.deviceMs = watch.lapMs();
}

}  // namespace

void attachPipelineCache(DeviceImpl& device, const std::filesystem::path& file) {
  device.cacheFile = file;
  const auto blob = file.empty() ? std::nullopt : loadCache(file);
  vk::PipelineCacheCreateInfo info;
  if (blob) {
    info.setInitialDataSize(blob->size()).setPInitialData(blob->data());
    device.cacheHash = hashBytes(*blob);
  }
  device.pipelineCache = vk::raii::PipelineCache(device.device, info);
}

std::vector<DeviceReport> listDevices() {
  DeviceImpl device;
  return guarded("listing the Vulkan devices", [&] {
    return createInstance(device) ? reportsOf(candidatesOf(device.instance)) : std::vector<DeviceReport>();
  });
}

std::uint64_t lateValidationMessages() { return lateMessages; }

Device Device::open(const DeviceOptions& options) {
  Owned<DeviceImpl> impl(new DeviceImpl);
  impl->validation = options.validation || environmentWantsValidation();
  impl->neverMap = options.neverMap;
  guarded("opening the Vulkan device", [&] { openDevice(*impl, options); });
  throwOnMessages(*impl);
  return Device(std::move(impl));
}

const DeviceInfo& Device::info() const { return impl_->info; }
const OpenTimes& Device::openTimes() const { return impl_->openTimes; }
bool Device::validationOn() const { return impl_->validation; }
void Device::throwOnValidationMessages() const { throwOnMessages(*impl_); }
void Device::savePipelineCache() { savePipelineCacheOf(*impl_); }
std::vector<PipelineMaking> Device::takePipelineMakings() {
  const std::scoped_lock lock(impl_->makings.mutex);
  return std::exchange(impl_->makings.list, {});
}

std::uint64_t Device::allocatedBytes() const { return impl_->allocatedBytes; }
std::uint64_t Device::peakAllocatedBytes() const { return impl_->peakAllocatedBytes; }

template <>
void Release<DeviceImpl>::operator()(DeviceImpl* impl) const noexcept {
  if (impl->abandoned) {
    abandon(impl);
    return;
  }
  savePipelineCacheOf(*impl);
  const std::shared_ptr<ValidationLog> log = impl->log;
  delete impl;  // the layer tells about objects that were not destroyed only now
  for (std::size_t i = log->thrown; i < log->messages.size(); ++i) {
    ++lateMessages;
    logError("validation: " + log->messages[i]);
  }
}

}  // namespace crosslight::gpu

// Vulkan devices: which there are, which can be used and why not, and the one that is open. No scene or lighting word
// here; no Vulkan type leaves this room.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace crosslight::gpu {

struct DeviceInfo {
  std::uint32_t index = 0;
  std::string name;
  std::string type;        // "discrete", "integrated", "virtual", "cpu", "other"
  std::string driverName;  // e.g. "llvmpipe"
  std::string driverInfo;  // e.g. "Mesa 22.3.6 (LLVM 15.0.6)"
  std::string apiVersion;  // "1.3.230"
  bool isSoftware = false;
  std::uint32_t subgroupSize = 0;
  bool hasFloat64 = false;
  bool hasSampleShading = false;    // GraphicsState::shadePerSample; fragments may ask which sample they are of
  bool canBlendPerChannel = false;  // Blend::overPerChannel
  float timestampPeriodNs = 0;      // 0: no timestamps
  std::uint64_t maxStorageBufferBytes = 0;
  std::uint64_t maxTexelBufferElements = 0;
  std::uint32_t uniformWindowAlignment = 0;  // of the offsets of uniform windows, bytes
  std::uint32_t maxImageSize = 0;            // of a 2D color attachment
  std::uint32_t maxWorkGroupCountX = 0;
  // Passes through all loops together, nested ones included, after which a shader invocation is cut short without a
  // word; 0: no such limit. Vulkan has no such limit, llvmpipe has.
  std::uint32_t maxLoopPasses = 0;
  std::uint64_t deviceLocalBytes = 0;
  // What the device lacks to search boxes itself (BoxSearch, ray queries in compute shaders); empty: it can.
  std::string rayQueryLacks = "Vulkan 1.3";
  std::vector<std::uint32_t> msaaCounts;  // of RGBA32F color and D32F depth together, ascending, 1 included
};

struct DeviceReport {
  DeviceInfo info;
  std::vector<std::string> refusals;  // empty: usable. Each says what is missing.
  bool usable() const { return refusals.empty(); }
};

struct DeviceOptions {
  std::string selector;          // "", an index, "lavapipe", or part of a device's name (any case)
  bool validation = false;       // the Khronos layer with synchronization validation; its absence is a DeviceError
  bool usePipelineCache = true;  // on disk, in cacheFolder()
  bool neverMap = false;         // every upload through a staging copy, as on a device with private memory (for tests)
};

// A pipeline that was made, not taken from the pool of this process.
struct PipelineMaking {
  std::string name;              // of its shaders
  std::uint64_t bytes = 0;       // of SPIR-V that the driver got, constants put in
  std::uint64_t wholeBytes = 0;  // as it lies in the program
  double wallMs = 0;             // until the driver had made it; a software driver goes on compiling at the first use
};

// What open() cost.
struct OpenTimes {
  double instanceMs = 0;
  double deviceMs = 0;
};

// Every Vulkan device with its verdict; empty when there is no driver at all.
std::vector<DeviceReport> listDevices();

// Validation messages that came too late to be thrown (while a device closed). They are logged as errors; a program
// that finds this above 0 at its end has failed.
std::uint64_t lateValidationMessages();

// Destroys what a handle owns; after a wait that timed out it is left alone, since the device may still use it.
template <class Impl>
struct Release {
  void operator()(Impl* impl) const noexcept;
};
template <class Impl>
using Owned = std::unique_ptr<Impl, Release<Impl>>;

struct DeviceImpl;
template <>
void Release<DeviceImpl>::operator()(DeviceImpl* impl) const noexcept;

// An open device with one queue. Everything made from it must die before it.
class Device {
 public:
  // Best usable device: discrete, integrated, virtual, then software; DeviceError lists all refusals. With
  // CROSSLIGHT_VALIDATION=1 in the environment validation is on whatever the options say.
  static Device open(const DeviceOptions& options = {});

  const DeviceInfo& info() const;
  const OpenTimes& openTimes() const;
  bool validationOn() const;
  // Validation messages so far. InternalError when there are any: every submit checks.
  void throwOnValidationMessages() const;
  // Writes the pipeline cache back (atomically, never fails the run). Called by the destructor too.
  void savePipelineCache();
  std::vector<PipelineMaking> takePipelineMakings();  // since the last time, or open()
  std::uint64_t allocatedBytes() const;               // now
  std::uint64_t peakAllocatedBytes() const;           // most so far

  DeviceImpl& impl() const { return *impl_; }

 private:
  explicit Device(Owned<DeviceImpl> impl) : impl_(std::move(impl)) {}
  Owned<DeviceImpl> impl_;
};

}  // namespace crosslight::gpu

#include "gpu/physical_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace crosslight::gpu {
namespace {

// A feature this renderer cannot do without. The two shader features at the end are what SPIR-V 1.6 makes of `discard`,
// maintenance4 what it makes of a work group size from specialization constants.
#define CL_CORE_FEATURES(X)                                        \
  X(fillModeNonSolid, "draws wireframes")                          \
  X(fragmentStoresAndAtomics, "writes AOVs from fragment shaders") \
  X(geometryShader, "reads gl_PrimitiveID in fragment shaders")
#define CL_VULKAN12_FEATURES(X)                                   \
  X(scalarBlockLayout, "shares structs between host and shaders") \
  X(hostQueryReset, "times spans")
#define CL_VULKAN13_FEATURES(X)                            \
  X(dynamicRendering, "draws without render pass objects") \
  X(synchronization2, "orders its passes")                 \
  X(maintenance4, "sets work group sizes per pipeline")    \
  X(shaderDemoteToHelperInvocation, "discards fragments")  \
  X(shaderTerminateInvocation, "discards fragments")

// What ray queries need, besides the features below.
constexpr std::array kRayQueryExtensions{VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_RAY_QUERY_EXTENSION_NAME,
                                         VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

// LP_MAX_TGSI_LOOP_ITERATIONS in Mesa's src/gallium/auxiliary/gallivm/lp_bld_limits.h; a test of this room measures it.
// Mesa 22.3 has the limit, 25.0 has it no more.
constexpr std::uint32_t kLlvmpipeLoopPasses = 65535, kMesaWithoutLimit = 25;

const char* typeName(vk::PhysicalDeviceType type) {
  switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
      return "discrete";
    case vk::PhysicalDeviceType::eIntegratedGpu:
      return "integrated";
    case vk::PhysicalDeviceType::eVirtualGpu:
      return "virtual";
    case vk::PhysicalDeviceType::eCpu:
      return "cpu";
    default:
      return "other";
  }
}

std::string versionText(std::uint32_t version) {
  return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                     VK_API_VERSION_PATCH(version));
}

constexpr vk::ImageUsageFlags kColorUse =
    vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc;
constexpr vk::ImageUsageFlags kDepthUse = vk::ImageUsageFlagBits::eDepthStencilAttachment;

struct TargetLimits {
  vk::SampleCountFlags samples;
  std::uint32_t maxSize = 0;
};

TargetLimits targetLimits(const vk::raii::PhysicalDevice& physical, vk::Format format, vk::ImageUsageFlags use) {
  try {
    const auto properties =
        physical.getImageFormatProperties(format, vk::ImageType::e2D, vk::ImageTiling::eOptimal, use);
    return {properties.sampleCounts, std::min(properties.maxExtent.width, properties.maxExtent.height)};
  } catch (const vk::FormatNotSupportedError&) {
    return {};
  }
}

void describeTargets(const vk::raii::PhysicalDevice& physical, const vk::PhysicalDeviceLimits& limits,
                     DeviceInfo& info) {
  const TargetLimits color = targetLimits(physical, vk::Format::eR32G32B32A32Sfloat, kColorUse);
  const TargetLimits depth = targetLimits(physical, vk::Format::eD32Sfloat, kDepthUse);
  info.maxImageSize = std::min({color.maxSize, depth.maxSize, limits.maxFramebufferWidth, limits.maxFramebufferHeight,
                                limits.maxViewportDimensions[0], limits.maxViewportDimensions[1]});
  const vk::SampleCountFlags both =
      color.samples & depth.samples & limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
  for (const std::uint32_t samples : {1u, 2u, 4u, 8u}) {
    if (both & sampleFlag(samples)) info.msaaCounts.push_back(samples);
  }
}

std::uint64_t deviceLocalBytes(const vk::raii::PhysicalDevice& physical) {
  const auto memory = physical.getMemoryProperties();
  std::uint64_t sum = 0;
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal) sum += memory.memoryHeaps[i].size;
  }
  return sum;
}

std::string rayQueryLacks(const vk::raii::PhysicalDevice& physical) {
  const auto offered = physical.enumerateDeviceExtensionProperties();
  for (const char* name : kRayQueryExtensions) {
    const auto is = [&](const vk::ExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; };
    if (std::none_of(offered.begin(), offered.end(), is)) return name;
  }
  const auto has =
      physical
          .getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                        vk::PhysicalDeviceAccelerationStructureFeaturesKHR, vk::PhysicalDeviceRayQueryFeaturesKHR>();
  if (!has.get<vk::PhysicalDeviceVulkan12Features>().bufferDeviceAddress) return "feature bufferDeviceAddress";
  if (!has.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().accelerationStructure)
    return "feature accelerationStructure";
  return has.get<vk::PhysicalDeviceRayQueryFeaturesKHR>().rayQuery ? "" : "feature rayQuery";
}

DeviceInfo describe(const vk::raii::PhysicalDevice& physical, std::uint32_t index) {
  DeviceInfo info;
  const vk::PhysicalDeviceProperties basic = physical.getProperties();
  info.index = index;
  info.name = basic.deviceName.data();
  info.type = typeName(basic.deviceType);
  info.apiVersion = versionText(basic.apiVersion);
  info.isSoftware = basic.deviceType == vk::PhysicalDeviceType::eCpu;
  info.maxStorageBufferBytes = basic.limits.maxStorageBufferRange;
  info.uniformWindowAlignment = static_cast<std::uint32_t>(basic.limits.minUniformBufferOffsetAlignment);
  info.maxTexelBufferElements = basic.limits.maxTexelBufferElements;
  info.maxWorkGroupCountX = basic.limits.maxComputeWorkGroupCount[0];
  info.deviceLocalBytes = deviceLocalBytes(physical);
  describeTargets(physical, basic.limits, info);
  // Structures of 1.1 and 1.2 may only be asked of a device that knows them.
  if (basic.apiVersion < VK_API_VERSION_1_2) return info;
  const auto chain = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceVulkan11Properties,
                                             vk::PhysicalDeviceVulkan12Properties>();
  const auto& driver = chain.get<vk::PhysicalDeviceVulkan12Properties>();
  info.driverName = driver.driverName.data();
  info.driverInfo = driver.driverInfo.data();
  const bool limited = VK_API_VERSION_MAJOR(basic.driverVersion) < kMesaWithoutLimit;
  if (driver.driverID == vk::DriverId::eMesaLlvmpipe && limited) info.maxLoopPasses = kLlvmpipeLoopPasses;
  info.subgroupSize = chain.get<vk::PhysicalDeviceVulkan11Properties>().subgroupSize;
  const vk::PhysicalDeviceFeatures features = physical.getFeatures();
  info.hasFloat64 = features.shaderFloat64 == VK_TRUE;
  info.canBlendPerChannel = features.dualSrcBlend == VK_TRUE;
  info.hasSampleShading = features.sampleRateShading == VK_TRUE;
  if (basic.apiVersion >= VK_API_VERSION_1_3) info.rayQueryLacks = rayQueryLacks(physical);
  return info;
}

void refuseFeatures(const vk::raii::PhysicalDevice& physical, std::vector<std::string>& refusals) {
  const auto has = physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                                         vk::PhysicalDeviceVulkan13Features>();
  const auto& core = has.get<vk::PhysicalDeviceFeatures2>().features;
  const auto& vulkan12 = has.get<vk::PhysicalDeviceVulkan12Features>();
  const auto& vulkan13 = has.get<vk::PhysicalDeviceVulkan13Features>();
  const auto need = [&](vk::Bool32 present, const char* name, const char* origin, const char* why) {
    if (!present) refusals.push_back(fmt::format("needs {} ({}): it {}", name, origin, why));
  };
#define CL_NEED_CORE(name, why) need(core.name, #name, "a core feature", why);
#define CL_NEED_12(name, why) need(vulkan12.name, #name, "Vulkan 1.2", why);
#define CL_NEED_13(name, why) need(vulkan13.name, #name, "Vulkan 1.3", why);
  CL_CORE_FEATURES(CL_NEED_CORE)
  CL_VULKAN12_FEATURES(CL_NEED_12)
  CL_VULKAN13_FEATURES(CL_NEED_13)
}

void refuseFormats(const vk::raii::PhysicalDevice& physical, std::vector<std::string>& refusals) {
  using Flag = vk::FormatFeatureFlagBits;
  const auto color = physical.getFormatProperties(vk::Format::eR32G32B32A32Sfloat);
  const auto depth = physical.getFormatProperties(vk::Format::eD32Sfloat);
  const auto integer = physical.getFormatProperties(vk::Format::eR32G32B32A32Uint);
  const auto need = [&](vk::FormatFeatureFlags has, vk::FormatFeatureFlags wanted, const char* what) {
    if ((has & wanted) != wanted) refusals.push_back(fmt::format("needs {}", what));
  };
  need(color.optimalTilingFeatures, Flag::eColorAttachment | Flag::eTransferSrc, "RGBA32F color attachments");
  need(color.optimalTilingFeatures, Flag::eColorAttachmentBlend, "blending into RGBA32F color attachments");
  need(depth.optimalTilingFeatures, Flag::eDepthStencilAttachment, "D32F depth attachments");
  need(color.bufferFeatures, Flag::eUniformTexelBuffer, "RGBA32F uniform texel buffers");
  // Vulkan promises R32_UINT as an attachment and as texels.
  need(integer.bufferFeatures, Flag::eUniformTexelBuffer, "RGBA32_UINT uniform texel buffers");
}

// Of which Vulkan promises the basic ones alone.
void refuseSubgroups(const vk::raii::PhysicalDevice& physical, std::vector<std::string>& refusals) {
  using Operation = vk::SubgroupFeatureFlagBits;
  const auto chain = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceVulkan11Properties>();
  const auto& has = chain.get<vk::PhysicalDeviceVulkan11Properties>();
  const bool inCompute = static_cast<bool>(has.subgroupSupportedStages & vk::ShaderStageFlagBits::eCompute);
  const auto need = [&](Operation operation, const char* name) {
    if (inCompute && (has.subgroupSupportedOperations & operation)) return;
    refusals.push_back(fmt::format("needs {} operations of subgroups in compute shaders: ray kernels use them", name));
  };
  need(Operation::eBallot, "ballot");
  need(Operation::eArithmetic, "arithmetic");
  need(Operation::eShuffle, "shuffle");
}

void chooseQueue(Candidate& candidate) {
  const auto families = candidate.physical.getQueueFamilyProperties();
  for (std::uint32_t i = 0; i < families.size(); ++i) {
    constexpr auto kBoth = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
    if ((families[i].queueFlags & kBoth) != kBoth || families[i].queueCount == 0) continue;
    candidate.queueFamily = i;
    candidate.timestampBits = families[i].timestampValidBits;
    return;
  }
  candidate.report.refusals.push_back("needs a queue family that does graphics and compute");
}

}  // namespace

std::vector<Candidate> candidatesOf(const vk::raii::Instance& instance) {
  std::vector<Candidate> candidates;
  for (vk::raii::PhysicalDevice& physical : vk::raii::PhysicalDevices(instance)) {
    const vk::PhysicalDeviceProperties properties = physical.getProperties();
    const auto index = static_cast<std::uint32_t>(candidates.size());
    Candidate& candidate = candidates.emplace_back(Candidate{std::move(physical), {}});
    candidate.report.info = describe(candidate.physical, index);
    std::vector<std::string>& refusals = candidate.report.refusals;
    if (properties.apiVersion < VK_API_VERSION_1_3) {
      refusals.push_back("needs Vulkan 1.3, its driver has " + candidate.report.info.apiVersion);
    } else {
      refuseFeatures(candidate.physical, refusals);
      refuseSubgroups(candidate.physical, refusals);
    }
    refuseFormats(candidate.physical, refusals);
    chooseQueue(candidate);
    if (candidate.timestampBits > 0) candidate.report.info.timestampPeriodNs = properties.limits.timestampPeriod;
  }
  return candidates;
}

FeatureChain wantedFeatures(const DeviceInfo& info) {
  FeatureChain chain;
  auto& core = chain.get<vk::PhysicalDeviceFeatures2>().features;
  auto& vulkan12 = chain.get<vk::PhysicalDeviceVulkan12Features>();
  auto& vulkan13 = chain.get<vk::PhysicalDeviceVulkan13Features>();
#define CL_WANT_CORE(name, why) core.name = VK_TRUE;
#define CL_WANT_12(name, why) vulkan12.name = VK_TRUE;
#define CL_WANT_13(name, why) vulkan13.name = VK_TRUE;
  CL_CORE_FEATURES(CL_WANT_CORE)
  CL_VULKAN12_FEATURES(CL_WANT_12)
  CL_VULKAN13_FEATURES(CL_WANT_13)
  core.shaderFloat64 = info.hasFloat64 ? VK_TRUE : VK_FALSE;
  if (info.rayQueryLacks.empty()) {
    vulkan12.bufferDeviceAddress = VK_TRUE;
    chain.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().accelerationStructure = VK_TRUE;
    chain.get<vk::PhysicalDeviceRayQueryFeaturesKHR>().rayQuery = VK_TRUE;
  } else {
    chain.unlink<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>();
    chain.unlink<vk::PhysicalDeviceRayQueryFeaturesKHR>();
  }
  core.sampleRateShading = info.hasSampleShading ? VK_TRUE : VK_FALSE;
  core.dualSrcBlend = info.canBlendPerChannel ? VK_TRUE : VK_FALSE;
  return chain;
}

std::vector<const char*> wantedExtensions(const DeviceInfo& info) {
  if (!info.rayQueryLacks.empty()) return {};
  return {kRayQueryExtensions.begin(), kRayQueryExtensions.end()};
}

}  // namespace crosslight::gpu

#include "app/device_choice.h"

#include <fmt/format.h>

#include "app/command_line.h"
#include "base/error.h"
#include "base/log.h"
#include "trace/kernels.h"

namespace crosslight {
namespace {

std::string inMiB(std::uint64_t bytes) { return fmt::format("{} MiB", bytes >> 20); }

// What --kernel can have besides what is taken, and what it cannot, with the reason.
std::string otherKernels(const gpu::DeviceInfo& info) {
  std::string text;
  for (const std::string& name : kernelFamilyNames()) {
    const KernelFamily family = kernelFamilyOf(name);
    if (family == KernelFamily::automatic || family == familyFor(info)) continue;
    const std::string reason = whyNot(family, info);
    text += fmt::format("            --kernel {}: {}\n", name, reason.empty() ? describe(family) : "no, it " + reason);
  }
  return text;
}

Json familiesJson(const gpu::DeviceInfo& info) {
  Json json = Json::object();
  for (const std::string& name : kernelFamilyNames()) {
    const KernelFamily family = kernelFamilyOf(name);
    if (family != KernelFamily::automatic) json[name] = whyNot(family, info);
  }
  return json;
}

}  // namespace

void addDeviceOptions(CommandLine& line, CLI::App& command, DeviceChoice& choice) {
  line.text(command, "--device", choice.selector, "N|lavapipe|NAME",
            "Use this device: its number in 'crosslight devices', the software driver, or part of a name; a missing "
            "one ends with exit code 4")
      ->group("Device");
  line.flag(command, "--require-device", choice.required,
            "End with exit code 4 where no hardware device can be used; a software driver then counts only when "
            "--device names it")
      ->group("Device");
}

gpu::Device openDevice(const DeviceChoice& choice) {
  gpu::DeviceOptions options;
  options.selector = choice.selector;
  options.usePipelineCache = choice.usesPipelineCache;
  gpu::Device device = gpu::Device::open(options);
  const gpu::DeviceInfo& info = device.info();
  if (info.isSoftware && choice.required && choice.selector.empty()) {
    throw DeviceError("--require-device: the only usable device is the software driver '" + info.name +
                      "'; '--device lavapipe' accepts it, 'crosslight devices' tells why others were refused");
  }
  return device;
}

void sayIfSoftware(const gpu::DeviceInfo& info) {
  if (info.isSoftware) logInfo("software driver: " + info.name + " (" + driverOf(info) + ") computes on the CPU");
}

void openIfAsked(const DeviceChoice& choice) {
  if (choice.required || !choice.selector.empty()) sayIfSoftware(openDevice(choice).info());
}

std::string deviceTable(const std::vector<gpu::DeviceReport>& reports) {
  if (reports.empty()) {
    return "No Vulkan driver was found. The software driver lavapipe needs no GPU (Debian: mesa-vulkan-drivers).\n";
  }
  std::string text;
  for (const gpu::DeviceReport& report : reports) {
    const gpu::DeviceInfo& info = report.info;
    text += fmt::format("{}: {} ({}{})\n", info.index, info.name, info.type, report.usable() ? "" : ", refused");
    text += fmt::format("   driver   {}, Vulkan {}\n", driverOf(info), info.apiVersion);
    if (info.isSoftware) text += "   note     a software driver: it computes on the CPU\n";
    for (const std::string& refusal : report.refusals) text += "   refused  " + refusal + "\n";
    if (!report.usable()) continue;
    std::vector<std::string> counts;
    for (const std::uint32_t count : info.msaaCounts) counts.push_back(std::to_string(count));
    text += fmt::format("   limits   image {0}x{0}, storage buffer {1}, device-local memory {2}, MSAA {3}\n",
                        info.maxImageSize, inMiB(info.maxStorageBufferBytes), inMiB(info.deviceLocalBytes),
                        fmt::join(counts, " "));
    text += fmt::format("   compute  subgroups of {}, float64 {}, timestamps {}, kernels {} ({})\n", info.subgroupSize,
                        info.hasFloat64 ? "yes" : "no", info.timestampPeriodNs > 0 ? "yes" : "no",
                        nameOf(familyFor(info)), describe(familyFor(info)));
    text += otherKernels(info);
  }
  return text;
}

Json deviceJson(const gpu::DeviceReport& report) {
  const gpu::DeviceInfo& info = report.info;
  Json json;
  json["index"] = info.index;
  json["name"] = info.name;
  json["type"] = info.type;
  json["driver"] = driverOf(info);
  json["apiVersion"] = info.apiVersion;
  json["softwareDriver"] = info.isSoftware;
  json["usable"] = report.usable();
  json["refusals"] = report.refusals;
  json["kernels"] = report.usable() ? Json(nameOf(familyFor(info))) : Json(nullptr);
  if (report.usable()) json["kernelRefusals"] = familiesJson(info);
  json["limits"] = {{"maxImageSize", info.maxImageSize},
                    {"maxStorageBufferBytes", info.maxStorageBufferBytes},
                    {"maxTexelBufferElements", info.maxTexelBufferElements},
                    {"maxWorkGroupCountX", info.maxWorkGroupCountX},
                    {"deviceLocalBytes", info.deviceLocalBytes},
                    {"msaaCounts", info.msaaCounts},
                    {"subgroupSize", info.subgroupSize},
                    {"float64", info.hasFloat64},
                    {"timestampPeriodNs", info.timestampPeriodNs}};
  return json;
}

}  // namespace crosslight

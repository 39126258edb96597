// Which device a command uses, how it is said, and the list of all of them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/record.h"
#include "gpu/device.h"

namespace crosslight {

class CommandLine;

struct DeviceChoice {
  std::string selector;
  bool required = false;          // a software driver counts as no device unless the selector names one
  bool usesPipelineCache = true;  // what earlier runs have left on disk
};

// --device and --require-device.
void addDeviceOptions(CommandLine& line, CLI::App& command, DeviceChoice& choice);

// DeviceError with all refusals when there is none.
gpu::Device openDevice(const DeviceChoice& choice);
// Says so on stderr when the driver runs on the CPU.
void sayIfSoftware(const gpu::DeviceInfo& info);

// Nothing unless the choice names or requires a device; then opens it, as a driver that lists one may fail to make it.
void openIfAsked(const DeviceChoice& choice);

std::string deviceTable(const std::vector<gpu::DeviceReport>& reports);
Json deviceJson(const gpu::DeviceReport& report);

}  // namespace crosslight
